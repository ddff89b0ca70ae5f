// Mesh files by name: what can go wrong with the file itself.
#include <sys/resource.h>

#include <csignal>

#include "mesh_testing.hpp"
#include "snip/whole_file.hpp"

using mesh_testing::TemporaryDirectory;
using snip::read_mesh;
using snip::write_mesh;

namespace {

const std::string one_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string refusal(const std::filesystem::path& path) {
  const auto mesh = read_mesh(path);
  return mesh ? "accepted" : mesh.error().message;
}

}  // namespace

TEST_CASE("mesh file: read by its ending, in any case") {
  const TemporaryDirectory directory;
  CHECK(refusal(directory.write("a.obj", one_triangle)) == "accepted");
  CHECK(refusal(directory.write("A.OBJ", one_triangle)) == "accepted");
  const auto path = directory.write("a.mesh", one_triangle);
  CHECK(refusal(path) ==
        path.string() + ": unknown kind of mesh file: the name must end in .obj, .ply, .stl or .off");
}

TEST_CASE("mesh file: missing, a directory, empty, wrong content") {
  const TemporaryDirectory directory;
  const auto missing = directory / "no.obj";
  CHECK(refusal(missing) == missing.string() + ": no such file");
  const auto folder = directory / "folder.ply";
  std::filesystem::create_directory(folder);
  CHECK(refusal(folder) == folder.string() + ": cannot be read: not a regular file");
  const auto empty = directory.write("empty.off", "");
  CHECK(refusal(empty) == empty.string() + ": the file is empty");
  const auto wrong = directory.write("wrong.ply", one_triangle);
  CHECK(refusal(wrong) == wrong.string() + ":1: not a PLY file: it must begin with 'ply'");
}

TEST_CASE("mesh file: writing replaces the file as a whole and leaves nothing else behind") {
  const TemporaryDirectory directory;
  const auto mesh = read_mesh(directory.write("in.obj", one_triangle));
  REQUIRE(mesh);
  for (const char* name : {"out.obj", "out.ply", "out.stl", "out.off"}) {
    directory.write(name, "old");
    CHECK(write_mesh(directory / name, *mesh));
    const auto again = read_mesh(directory / name);
    REQUIRE(again);
    CHECK(again->triangles == mesh->triangles);
  }
  CHECK(directory.file_count() == 5);
}

TEST_CASE("mesh file: a symbolic link is followed, not replaced") {
  const TemporaryDirectory directory;
  directory.write("real.txt", "old");
  std::filesystem::create_symlink(directory / "real.txt", directory / "link.txt");
  CHECK(snip::write_whole_file(directory / "link.txt", "new"));
  CHECK(std::filesystem::is_symlink(directory / "link.txt"));
  CHECK(directory.read("real.txt") == "new");
}

TEST_CASE("mesh file: a file that is not there yet, and a link that leads nowhere") {
  const TemporaryDirectory directory;
  CHECK(snip::write_whole_file(directory / "new.txt", "new"));
  CHECK(directory.read("new.txt") == "new");
  std::filesystem::create_symlink(directory / "loop.txt", directory / "loop.txt");
  CHECK_FALSE(snip::write_whole_file(directory / "loop.txt", "new"));
  CHECK(directory.file_count() == 2);
}

TEST_CASE("mesh file: what cannot be written is said, and leaves nothing behind") {
  const TemporaryDirectory directory;
  const auto mesh = read_mesh(directory.write("in.obj", one_triangle));
  REQUIRE(mesh);
  const auto nowhere = directory / "no/out.obj";
  const auto result = write_mesh(nowhere, *mesh);
  REQUIRE_FALSE(result);
  CHECK(result.error().message == nowhere.string() + ": cannot be written: No such file or directory");
  const auto folder = directory / "out.ply";
  std::filesystem::create_directory(folder);
  const auto onto_folder = write_mesh(folder, *mesh);
  REQUIRE_FALSE(onto_folder);
  CHECK(onto_folder.error().message == folder.string() + ": cannot be written: it is a directory");
  const auto unknown = write_mesh(directory / "out.xyz", *mesh);
  REQUIRE_FALSE(unknown);
  CHECK(unknown.error().message.find("the name must end in .obj") != std::string::npos);
  CHECK(directory.file_count() == 2);
}

TEST_CASE("mesh file: when the disk takes only a part, the old file stays and the part goes") {
  const TemporaryDirectory directory;
  directory.write("out.txt", "old");
  // A limit on the size of files stands for the full disk; without the signal, it is an error of write().
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &old_limit) == 0);
  const rlimit limit{1000, old_limit.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  const auto result = snip::write_whole_file(directory / "out.txt", std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  REQUIRE_FALSE(result);
  CHECK(result.error().message == (directory / "out.txt").string() + ": cannot be written: File too large");
  CHECK(directory.read("out.txt") == "old");
  CHECK(directory.file_count() == 1);
}

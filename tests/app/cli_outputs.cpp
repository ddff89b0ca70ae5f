// What the program does when it cannot write: streams that are closed or full, files in the way.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli_testing.hpp"

namespace fs = std::filesystem;
using cli_testing::is_one_error;
using cli_testing::shell;
using mesh_testing::TemporaryDirectory;

namespace {

/// A directory with a sheet, a wall that cuts it, and a scene that lasts a few frames.
struct Inputs {
  TemporaryDirectory directory;
  Inputs() {
    directory.write("sheet.obj", cli_testing::sheet_obj(3));
    directory.write("wall.off", cli_testing::wall_off(1.3, -1, 1.3, 4));
    directory.write("scene.json", R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2}, "frames": 8,
      "output": {"picture_interval": 0, "animation_interval": 0}})");
  }
  [[nodiscard]] cli_testing::Outcome snip(const std::string& arguments) const {
    return cli_testing::snip(directory, arguments);
  }
};

}  // namespace

TEST_CASE("cli: stderr that cannot be written is no reason to stop") {
  const Inputs inputs;
  for (const char* where : {"2>/dev/full", "2>&-"}) {
    CHECK(shell(inputs.directory, std::string("snip validate missing.obj ") + where) == 1);
    CHECK(shell(inputs.directory, std::string("snip fold ") + where) == 2);
    CHECK(shell(inputs.directory, std::string("snip run scene.json -o out > said ") + where) == 0);
    CHECK(inputs.directory.read("said").find("8 frames") != std::string::npos);
    // What was meant for a closed stream did not go into the file that was opened next.
    CHECK(inputs.directory.read("out/frames.csv").starts_with("frame,"));
    CHECK(inputs.directory.read("out/frames.csv").find(" of ") == std::string::npos);
  }
}

TEST_CASE("cli: a time step that becomes too large by a cut is told of in one line, once") {
  const Inputs inputs;
  (void)inputs.directory.write("paper.json", R"({"cloth": {"shape": "grid", "columns": 4, "rows": 4},
    "anchors": [{"nodes": [0, 1, 2, 3, 4, 5, 9, 10, 14, 15, 19, 20, 21, 22, 23, 24]}],
    "material": {"mode": "paper"}, "gravity": [0, 0, 0], "time_step": 0.0245, "steps_per_frame": 1,
    "frames": 12, "cutters": [{"at": 0.1, "times": 2, "interval": 0.05, "step": [0, 1, 0], "mesh":
      {"shape": "plane", "centre": [2, 2, 0], "u": [2.4, 0, 0], "v": [0, 0, 1]}}]})");
  const auto run = inputs.snip("run paper.json -o out --no-images");
  CHECK(run.exit_code == 0);
  const std::size_t warning = run.err.find("snip: warning: after the cuts of frame ");
  CHECK_MESSAGE(warning != std::string::npos, run.err);
  CHECK(run.err.find("warning", warning + 10) == std::string::npos);
}

TEST_CASE("cli: a run goes on when nobody listens any more") {
  const Inputs inputs;
  const std::string nobody = " | sh -c 'exec <&-; sleep 0.4'";
  const std::string run = "(sleep 0.1; snip run scene.json -o out ";
  CHECK(shell(inputs.directory, run + ">said; echo $? >code) 2>&1" + nobody) == 0);
  CHECK(inputs.directory.read("code") == "0\n");
  CHECK(shell(inputs.directory, run + "2>said; echo $? >code)" + nobody) == 0);
  CHECK(inputs.directory.read("code") == "1\n");
  CHECK(inputs.directory.read("said").ends_with("snip: error: stdout cannot be written: Broken pipe\n"));
  CHECK(fs::is_regular_file(inputs.directory / "out/final.obj"));
}

TEST_CASE("cli: stdout that cannot be written is one line and exit code 1, unless nothing was said") {
  const Inputs inputs;
  for (const char* arguments :
       {"validate sheet.obj", "run scene.json -o out", "--help", "--version", "cut --help"})
    for (const char* where : {"/dev/full", "&-"}) {
      const std::string line = fmt::format("snip {} >{} 2>said", arguments, where);
      CHECK_MESSAGE(shell(inputs.directory, line) == 1, line);
      const std::string said = inputs.directory.read("said");
      CHECK_MESSAGE(said.find("snip: error: stdout cannot be written: ") != std::string::npos, line << said);
      CHECK(said.ends_with("\n"));
    }
  CHECK(shell(inputs.directory, "snip cut sheet.obj wall.off -o out.obj >/dev/full") == 0);
  CHECK(shell(inputs.directory, "snip cut sheet.obj wall.off -o out.obj >&- 2>&- <&-") == 0);
  CHECK(shell(inputs.directory, "snip validate missing.obj >/dev/full 2>said") == 1);
  CHECK(inputs.directory.read("said") == "snip: error: missing.obj: no such file\n");
}

TEST_CASE("cli: statistics never take the place of a mesh") {
  const Inputs inputs;
  inputs.directory.write("out.obj", "as it was");
  fs::create_symlink("out.obj", inputs.directory / "link.json");
  fs::create_directory(inputs.directory / "folder");
  fs::create_directory_symlink("folder", inputs.directory / "same_folder");
  const std::size_t files = inputs.directory.file_count();
  for (const char* outputs :
       {"-o out.obj --stats out.obj", "-o out.obj --stats ./folder/../out.obj",
        "-o out.obj --stats link.json", "-o new.obj --stats new.obj", "-o new.obj --stats ./new.obj",
        "-o out.obj --stats sheet.obj", "-o folder/new.obj --stats same_folder/new.obj"})
    for (const char* command : {"cut sheet.obj wall.off ", "weld sheet.obj -d 0.1 "}) {
      const auto outcome = inputs.snip(std::string(command) + outputs);
      CHECK_MESSAGE(outcome.exit_code == 1, command << outputs);
      CHECK_MESSAGE(is_one_error(outcome.err), outcome.err);
      CHECK(inputs.directory.read("out.obj") == "as it was");
      CHECK(inputs.directory.read("sheet.obj") == cli_testing::sheet_obj(3));
      CHECK(inputs.directory.file_count() == files);
    }
  // A mesh may replace the one that it was made from.
  CHECK(inputs.snip("cut sheet.obj wall.off -o sheet.obj").exit_code == 0);
  CHECK(inputs.directory.read("sheet.obj").find("g piece_1") != std::string::npos);
}

TEST_CASE("cli: when the statistics cannot be written, the mesh is as it was") {
  const Inputs inputs;
  inputs.directory.write("out.obj", "as it was");
  for (const char* command : {"cut sheet.obj wall.off", "weld sheet.obj -d 0.1"}) {
    const auto outcome = inputs.snip(std::string(command) + " -o out.obj --stats no/stats.json");
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err == "snip: error: no/stats.json: cannot be written: No such file or directory\n");
    CHECK(inputs.directory.read("out.obj") == "as it was");
    CHECK(inputs.directory.file_count() == 4);
  }
  // Nor when the disk is full at the last moment: a file can have half a KiB, which is enough for the mesh.
  inputs.directory.write("tiny.obj", cli_testing::sheet_obj(1));
  inputs.directory.write("out.off", "as it was");
  const std::string cut = "trap '' XFSZ; ulimit -f 1; snip cut tiny.obj wall.off -o out.off";
  CHECK(shell(inputs.directory, cut + " --stats s.json 2>said") == 1);
  CHECK(inputs.directory.read("said") == "snip: error: s.json: cannot be written: File too large\n");
  CHECK(inputs.directory.read("out.off") == "as it was");
  CHECK(inputs.directory.file_count() == 7);
  CHECK(shell(inputs.directory, cut) == 0);
}

TEST_CASE("cli: what is in the way and not a regular file is left alone, and named before work is done") {
  const Inputs inputs;
  REQUIRE(::mkfifo((inputs.directory / "pipe").c_str(), 0600) == 0);
  fs::create_directory(inputs.directory / "folder.obj");
  fs::create_symlink("/dev/null", inputs.directory / "null.obj");
  fs::create_symlink("circle.obj", inputs.directory / "circle.obj");
  const std::pair<const char*, const char*> cases[] = {
      {"-o out.obj --stats pipe", "pipe: cannot be written: it is not a regular file"},
      {"-o out.obj --stats /dev/null", "/dev/null: cannot be written: it is not a regular file"},
      {"-o null.obj", "null.obj: cannot be written: it is not a regular file"},
      {"-o folder.obj", "folder.obj: cannot be written: it is a directory"},
      {"-o folder.obj/",
       "folder.obj/: unknown kind of mesh file: the name must end in .obj, .ply, .stl or .off"},
      {"-o out.obj --stats folder.obj/", "folder.obj/: cannot be written: it is a directory"},
      {"-o out.obj --stats new/", "new/: cannot be written: the name of a file is missing"},
      {"-o circle.obj", "circle.obj: cannot be written: Too many levels of symbolic links"},
      {"-o sheet.obj/out.obj", "sheet.obj/out.obj: cannot be written: Not a directory"},
  };
  for (const auto& [outputs, message] : cases)
    // The input is missing, which is not even looked at.
    for (const char* command : {"cut missing.obj missing.obj ", "weld missing.obj -d 1 "}) {
      const auto outcome = inputs.snip(std::string(command) + outputs);
      CHECK(outcome.exit_code == 1);
      CHECK(outcome.err == fmt::format("snip: error: {}\n", message));
    }
  CHECK(fs::is_fifo(inputs.directory / "pipe"));
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("cli: a run names what is in its way before it begins") {
  const Inputs inputs;
  for (const char* name : {"frames.csv", "final.obj", "animation.webp"}) {
    const TemporaryDirectory out;
    fs::create_directory(out / name);
    inputs.directory.write("scene.json", R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2}})");
    const auto outcome = inputs.snip(fmt::format("run scene.json -o '{}'", out.path().string()));
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err == fmt::format("snip: error: {}/{}: cannot be written: it is a directory\n",
                                     out.path().string(), name));
    CHECK(out.file_count() == 1);
  }
}

TEST_CASE("cli: a link stays a link, and what it leads to is written") {
  const Inputs inputs;
  inputs.directory.write("real.obj", "as it was");
  fs::permissions(inputs.directory / "real.obj", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_directory(inputs.directory / "folder");
  fs::create_symlink("../real.obj", inputs.directory / "folder/near.obj");
  fs::create_symlink("folder/near.obj", inputs.directory / "far.obj");
  fs::create_symlink("folder/new.json", inputs.directory / "stats.json");
  REQUIRE(inputs.snip("cut sheet.obj wall.off -o far.obj --stats stats.json").exit_code == 0);
  CHECK(fs::is_symlink(inputs.directory / "far.obj"));
  CHECK(fs::is_symlink(inputs.directory / "folder/near.obj"));
  CHECK(fs::is_symlink(inputs.directory / "stats.json"));
  CHECK(inputs.directory.read("real.obj").find("g piece_1") != std::string::npos);
  CHECK(nlohmann::json::parse(inputs.directory.read("folder/new.json"))["pieces"].size() == 2);
  // A file that others may not read stays so.
  CHECK(fs::status(inputs.directory / "real.obj").permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("cli: what interrupted runs left, and long names, do no harm") {
  const Inputs inputs;
  // Whatever number the process has, a file of that name is there already.
  const std::string line =
      "sh -c 'touch out.obj out.obj.$$-0.part; exec snip cut sheet.obj wall.off -o out.obj' && ls *.part | "
      "wc -l > "
      "count";
  CHECK(shell(inputs.directory, line) == 0);
  CHECK(inputs.directory.read("out.obj").find("g piece_1") != std::string::npos);
  CHECK(std::stoi(inputs.directory.read("count")) == 1);
  const std::string longest = std::string(251, 'x') + ".obj";
  CHECK(inputs.snip("weld sheet.obj -d 0.1 -o " + longest).exit_code == 0);
  CHECK(fs::is_regular_file(inputs.directory / longest));
}

TEST_CASE("cli: a run that is killed leaves whole files only") {
  const Inputs inputs;
  const int nameless = ::open(inputs.directory.path().c_str(), O_WRONLY | O_TMPFILE, 0600);
  if (nameless < 0) return;  // not on this file system, see OutputFile
  ::close(nameless);
  inputs.directory.write("long.json",
                         R"({"cloth": {"shape": "grid", "columns": 2, "rows": 2}, "frames": 90000,
      "output": {"picture_interval": 90000, "animation_interval": 10, "width": 16, "height": 16}})");
  // The first picture is there while the table, the animation and the mesh are not.
  const std::string line =
      "snip run long.json -o out >said 2>&1 & while [ ! -e out/frame_00000.png ]; do kill -0 $! || exit 1; "
      "sleep 0.05; done; kill -KILL $!; wait $!; ls -A out >left";
  CHECK(shell(inputs.directory, line) == 0);
  CHECK(inputs.directory.read("left") == "frame_00000.png\n");
}

TEST_CASE("cli: a file that may not be written is left alone") {
  if (::geteuid() == 0) return;  // who may do everything
  const Inputs inputs;
  inputs.directory.write("out.obj", "as it was");
  fs::permissions(inputs.directory / "out.obj", fs::perms::owner_read);
  const auto outcome = inputs.snip("weld sheet.obj -d 0.1 -o out.obj");
  CHECK(outcome.err == "snip: error: out.obj: cannot be written: Permission denied\n");
  CHECK(inputs.directory.read("out.obj") == "as it was");
}

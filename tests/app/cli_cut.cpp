// snip cut, as a person runs it: what is in the files that it writes.
#include <nlohmann/json.hpp>
#include <set>

#include "cli_testing.hpp"
#include "snip/pieces.hpp"

using mesh_testing::TemporaryDirectory;
using nlohmann::json;

namespace {

// A sheet of 4 by 4 squares, cut in two along x = 1.3.
struct CutSheet {
  TemporaryDirectory directory;
  snip::Mesh mesh;
  json stats;

  explicit CutSheet(const std::string& out, const std::string& cloth = "sheet.obj") {
    directory.write("sheet.obj", cli_testing::sheet_obj(4));
    directory.write("wall.off", cli_testing::wall_off(1.3, -1, 1.3, 5));
    if (cloth.ends_with(".ply")) {
      auto sheet = snip::read_mesh(directory / "sheet.obj");
      REQUIRE(sheet);
      sheet->colours.types.assign(3, snip::ScalarType::uint8);
      for (auto& colour : sheet->colours.values)
        for (double& channel : colour) channel *= 255;
      REQUIRE(snip::write_mesh(directory / cloth, *sheet));
    }
    const auto outcome =
        cli_testing::snip(directory, fmt::format("cut {} wall.off -o {} --stats stats.json", cloth, out));
    CHECK(outcome.err == "");
    REQUIRE(outcome.exit_code == 0);
    auto result = snip::read_mesh(directory / out);
    REQUIRE(result);
    mesh = *result;
    stats = json::parse(directory.read("stats.json"));
  }
};

}  // namespace

TEST_CASE("cli: cut gives two pieces that share no vertex, as groups, largest first") {
  const CutSheet cut("out.obj");
  const snip::Pieces pieces = snip::find_pieces(cut.mesh.positions, cut.mesh.triangles);
  REQUIRE(pieces.pieces.size() == 2);
  CHECK(pieces.pieces[0].area == doctest::Approx(4 * 2.7));
  CHECK(pieces.pieces[1].area == doctest::Approx(4 * 1.3));
  const std::string text = cut.directory.read("out.obj");
  const std::size_t first = text.find("g piece_0\n");
  const std::size_t second = text.find("g piece_1\n");
  REQUIRE(first < second);
  REQUIRE(second != std::string::npos);
  CHECK(text.find("g piece_2") == std::string::npos);
  CHECK(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(second), text.end(),
                                            'f')) == pieces.pieces[1].triangles);
}

TEST_CASE("cli: cut carries UV, normals and colours along, interpolated on the cut") {
  const CutSheet cut("out.obj");
  REQUIRE(cut.mesh.uv_triangles.size() == cut.mesh.triangles.size());
  REQUIRE(cut.mesh.normal_triangles.size() == cut.mesh.triangles.size());
  std::size_t on_cut = 0;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d position = cut.mesh.positions[cut.mesh.triangles[t][k]];
      REQUIRE(cut.mesh.uv_triangles[t][k] != snip::no_index);
      const Eigen::Vector2d uv = cut.mesh.uvs[cut.mesh.uv_triangles[t][k]];
      CHECK((uv - position.head<2>()).norm() < 1e-12);
      CHECK((cut.mesh.normals[cut.mesh.normal_triangles[t][k]] - Eigen::Vector3d(0, 0, 1)).norm() < 1e-12);
      const auto& colour = cut.mesh.colours.values[cut.mesh.triangles[t][k]];
      CHECK(colour[0] == doctest::Approx(position.x() / 4).epsilon(1e-9));
      CHECK(colour[1] == doctest::Approx(position.y() / 4).epsilon(1e-9));
      if (std::abs(position.x() - 1.3) < 1e-6) ++on_cut;
    }
  CHECK(on_cut > 0);
  // What the cut did not touch keeps its bits.
  std::set<std::pair<double, double>> corners;
  for (const Eigen::Vector3d& p : cut.mesh.positions)
    if (p.x() == std::floor(p.x())) corners.insert({p.x(), p.y()});
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) CHECK(corners.count({x, y}) == 1);
}

TEST_CASE("cli: ply keeps the type of its colours") {
  const CutSheet cut("out.ply", "sheet.ply");
  CHECK(cut.mesh.colours.types == std::vector<snip::ScalarType>(3, snip::ScalarType::uint8));
  for (std::size_t v = 0; v < cut.mesh.positions.size(); ++v)
    CHECK(std::abs(cut.mesh.colours.values[v][0] - cut.mesh.positions[v].x() / 4 * 255) <= 1);
  CHECK(cut.directory.read("out.ply").find("property uchar red") != std::string::npos);
  CHECK(cut.mesh.uv_triangles.size() == cut.mesh.triangles.size());
}

TEST_CASE("cli: every format of output holds the same triangles") {
  const CutSheet obj("out.obj");
  for (const char* name : {"out.ply", "out.off", "out.stl"}) {
    const CutSheet other(name);
    REQUIRE(other.mesh.triangles.size() == obj.mesh.triangles.size());
    for (std::size_t t = 0; t < obj.mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(other.mesh.positions[other.mesh.triangles[t][k]] ==
              obj.mesh.positions[obj.mesh.triangles[t][k]]);
  }
}

TEST_CASE("cli: the statistics of a cut") {
  const json stats = CutSheet("out.obj").stats;
  REQUIRE(stats["pieces"].size() == 2);
  for (const json& piece : stats["pieces"]) {
    CHECK(piece["boundary_loops"] == 1);
    CHECK(piece["euler_characteristic"] == 1);
    CHECK(piece["triangles"].get<int>() > 0);
  }
  CHECK(stats["pieces"][0]["area"].get<double>() == doctest::Approx(4 * 2.7));
  CHECK(stats["area_before"].get<double>() == 16);
  CHECK(stats["area_after"].get<double>() == doctest::Approx(16));
  const json whole = {{"nodes", 25}, {"edges", 56}, {"triangles", 32}};
  CHECK(stats["physics"]["before"] == whole);
  CHECK(stats["render"]["before"] == whole);
  // The wall meets 8 triangles, and each becomes two.
  CHECK(stats["physics"]["after"]["triangles"] == 40);
  for (const char* which : {"physics", "render"})
    for (const char* what : {"nodes", "edges", "triangles"}) {
      CHECK(stats[which]["after"][what].get<int>() > stats[which]["before"][what].get<int>());
    }
  for (const char* step :
       {"read", "build", "detect", "merge_endpoints", "arrange", "reconnect", "publish", "write"})
    CHECK_MESSAGE(stats["timings_ms"].contains(step), step);
  CHECK(stats["violations"] == json::array());
}

TEST_CASE("cli: a cutter that misses changes nothing; one that is not manifold is fine") {
  const TemporaryDirectory directory;
  directory.write("sheet.obj", cli_testing::sheet_obj(2));
  directory.write("far.off", cli_testing::wall_off(9, 9, 10, 10));
  CHECK(cli_testing::snip(directory, "cut sheet.obj far.off -o out.obj").exit_code == 0);
  const auto out = snip::read_mesh(directory / "out.obj");
  REQUIRE(out);
  CHECK(out->triangles.size() == 8);
  CHECK(out->positions.size() == 9);

  // Four triangles share the edge between the first two points, which is beside the sheet.
  directory.write("book.obj",
                  "v .7 -1 -1\nv .7 -1 1\nv .7 3 -1\nv .7 3 1\nv 1 -9 0\nv 2 -9 0\n"
                  "f 1 2 3\nf 2 3 4\nf 1 2 4\nf 1 2 5\nf 1 2 6\nf 4 2 3\n");
  const auto cut = cli_testing::snip(directory, "cut sheet.obj book.obj -o out.obj --stats stats.json");
  CHECK(cut.exit_code == 0);
  CHECK(cut.err == "snip: warning: book.obj: dropped triangles: 1 repeated\n");
  CHECK(json::parse(directory.read("stats.json"))["pieces"].size() == 2);
}

// snip weld, as a person runs it.
#include <nlohmann/json.hpp>

#include "cli_testing.hpp"

using mesh_testing::TemporaryDirectory;

TEST_CASE("cli: weld joins triangles that touch but for a crack, and says what it dropped") {
  const TemporaryDirectory directory;
  directory.write("cracked.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1.001 1 0\nv 0 1 0\nv 0 0 0.001\nv 0 0 0\n"
                  "f 1 2 3\nf 4 5 6\nf 1 6 7\n");
  const auto outcome =
      cli_testing::snip(directory, "weld cracked.obj -d 0.01 -o whole.ply --stats stats.json");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(outcome.err == "snip: warning: cracked.obj: dropped triangles: 1 without area\n");
  const auto mesh = snip::read_mesh(directory / "whole.ply");
  REQUIRE(mesh);
  CHECK(mesh->positions == std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(mesh->triangles == std::vector<snip::Triangle>{{0, 1, 2}, {2, 3, 0}});
  const auto stats = nlohmann::json::parse(directory.read("stats.json"));
  CHECK(stats["vertices"] == nlohmann::json{{"before", 7}, {"after", 4}});
  CHECK(stats["triangles"] == nlohmann::json{{"before", 3}, {"after", 2}});
  CHECK(stats["dropped"] == nlohmann::json{{"degenerate", 1}, {"duplicate", 0}});
  REQUIRE(stats["pieces"].size() == 1);
  CHECK(stats["pieces"][0]["boundary_loops"] == 1);
  CHECK(directory.file_count() == 3);
}

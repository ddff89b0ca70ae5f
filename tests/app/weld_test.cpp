// Merging vertices.
#include <rapidcheck.h>

#include <random>

#include "mesh_testing.hpp"
#include "snip/weld.hpp"

using snip::Mesh;
using snip::Triangle;

TEST_CASE("weld: a later vertex goes to the nearest kept one, kept ones do not move") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.05, 0, 0}, {0.02, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  mesh.colours.types.assign(3, snip::ScalarType::uint8);
  for (double v = 0; v < 6; ++v) mesh.colours.values.push_back({v, v, v, 1});
  mesh.uvs.assign(6, {0, 0});
  mesh.uv_triangles = mesh.triangles;
  const auto merged = snip::weld(mesh, 0.1, "name");
  REQUIRE(merged);
  CHECK(*merged == 2);
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(mesh.uv_triangles == std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}});
  CHECK(mesh.colours.values.size() == 4);
  CHECK(mesh.colours.values[3][0] == 5);
}

TEST_CASE("weld: normals of vertices are merged with them, normals of corners stay") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  mesh.normals = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}, {0, 0, 5}, {0, 0, 6}};
  mesh.normal_triangles = mesh.triangles;
  Mesh by_corner = mesh;
  by_corner.triangles = {{0, 1, 2}, {1, 5, 4}};
  REQUIRE(snip::weld(mesh, 1e-9, "name"));
  CHECK(mesh.normal_triangles == std::vector<Triangle>{{0, 1, 2}, {1, 5, 2}});
  // Vertex 1 has two normals here.
  REQUIRE(snip::weld(by_corner, 1e-9, "name"));
  CHECK(by_corner.normal_triangles == std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}});
}

TEST_CASE("weld: agrees with comparing every pair of points") {
  CHECK(rc::check([](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double distance = 0.01 + 0.5 * std::abs(unit(random));
    Mesh mesh;
    for (int i = 0; i < 60; ++i) mesh.positions.emplace_back(unit(random), unit(random), unit(random));
    for (std::uint32_t i = 0; i + 2 < 60; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
    const Mesh before = mesh;

    std::vector<Eigen::Vector3d> kept;
    std::vector<std::uint32_t> kept_of;
    for (const Eigen::Vector3d& p : before.positions) {
      std::size_t nearest = kept.size();
      for (std::size_t k = 0; k < kept.size(); ++k)
        if ((kept[k] - p).squaredNorm() <= distance * distance &&
            (nearest == kept.size() || (kept[k] - p).squaredNorm() < (kept[nearest] - p).squaredNorm()))
          nearest = k;
      if (nearest == kept.size()) kept.push_back(p);
      kept_of.push_back(static_cast<std::uint32_t>(nearest));
    }
    const auto merged = snip::weld(mesh, distance, "name");
    RC_ASSERT(static_cast<bool>(merged));
    RC_ASSERT(mesh.positions == kept);
    RC_ASSERT(*merged == 60 - kept.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(mesh.triangles[t][k] == kept_of[before.triangles[t][k]]);
  }));
}

TEST_CASE("weld: how far off a mesh lies does not matter") {
  Mesh mesh;
  const Eigen::Vector3d far{4e6, -5e6, 1e9};
  for (const double x : {0.0, 0.5, 1.0, 1.0009, 0.4992, 0.502})
    mesh.positions.emplace_back(far + Eigen::Vector3d(x, 0, 0));
  const std::vector<Eigen::Vector3d> before = mesh.positions;
  const auto merged = snip::weld(mesh, 0.001, "name");
  REQUIRE(merged);
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{before[0], before[1], before[2], before[5]});
}

TEST_CASE("weld: distances that cannot work are refused") {
  Mesh mesh;
  mesh.positions = {{1e6, 0, 0}, {0, 0, 0}};
  const auto message = [&mesh](double distance) {
    const auto result = snip::weld(mesh, distance, "name");
    return result ? std::string("accepted") : result.error().message;
  };
  CHECK(message(1e-2) == "accepted");
  CHECK(message(0) == "the distance must be a positive number, not 0");
  CHECK(message(-1) == "the distance must be a positive number, not -1");
  CHECK(message(std::numeric_limits<double>::quiet_NaN()) ==
        "the distance must be a positive number, not nan");
  CHECK(
      message(1e-9).starts_with("name: the distance 1e-09 cannot be used: the mesh is more than 2^30 times"));
  CHECK(message(1e-200).starts_with("name: the distance 1e-200 cannot be used"));
}

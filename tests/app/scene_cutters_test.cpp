// Generated cutters: where their points and triangles lie.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <scenes/cutters.hpp>

using cut::TriangleMesh;
using Eigen::Vector3d;

namespace {

Vector3d normal(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += normal(mesh, t).norm() / 2;
  return sum;
}

}  // namespace

TEST_CASE("triangle, quad and plane") {
  CHECK(area(scenes::triangle({0, 0, 0}, {2, 0, 0}, {0, 0, 2})) == 2);
  const TriangleMesh quad = scenes::quad({0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1});
  CHECK(quad.triangles.size() == 2);
  CHECK(area(quad) == 2);
  CHECK(normal(quad, 0) == normal(quad, 1));
  const TriangleMesh plane = scenes::plane({1, 2, 3}, {4, 0, 0}, {0, 0, 6});
  CHECK(area(plane) == 24);
  CHECK(plane.positions[0] == Vector3d(-1, 2, 0));
  CHECK(plane.positions[2] == Vector3d(3, 2, 6));
}

TEST_CASE("a ribbon runs along its path and reaches half of through to either side") {
  const TriangleMesh mesh = scenes::ribbon({{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}, {0, 0, 2});
  CHECK(mesh.triangles.size() == 4);
  CHECK(mesh.positions.size() == 6);
  CHECK(area(mesh) == 8);
  for (const Vector3d& p : mesh.positions) CHECK(std::abs(p.z()) == 1);
}

TEST_CASE("a tube is a closed ribbon") {
  const TriangleMesh mesh = scenes::tube({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 0, 0.5});
  CHECK(mesh.triangles.size() == 8);
  CHECK(mesh.positions.size() == 8);
  CHECK(area(mesh) == 2);
}

TEST_CASE("the E has ten triangles: a spine and three arms") {
  const TriangleMesh mesh = scenes::e_shape({1, 1, 0}, {0, 4, 0}, {3, 0, 0}, {0, 0, 1});
  CHECK(mesh.triangles.size() == 10);
  CHECK(mesh.positions.size() == 12);
  CHECK(area(mesh) == 4 + 3 * 3);
  std::size_t across = 0;
  for (std::size_t t = 0; t < 10; ++t) across += normal(mesh, t).x() == 0;
  CHECK(across == 6);
}

TEST_CASE("a blade sweeps two triangles for each segment; a pivot leaves one without area") {
  const TriangleMesh mesh =
      scenes::swept({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, {{1, 0, 0}, {1, 0, 1}, {1, 0, 2}});
  CHECK(mesh.triangles.size() == 4);
  CHECK(area(mesh) == 2);
  const TriangleMesh turned = scenes::swept({{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {1, 0, 1}});
  CHECK(turned.triangles.size() == 2);
  CHECK(area(turned) == 0.5);
}

TEST_CASE("all ribbons of a star cross in its centre") {
  const TriangleMesh mesh = scenes::star({2, 3, 4}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, 5);
  CHECK(mesh.triangles.size() == 10);
  CHECK(area(mesh) == doctest::Approx(20));
  for (std::size_t k = 0; k < 5; ++k) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < 4; ++i) sum += mesh.positions[4 * k + i];
    CHECK((sum / 4 - Vector3d(2, 3, 4)).norm() < 1e-15);
    for (std::size_t other = 0; other < k; ++other)
      CHECK(normal(mesh, 2 * k).normalized().cross(normal(mesh, 2 * other).normalized()).norm() > 0.5);
  }
}

TEST_CASE("paths, joined and moved meshes") {
  const scenes::Path circle = scenes::circle_path({1, 1, 0}, {2, 0, 0}, {0, 1, 0}, 4);
  CHECK(circle == scenes::Path{{3, 1, 0}, {1, 2, 0}, {-1, 1, 0}, {1, 0, 0}});
  const scenes::Path wave = scenes::wave_path({0, 0, 0}, {4, 0, 0}, {0, 1, 0}, 1, 4);
  CHECK(wave == scenes::Path{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, -1, 0}, {4, 0, 0}});
  const TriangleMesh one = scenes::triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const TriangleMesh two = scenes::joined({one, scenes::moved(one, {0, 0, 5})});
  CHECK(two.positions.size() == 6);
  CHECK(two.triangles[1] == std::array<std::uint32_t, 3>{3, 4, 5});
  CHECK(two.positions[4] == Vector3d(1, 0, 5));
}

// Generated cloths: counts, topology, area, winding, and the same bits on every compiler.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <scenes/circle.hpp>
#include <scenes/cloths.hpp>
#include <scenes/surfaces.hpp>

using cut::TriangleMesh;

namespace {

struct Topology {
  long euler = 0;
  std::size_t border_edges = 0, crowded_edges = 0, reversed_edges = 0;
};

Topology topology(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> edges;  // times forwards, backwards
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      (a < b ? edges[{a, b}].first : edges[{b, a}].second) += 1;
    }
  Topology result;
  for (const auto& [edge, times] : edges) {
    result.border_edges += times.first + times.second == 1;
    result.crowded_edges += times.first + times.second > 2;
    result.reversed_edges += times.first == 2 || times.second == 2;
  }
  result.euler = static_cast<long>(mesh.positions.size()) - static_cast<long>(edges.size()) +
                 static_cast<long>(mesh.triangles.size());
  return result;
}

Eigen::Vector3d normal(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += normal(mesh, t).norm() / 2;
  return sum;
}

bool faces_up(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!(normal(mesh, t).z() > 0)) return false;
  return true;
}

std::uint64_t hash(const TriangleMesh& mesh) {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t bits) {
    for (int shift = 0; shift < 64; shift += 8) h = (h ^ (bits >> shift & 0xff)) * 0x100000001b3u;
  };
  for (const Eigen::Vector3d& p : mesh.positions)
    for (int i = 0; i < 3; ++i) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &p[i], sizeof bits);
      add(bits);
    }
  for (const auto& t : mesh.triangles)
    for (const auto corner : t) add(corner);
  return h;
}

void check_disc(const TriangleMesh& mesh, std::size_t nodes, std::size_t triangles, std::size_t border) {
  CHECK(mesh.positions.size() == nodes);
  CHECK(mesh.triangles.size() == triangles);
  const Topology t = topology(mesh);
  CHECK(t.euler == 1);
  CHECK(t.border_edges == border);
  CHECK(t.crowded_edges == 0);
  CHECK(t.reversed_edges == 0);
}

void check_closed(const TriangleMesh& mesh, std::size_t triangles, long euler) {
  CHECK(mesh.triangles.size() == triangles);
  const Topology t = topology(mesh);
  CHECK(t.euler == euler);
  CHECK(t.border_edges == 0);
  CHECK(t.crowded_edges == 0);
  CHECK(t.reversed_edges == 0);
}

}  // namespace

TEST_CASE("points on the circle agree with the C library and are exact at quarter turns") {
  for (int i = -2000; i <= 2000; ++i) {
    const double turns = i / 731.0;
    const Eigen::Vector2d p = scenes::circle_point(turns);
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    CHECK(std::abs(p.x() - std::cos(angle)) < 2e-15);
    CHECK(std::abs(p.y() - std::sin(angle)) < 2e-15);
    CHECK(std::abs(p.norm() - 1) < 4e-16);
  }
  CHECK(scenes::circle_point(0) == Eigen::Vector2d(1, 0));
  CHECK(scenes::circle_point(0.25) == Eigen::Vector2d(0, 1));
  CHECK(scenes::circle_point(0.5) == Eigen::Vector2d(-1, 0));
  CHECK(scenes::circle_point(-0.25) == Eigen::Vector2d(0, -1));
  CHECK(scenes::circle_point(7) == Eigen::Vector2d(1, 0));
}

TEST_CASE("the patch of the paper has twelve equilateral triangles") {
  const TriangleMesh mesh = scenes::twelve_triangles(2);
  check_disc(mesh, 12, 12, 10);
  CHECK(faces_up(mesh));
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      CHECK((mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm() ==
            doctest::Approx(2).epsilon(1e-15));
}

TEST_CASE("grids") {
  for (const auto diagonals : {scenes::Diagonals::uniform, scenes::Diagonals::alternating}) {
    const TriangleMesh mesh = scenes::grid(5, 3, 0.5, diagonals);
    check_disc(mesh, 24, 30, 16);
    CHECK(faces_up(mesh));
    CHECK(area(mesh) == 3.75);
    CHECK(mesh.positions[2 * 6 + 4] == Eigen::Vector3d(2, 1, 0));
  }
  CHECK(hash(scenes::grid(2, 2)) != hash(scenes::grid(2, 2, 1, scenes::Diagonals::alternating)));
}

TEST_CASE("hexagons") {
  for (std::size_t rings = 1; rings < 6; ++rings) {
    const TriangleMesh mesh = scenes::hexagon(rings);
    check_disc(mesh, 1 + 3 * rings * (rings + 1), 6 * rings * rings, 6 * rings);
    CHECK(faces_up(mesh));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      CHECK(normal(mesh, t).norm() / 2 == doctest::Approx(std::sqrt(3.0) / 4));
  }
}

TEST_CASE("fans") {
  const TriangleMesh mesh = scenes::fan(7, 3);
  check_disc(mesh, 8, 7, 7);
  CHECK(faces_up(mesh));
}

TEST_CASE("random sheets are discs with the border of the grid, any seed") {
  std::size_t most = 0, least = 99;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const TriangleMesh mesh = scenes::random_sheet(8, 6, 0.5, seed);
    check_disc(mesh, 63, 96, 28);
    CHECK(area(mesh) == doctest::Approx(12).epsilon(1e-13));
    double smallest = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      smallest = std::min(smallest, normal(mesh, t).z());
    CHECK(smallest >= 0.02 * 0.25);
    std::vector<std::size_t> degree(mesh.positions.size());
    for (const auto& t : mesh.triangles)
      for (const auto corner : t) ++degree[corner];
    for (std::size_t row = 1; row < 6; ++row)
      for (std::size_t column = 1; column < 8; ++column) {
        most = std::max(most, degree[row * 9 + column]);
        least = std::min(least, degree[row * 9 + column]);
      }
  }
  CHECK(least == 3);
  CHECK(most >= 10);
  CHECK(hash(scenes::random_sheet(8, 6, 0.5, 1)) != hash(scenes::random_sheet(8, 6, 0.5, 2)));
}

TEST_CASE("curved sheets") {
  const TriangleMesh mesh = scenes::curved_sheet(20, 2, 0.25);
  check_disc(mesh, 441, 800, 80);
  CHECK(faces_up(mesh));
  double low = 0, high = 0;
  for (const auto& p : mesh.positions) low = std::min(low, p.z()), high = std::max(high, p.z());
  CHECK(high <= 0.25);
  CHECK(high > 0.24);
  CHECK(low < -0.24);
}

TEST_CASE("spheres") {
  for (std::size_t level = 0; level < 4; ++level) {
    const TriangleMesh mesh = scenes::sphere(level, 2);
    check_closed(mesh, 20u << (2 * level), 2);
    for (const auto& p : mesh.positions) CHECK(p.norm() == doctest::Approx(2).epsilon(1e-15));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      CHECK(normal(mesh, t).dot(mesh.positions[mesh.triangles[t][0]]) > 0);
  }
}

TEST_CASE("torus, cylinder and Möbius strip") {
  const TriangleMesh torus = scenes::torus(16, 8);
  check_closed(torus, 256, 0);
  CHECK(torus.positions.size() == 128);
  for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
    const Eigen::Vector3d p = torus.positions[torus.triangles[t][0]];
    const Eigen::Vector3d ring = Eigen::Vector3d(p.x(), p.y(), 0).normalized();
    CHECK(normal(torus, t).dot(p - ring) > 0);
  }
  const Topology cylinder = topology(scenes::cylinder(12, 5));
  CHECK(cylinder.euler == 0);
  CHECK(cylinder.border_edges == 24);
  CHECK(cylinder.reversed_edges == 0);
  const TriangleMesh strip = scenes::moebius_strip(20, 3);
  CHECK(strip.triangles.size() == 120);
  const Topology moebius = topology(strip);
  CHECK(moebius.euler == 0);
  CHECK(moebius.border_edges == 40);
  CHECK(moebius.crowded_edges == 0);
  CHECK(moebius.reversed_edges == 3);
}

TEST_CASE("cloths have the same bits on every compiler and machine") {
  CHECK(hash(scenes::twelve_triangles(0.3)) == 0x7dd7d8bb91c454f5u);
  CHECK(hash(scenes::grid(7, 5, 0.1, scenes::Diagonals::alternating)) == 0x9b2990963202afbeu);
  CHECK(hash(scenes::hexagon(4, 0.7)) == 0x28996bea45d4eac1u);
  CHECK(hash(scenes::fan(11, 1.3)) == 0xdd8c546bdc30aa24u);
  CHECK(hash(scenes::random_sheet(20, 15, 0.1, 42)) == 0x501b80bb2fa054d8u);
  CHECK(hash(scenes::curved_sheet(30)) == 0x6d9c494c2f47a6a8u);
  CHECK(hash(scenes::sphere(3)) == 0x41ab568bd6ec7775u);
  CHECK(hash(scenes::torus(30, 14)) == 0x0446ced747875f2fu);
  CHECK(hash(scenes::cylinder(17, 6)) == 0xd8431af66d005c87u);
  CHECK(hash(scenes::moebius_strip(40, 5)) == 0xe19aa5586c370a5bu);
}

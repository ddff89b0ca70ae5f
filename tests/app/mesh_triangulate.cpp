// Triangulating the polygons of mesh files.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "snip/mesh_file/triangulate.hpp"

using Eigen::Vector3d;
using snip::Triangle;

namespace {

// Twice the vector area of a polygon.
Vector3d area_of(const std::vector<Vector3d>& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum;
}

// The triangles cover the polygon exactly once: none is turned over, and their areas add up to that of the
// polygon (were one outside or doubled, the sum of absolute areas would be larger).
void check_covers(const std::vector<Vector3d>& polygon) {
  std::vector<Triangle> triangles;
  snip::triangulate_polygon(polygon, triangles);
  REQUIRE(triangles.size() == polygon.size() - 2);
  const Vector3d area = area_of(polygon);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    REQUIRE(std::max({a, b, c}) < polygon.size());
    const Vector3d part = (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]);
    CHECK(part.dot(area) >= -1e-9 * area.squaredNorm());
    sum += part.norm();
  }
  CHECK(sum == doctest::Approx(area.norm()).epsilon(1e-9));
}

std::vector<Vector3d> flat(const std::vector<std::array<double, 2>>& points) {
  std::vector<Vector3d> polygon;
  for (const auto& [x, y] : points) polygon.emplace_back(x, y, 0);
  return polygon;
}

Eigen::Quaterniond random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

}  // namespace

TEST_CASE("triangulate: less than four corners") {
  std::vector<Triangle> triangles;
  snip::triangulate_polygon({}, triangles);
  snip::triangulate_polygon(flat({{0, 0}, {1, 0}}), triangles);
  CHECK(triangles.empty());
  snip::triangulate_polygon(flat({{0, 0}, {0, 1}, {1, 0}}), triangles);
  CHECK(triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("triangulate: quadrilaterals take the better diagonal, and the only one when concave") {
  const auto split = [](const std::vector<Vector3d>& polygon) {
    std::vector<Triangle> triangles;
    snip::triangulate_polygon(polygon, triangles);
    check_covers(polygon);
    return triangles;
  };
  const std::vector<Triangle> along_02 = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Triangle> along_13 = {{0, 1, 3}, {1, 2, 3}};
  CHECK(split(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})) == along_02);
  CHECK(split(flat({{0, 0}, {1, 0}, {3, 1}, {2, 1}})) == along_13);
  CHECK(split(flat({{0, 0}, {2, 1}, {0, 2}, {1, 1}})) == along_13);
  CHECK(split(flat({{1, 1}, {0, 0}, {2, 1}, {0, 2}})) == along_02);
}

TEST_CASE("triangulate: concave shapes, every rotation of the corners, both windings") {
  const std::vector<std::vector<Vector3d>> shapes = {
      flat({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}),
      flat({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}),
      // Corners on straight sides.
      flat({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}),
      flat({{0, 0}, {1, 0}, {2, 0}, {1, 2}}),
      // A square with a square hole, joined by a bridge that is passed twice.
      flat({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}),
      // A spiral.
      flat({{0, 0}, {5, 0}, {5, 5}, {1, 5}, {1, 2}, {3, 2}, {3, 3}, {2, 3}, {2, 4}, {4, 4}, {4, 1}, {0, 1}}),
      // A comb.
      flat({{0, 0}, {7, 0}, {7, 3}, {6, 1}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}}),
  };
  std::mt19937 random(1);
  for (const auto& shape : shapes)
    for (std::size_t turn = 0; turn < shape.size(); ++turn) {
      std::vector<Vector3d> polygon = shape;
      std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(turn), polygon.end());
      check_covers(polygon);
      std::reverse(polygon.begin(), polygon.end());
      check_covers(polygon);
      const Eigen::Quaterniond rotation = random_rotation(random);
      for (Vector3d& p : polygon) p = rotation * p + Vector3d(10, 20, 30);
      check_covers(polygon);
    }
}

TEST_CASE("triangulate: random star-shaped polygons in random planes") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 300; ++round) {
    const std::size_t corners = 4 + random() % 60;
    const Eigen::Quaterniond rotation = random_rotation(random);
    std::vector<Vector3d> polygon;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = 0.1 + unit(random);
      polygon.push_back(rotation * Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0) +
                        Vector3d(3, -2, 1));
    }
    check_covers(polygon);
  }
}

TEST_CASE("triangulate: any polygon gives corners - 2 triangles of its corners, and comes to an end") {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const std::size_t corners = 3 + random() % 40;
    std::vector<Vector3d> polygon;
    // A coarse grid makes repeated, collinear and crossing corners; every third polygon is flat, some a
    // point.
    const auto steps = 1 + static_cast<unsigned>(round) % 5;
    for (std::size_t i = 0; i < corners; ++i)
      polygon.emplace_back(random() % steps, random() % steps, round % 3 == 0 ? 0 : random() % steps);
    std::vector<Triangle> triangles;
    snip::triangulate_polygon(polygon, triangles);
    CHECK(triangles.size() == corners - 2);
    for (const auto& [a, b, c] : triangles) CHECK(std::max({a, b, c}) < corners);
  }
}

TEST_CASE("triangulate: the largest polygon, a spiral, in a second") {
  std::vector<Vector3d> polygon(snip::max_polygon_corners);
  const std::size_t half = polygon.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    const double angle = 0.01 * static_cast<double>(i);
    const Vector3d direction(std::cos(angle), std::sin(angle), 0);
    polygon[i] = direction * (1 + angle);
    polygon[polygon.size() - 1 - i] = direction * (0.5 + angle);
  }
  check_covers(polygon);
}

TEST_CASE("triangulate: corners on a straight side do not leave a flat triangle") {
  // A modeller leaves them where a neighbour is finer. Rounding once decided whether such a side became a
  // triangle, which was dropped, so that the sheet tore.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 2000; ++round) {
    CAPTURE(round);
    // A convex outline with up to four extra corners on each side.
    std::vector<Eigen::Vector3d> outline;
    const std::size_t sides = 3 + random() % 4;
    const Eigen::Vector3d u = Eigen::Vector3d(number(random), number(random), number(random)).normalized();
    const Eigen::Vector3d v =
        u.cross(Eigen::Vector3d(number(random), number(random), number(random))).normalized();
    for (std::size_t i = 0; i < sides; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(sides);
      outline.emplace_back(u * std::cos(angle) + v * (0.2 + 0.1 * number(random)) * std::sin(angle));
    }
    std::vector<Eigen::Vector3d> polygon;
    for (std::size_t i = 0; i < sides; ++i) {
      const Eigen::Vector3d& next = outline[(i + 1) % sides];
      const auto extra = static_cast<int>(random() % 5);
      for (int k = 0; k <= extra; ++k)
        polygon.emplace_back(outline[i] + (next - outline[i]) * (double(k) / (extra + 1)));
    }
    std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random() % polygon.size()),
                polygon.end());
    std::vector<snip::Triangle> triangles;
    snip::triangulate_polygon(polygon, triangles);
    REQUIRE(triangles.size() == polygon.size() - 2);
    for (const auto& t : triangles) {
      const double area = (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]).norm();
      CHECK(area > 1e-6);
    }
  }
}

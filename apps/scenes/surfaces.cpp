// Curved cloths, see surfaces.hpp.
#include "scenes/surfaces.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "scenes/circle.hpp"
#include "scenes/cloths.hpp"

namespace scenes {
namespace {

using cut::TriangleMesh;
using Index = std::uint32_t;

void add_cell(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  const auto i = [](std::size_t index) { return static_cast<Index>(index); };
  mesh.triangles.push_back({i(a), i(b), i(c)});
  mesh.triangles.push_back({i(a), i(c), i(d)});
}

double ratio(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// Written out, since a library is free in the order of its sums.
Eigen::Vector3d on_sphere(const Eigen::Vector3d& p, double radius) {
  return p * (radius / std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z()));
}

}  // namespace

TriangleMesh curved_sheet(std::size_t cells, double side, double height) {
  TriangleMesh mesh = grid(cells, cells, side / static_cast<double>(cells));
  for (std::size_t row = 0; row <= cells; ++row)
    for (std::size_t column = 0; column <= cells; ++column) {
      const double wave_x = circle_point(1.5 * ratio(column, cells)).y(),
                   wave_y = circle_point(ratio(row, cells)).x();
      mesh.positions[row * (cells + 1) + column].z() = height * wave_x * wave_y;
    }
  return mesh;
}

TriangleMesh sphere(std::size_t level, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Eigen::Vector3d& p : mesh.positions) p = on_sphere(p, radius);
  for (std::size_t step = 0; step < level; ++step) {
    std::map<std::pair<Index, Index>, Index> middle;
    auto middle_of = [&](Index a, Index b) {
      const auto [entry, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.positions.size()));
      if (is_new) {
        const Eigen::Vector3d sum = mesh.positions[entry->first.first] + mesh.positions[entry->first.second];
        mesh.positions.push_back(on_sphere(sum, radius));
      }
      return entry->second;
    };
    const auto coarse = std::exchange(mesh.triangles, {});
    for (const auto& [a, b, c] : coarse) {
      const Index ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      mesh.triangles.insert(mesh.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }
  return mesh;
}

TriangleMesh torus(std::size_t around, std::size_t through, double radius, double tube_radius) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < around; ++i)
    for (std::size_t j = 0; j < through; ++j) {
      const Eigen::Vector2d u = circle_point(ratio(i, around)), v = circle_point(ratio(j, through));
      const double distance = radius + tube_radius * v.x();
      mesh.positions.emplace_back(distance * u.x(), distance * u.y(), tube_radius * v.y());
      const std::size_t next = (i + 1) % around * through, above = (j + 1) % through;
      add_cell(mesh, i * through + j, next + j, next + above, i * through + above);
    }
  return mesh;
}

TriangleMesh cylinder(std::size_t around, std::size_t along, double radius, double height) {
  TriangleMesh mesh;
  for (std::size_t row = 0; row <= along; ++row)
    for (std::size_t i = 0; i < around; ++i) {
      const Eigen::Vector2d u = circle_point(ratio(i, around)) * radius;
      mesh.positions.emplace_back(u.x(), u.y(), height * ratio(row, along));
      const std::size_t a = row * around + i, b = row * around + (i + 1) % around;
      if (row < along) add_cell(mesh, a, b, b + around, a + around);
    }
  return mesh;
}

TriangleMesh moebius_strip(std::size_t around, std::size_t across, double radius, double width) {
  TriangleMesh mesh;
  const std::size_t stride = across + 1;
  for (std::size_t i = 0; i < around; ++i) {
    const Eigen::Vector2d u = circle_point(ratio(i, around)), half = circle_point(ratio(i, 2 * around));
    for (std::size_t j = 0; j <= across; ++j) {
      const double s = width * (ratio(j, across) - 0.5), distance = radius + s * half.x();
      mesh.positions.emplace_back(distance * u.x(), distance * u.y(), s * half.y());
    }
  }
  // The twist joins the last column to the first upside down.
  const auto node = [&](std::size_t i, std::size_t j) { return i < around ? i * stride + j : across - j; };
  for (std::size_t i = 0; i < around; ++i)
    for (std::size_t j = 0; j < across; ++j)
      add_cell(mesh, node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
  return mesh;
}

}  // namespace scenes

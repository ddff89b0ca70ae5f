// Flat cloths, see cloths.hpp. Loops are in the order in which nodes and triangles are numbered.
#include "scenes/cloths.hpp"

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "scenes/circle.hpp"
#include "scenes/random.hpp"

namespace scenes {
namespace {

using cut::TriangleMesh;
using Index = std::uint32_t;

void add_triangle(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c) {
  mesh.triangles.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
}

double doubled_area(const TriangleMesh& mesh, Index a, Index b, Index c) {
  const Eigen::Vector3d& p = mesh.positions[a];
  const Eigen::Vector3d u = mesh.positions[b] - p, v = mesh.positions[c] - p;
  return u.x() * v.y() - u.y() * v.x();
}

/// Turns the diagonal of the two triangles at a random inner edge, where both stay larger than `least`.
void flip_edges(TriangleMesh& mesh, std::size_t attempts, double least, Random& random) {
  std::map<std::pair<Index, Index>, std::size_t> side;  // directed edge → its triangle
  auto enter = [&](std::size_t t) {
    const auto& corner = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) side[{corner[i], corner[(i + 1) % 3]}] = t;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) enter(t);
  for (std::size_t attempt = 0; attempt < attempts; ++attempt) {
    const std::size_t t = random.below(mesh.triangles.size()), i = random.below(3);
    const Index a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3],
                c = mesh.triangles[t][(i + 2) % 3];
    const auto twin = side.find({b, a});
    if (twin == side.end()) continue;
    const std::size_t other = twin->second;
    Index d = 0;
    for (const Index corner : mesh.triangles[other])
      if (corner != a && corner != b) d = corner;
    if (side.count({c, d}) + side.count({d, c}) > 0) continue;
    if (doubled_area(mesh, a, d, c) < least || doubled_area(mesh, d, b, c) < least) continue;
    side.erase({a, b});
    side.erase({b, a});
    mesh.triangles[t] = {a, d, c};
    mesh.triangles[other] = {d, b, c};
    enter(t);
    enter(other);
  }
}

}  // namespace

TriangleMesh twelve_triangles(double side) {
  TriangleMesh mesh;
  const double height = side * std::sqrt(3.0) / 2;
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 4; ++i)
      mesh.positions.emplace_back((i + (row == 1 ? 0.5 : 0.0)) * side, row * height, 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    add_triangle(mesh, i, i + 1, i + 4);
    add_triangle(mesh, i + 1, i + 5, i + 4);
  }
  for (std::size_t i = 4; i < 7; ++i) {
    add_triangle(mesh, i, i + 5, i + 4);
    add_triangle(mesh, i, i + 1, i + 5);
  }
  return mesh;
}

TriangleMesh grid(std::size_t columns, std::size_t rows, double spacing, Diagonals diagonals) {
  TriangleMesh mesh;
  const std::size_t stride = columns + 1;
  mesh.positions.reserve(stride * (rows + 1));
  mesh.triangles.reserve(2 * columns * rows);
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t column = 0; column <= columns; ++column)
      mesh.positions.emplace_back(static_cast<double>(column) * spacing, static_cast<double>(row) * spacing,
                                  0.0);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t a = row * stride + column, b = a + 1, c = b + stride, d = a + stride;
      if (diagonals == Diagonals::uniform || (row + column) % 2 == 0) {
        add_triangle(mesh, a, b, c);
        add_triangle(mesh, a, c, d);
      } else {
        add_triangle(mesh, a, b, d);
        add_triangle(mesh, b, c, d);
      }
    }
  return mesh;
}

TriangleMesh hexagon(std::size_t rings, double side) {
  TriangleMesh mesh;
  const double height = side * std::sqrt(3.0) / 2;
  const std::size_t rows = 2 * rings + 1;
  auto count = [&](std::size_t row) { return row <= rings ? rings + 1 + row : rings + 1 + (rows - 1 - row); };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < count(row); ++i) {
      const double across = static_cast<double>(i) - static_cast<double>(count(row) - 1) / 2;
      const double up = static_cast<double>(row) - static_cast<double>(rings);
      mesh.positions.emplace_back(across * side, up * height, 0.0);
    }
  for (std::size_t row = 0, first = 0; row + 1 < rows; first += count(row), ++row) {
    const std::size_t here = count(row), next = first + here;
    // The longer of the two rows carries one triangle more.
    const bool widening = row < rings;
    for (std::size_t i = 0; i < here; ++i) {
      const std::size_t up = next + i;
      if (widening) {
        add_triangle(mesh, first + i, up + 1, up);
        if (i + 1 < here) add_triangle(mesh, first + i, first + i + 1, up + 1);
      } else if (i + 1 < here) {
        add_triangle(mesh, first + i, first + i + 1, up);
        if (i + 2 < here) add_triangle(mesh, first + i + 1, up + 1, up);
      }
    }
  }
  return mesh;
}

TriangleMesh fan(std::size_t count, double radius) {
  TriangleMesh mesh;
  mesh.positions.emplace_back(0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d p = circle_point(static_cast<double>(i) / static_cast<double>(count)) * radius;
    mesh.positions.emplace_back(p.x(), p.y(), 0.0);
    add_triangle(mesh, 0, 1 + i, 1 + (i + 1) % count);
  }
  return mesh;
}

TriangleMesh random_sheet(std::size_t columns, std::size_t rows, double spacing, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh = grid(columns, rows, spacing);
  // A quarter of a cell is where a corner of a cell could reach its diagonal.
  const double reach = 0.24 * spacing;
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t column = 0; column <= columns; ++column) {
      Eigen::Vector3d& p = mesh.positions[row * (columns + 1) + column];
      const double dx = random.between(-reach, reach), dy = random.between(-reach, reach);
      if (column > 0 && column < columns) p.x() += dx;
      if (row > 0 && row < rows) p.y() += dy;
    }
  flip_edges(mesh, 6 * mesh.triangles.size(), 0.02 * spacing * spacing, random);
  return mesh;
}

}  // namespace scenes

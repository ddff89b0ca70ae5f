#include "cutting/experiments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>

#include "scenes/circle.hpp"
#include "scenes/cutters.hpp"
#include "scenes/surfaces.hpp"

namespace cutting {
namespace {

using Eigen::Vector3d;

cut::TriangleMesh sheet(std::size_t cells) {
  const auto side = static_cast<double>(cells);
  return scenes::curved_sheet(cells, side, 0.1 * side);
}

/// The same points on the sheet: its formula, see scenes::curved_sheet.
scenes::Path on_sheet(scenes::Path path, std::size_t cells) {
  const auto side = static_cast<double>(cells);
  for (Vector3d& p : path)
    p.z() =
        0.1 * side * scenes::circle_point(1.5 * p.x() / side).y() * scenes::circle_point(p.y() / side).x();
  return path;
}

/// The quads that the blade from -half to half sweeps while its middle follows the path.
std::vector<cut::TriangleMesh> sweeps(const scenes::Path& path, const Vector3d& half) {
  std::vector<cut::TriangleMesh> result;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    result.push_back(
        scenes::swept({path[i] - half, path[i] + half}, {path[i + 1] - half, path[i + 1] + half}));
  return result;
}

Progressive round_corner(std::size_t cells, const Vector3d& half) {
  scenes::Path path;
  for (std::size_t i = 0; i <= step_count; ++i) {
    // A little more than a quarter turn, to begin and end outside of the sheet.
    const double part = static_cast<double>(i) / static_cast<double>(step_count);
    const double radius = 12.2 + 0.4 * scenes::circle_point(1.3 * part).y();
    const Eigen::Vector2d p = radius * scenes::circle_point(0.26 * part - 0.005);
    path.emplace_back(p.x(), p.y(), 0);
  }
  return {sheet(cells), sweeps(on_sheet(path, cells), half)};
}

const Vector3d leaning{0.19, -0.23, 1};

std::size_t count_pieces(const cut::TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t x) {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::set<std::uint32_t> roots;
  for (const auto& t : mesh.triangles) roots.insert(root(t[0]));
  return roots.size();
}

}  // namespace

Progressive across_sheet(std::size_t cells) {
  const auto side = static_cast<double>(cells);
  const scenes::Path path = scenes::wave_path({-0.01 * side, 0.31 * side, 0}, {1.01 * side, 0.67 * side, 0},
                                              {0, 0.08 * side, 0}, 1.3, step_count);
  return {sheet(cells), sweeps(on_sheet(path, cells), 0.1 * side * leaning)};
}

Progressive round_corner_upright(std::size_t cells) { return round_corner(cells, {0, 0, 2}); }
Progressive round_corner_leaning(std::size_t cells) { return round_corner(cells, 2 * leaning); }

OneShot wave_across(std::size_t cells) {
  const auto side = static_cast<double>(cells);
  OneShot result;
  result.cloth = sheet(cells);
  result.path = scenes::wave_path({-0.02 * side, 0.29 * side, 0}, {1.02 * side, 0.71 * side, 0},
                                  {0, 0.12 * side, 0}, 1.7, 64);
  result.ribbon = scenes::ribbon(result.path, {0, 0, 0.3 * side});
  return result;
}

double OneShot::side(double x, double y) const {
  std::size_t i = 1;
  while (i + 1 < path.size() && path[i].x() < x) ++i;
  const Vector3d &a = path[i - 1], &b = path[i];
  return y - (a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
}

double smallest_angle(const cut::TriangleMesh& mesh) {
  double smallest = 180;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d a = mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]];
      const Vector3d b = mesh.positions[t[(k + 2) % 3]] - mesh.positions[t[k]];
      const Vector3d normal{a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                            a.x() * b.y() - a.y() * b.x()};
      smallest = std::min(smallest, std::atan2(normal.norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
  return smallest;
}

void describe(const cut::TriangleMesh& mesh, OneShotResult& result) {
  result.pieces = count_pieces(mesh);
  result.render_triangles = result.physics_triangles = mesh.triangles.size();
  result.smallest_render_angle = result.smallest_physics_angle = smallest_angle(mesh);
}

}  // namespace cutting

/// @file
/// Polygons for the tests of this folder, and what must hold for a triangulation of one.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lattice/orientation.hpp"

namespace cut::lattice {

/// A hull and holes, as `triangulate` takes them.
struct Polygon {
  std::vector<LatticePoint> points;
  std::vector<std::uint32_t> loop_ends;

  void add_loop(const std::vector<LatticePoint>& loop) {
    points.insert(points.end(), loop.begin(), loop.end());
    loop_ends.push_back(static_cast<std::uint32_t>(points.size()));
  }
  /// The corner after corner i on its loop.
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const {
    const auto loop = std::upper_bound(loop_ends.begin(), loop_ends.end(), i);
    return i + 1 < *loop ? i + 1 : (loop == loop_ends.begin() ? 0 : *(loop - 1));
  }
  [[nodiscard]] std::int64_t doubled_area() const {
    std::int64_t area = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) area += orientation({}, points[i], points[next(i)]);
    return area;
  }
};

/// Polygon from loops in small coordinates, moved away from the border of the lattice and scaled.
inline Polygon polygon(const std::vector<std::vector<LatticePoint>>& loops, std::int32_t scale = 1000,
                       LatticePoint origin = {12345, 54321}) {
  Polygon result;
  for (auto loop : loops) {
    for (LatticePoint& p : loop) p = {origin.x + p.x * scale, origin.y + p.y * scale};
    result.add_loop(loop);
  }
  return result;
}

/// True when the open triangles a and b have a point in common (separating axes; exact).
inline bool interiors_meet(const std::array<LatticePoint, 3>& a, const std::array<LatticePoint, 3>& b) {
  const auto separated = [](const auto& t, const auto& u) {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::all_of(u.begin(), u.end(),
                      [&](LatticePoint p) { return orientation(t[i], t[(i + 1) % 3], p) <= 0; }))
        return true;
    return false;
  };
  return !separated(a, b) && !separated(b, a);
}

/// What is wrong with a triangulation, empty when nothing is. `by_corner`: edges must agree as pairs of
/// corners and not just as pairs of positions, which is so unless loops given as separate touch.
inline std::string fault(const Polygon& polygon, std::span<const std::array<std::uint32_t, 3>> triangles,
                         bool by_corner = true, bool compare_all = true) {
  using Edge = std::pair<LatticePoint, LatticePoint>;
  std::int64_t area = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corner_edges;
  std::vector<Edge> edges;
  std::vector<std::array<LatticePoint, 3>> shapes;
  for (const auto& t : triangles) {
    for (const std::uint32_t corner : t)
      if (corner >= polygon.points.size()) return "corner out of range";
    shapes.push_back({polygon.points[t[0]], polygon.points[t[1]], polygon.points[t[2]]});
    const std::int64_t doubled = orientation(shapes.back()[0], shapes.back()[1], shapes.back()[2]);
    if (doubled <= 0) return "triangle without positive area";
    area += doubled;
    for (std::size_t k = 0; k < 3; ++k) {
      corner_edges.emplace_back(t[k], t[(k + 1) % 3]);
      edges.emplace_back(shapes.back()[k], shapes.back()[(k + 1) % 3]);
    }
  }
  if (area != polygon.doubled_area()) return "areas differ";
  if (compare_all)
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t j = i + 1; j < shapes.size(); ++j)
        if (interiors_meet(shapes[i], shapes[j])) return "triangles overlap";
  // Each directed edge of a triangle occurs once. It is an edge of the polygon, or else another triangle has
  // its reverse.
  std::sort(edges.begin(), edges.end());
  std::sort(corner_edges.begin(), corner_edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return "edge used twice";
  std::vector<Edge> contour;
  for (std::uint32_t i = 0; i < polygon.points.size(); ++i) {
    const std::uint32_t j = polygon.next(i);
    contour.emplace_back(polygon.points[i], polygon.points[j]);
    if (!std::binary_search(edges.begin(), edges.end(), contour.back())) return "edge of the polygon lost";
    if (by_corner && !std::binary_search(corner_edges.begin(), corner_edges.end(), std::pair(i, j)))
      return "edge of the polygon at another corner";
  }
  std::sort(contour.begin(), contour.end());
  for (const auto& [from, to] : edges)
    if (!std::binary_search(contour.begin(), contour.end(), Edge(from, to)) &&
        !std::binary_search(edges.begin(), edges.end(), Edge(to, from)))
      return "open edge inside";
  if (by_corner)
    for (const auto& [from, to] : corner_edges) {
      const bool outer = polygon.next(from) == to;
      const bool paired = std::binary_search(corner_edges.begin(), corner_edges.end(), std::pair(to, from));
      if (outer == paired && polygon.next(to) != from) return "corners do not match across an edge";
    }
  return {};
}

}  // namespace cut::lattice

/// @file
/// Random drawings of segments in a triangle for the tests of planar graphs and faces: in a block of
/// neighbouring lattice points, where rounding does most, and all over the triangle.
#pragma once
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "lattice/planar_graph.hpp"

namespace cut::lattice {

using Segment = std::pair<LatticePoint, LatticePoint>;

/// Where the points of a drawing lie: in a block of 12 × 12 lattice points, or also on the sides and
/// anywhere.
struct PointSource {
  LatticePoint block;
  int beside_block;  ///< of ten points, how many are not in the block

  [[nodiscard]] LatticePoint draw() const {
    if (*rc::gen::inRange(0, 10) < beside_block) {
      if (*rc::gen::inRange(0, 2) == 0)
        return lattice_point_on_edge(*rc::gen::inRange<std::size_t>(0, 3),
                                     *rc::gen::inRange(0, lattice_size));
      const std::int32_t x = *rc::gen::inRange(0, lattice_size + 1);
      return {x, *rc::gen::inRange(0, lattice_size - x + 1)};
    }
    LatticePoint p{block.x + *rc::gen::inRange(0, 12), block.y + *rc::gen::inRange(0, 12)};
    p.x = std::min(p.x, lattice_size);
    p.y = std::min(p.y, lattice_size - p.x);
    return p;
  }
};

/// Blocks in the middle, at a corner, at each side, and points from elsewhere or not.
inline PointSource random_source() {
  constexpr std::int32_t n = lattice_size;
  const auto block = *rc::gen::elementOf(std::vector<LatticePoint>{
      {n / 3, n / 3}, {0, 0}, {n - 11, 0}, {0, n - 11}, {n / 5, 0}, {0, n / 7}, {n / 2 - 5, n / 2 - 5}});
  return {block, *rc::gen::element(0, 0, 2, 5)};
}

/// Up to `most` segments between points of the source, none without length.
inline std::vector<Segment> random_segments(const PointSource& source, int most) {
  std::vector<Segment> segments;
  const int count = *rc::gen::inRange(1, most + 1);
  for (int i = 0; i < count; ++i) {
    const Segment s{source.draw(), source.draw()};
    if (s.first != s.second) segments.push_back(s);
  }
  return segments;
}

/// A triangle without cuts.
inline PlanarGraph empty_graph() {
  PlanarGraph graph;
  for (std::size_t i = 0; i < 3; ++i) graph.points.push_back(lattice_corner(i));
  return graph;
}

/// Adds segments as a cut does: first the nodes at their ends, then all edges at once.
inline void draw(PlanarGraph& graph, const std::vector<Segment>& segments) {
  std::vector<GraphEdge> edges;
  for (const auto& [a, b] : segments) {
    const std::uint32_t from = insert_node(graph, a);
    const std::uint32_t to = insert_node(graph, b);
    edges.push_back({from, to, 0, 0, 0, true});
  }
  insert_edges(graph, std::move(edges));
}

}  // namespace cut::lattice

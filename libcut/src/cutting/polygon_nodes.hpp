/// @file
/// Which nodes lie on which polygon of a triangle, and what can be seen from where: merges stay within one
/// polygon and do not reach across a cut.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cut/arrangement.hpp"
#include "lattice/orientation.hpp"
#include "lattice/planar_graph.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {

/// True when no edge crosses the open segment from p to q. Edges that merely touch it do not hide anything.
template <class Edges, class PointOf>
bool visible(LatticePoint p, LatticePoint q, const Edges& edges, const PointOf& point_of) {
  return std::none_of(edges.begin(), edges.end(), [&](const auto& e) {
    return lattice::cross_properly(p, q, point_of(e.from), point_of(e.to));
  });
}

/// Nodes of each polygon, sorted. Adds the two ends of every edge and every section to the polygons beside
/// it.
class PolygonNodes {
 public:
  explicit PolygonNodes(std::size_t polygons) : nodes_(polygons) {}

  void add(std::uint32_t polygon, std::uint32_t node) { nodes_[polygon].push_back(node); }
  void finish() {
    for (auto& list : nodes_) {
      lattice::sort_unique(list);
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t polygon) const { return nodes_[polygon]; }

 private:
  std::vector<std::vector<std::uint32_t>> nodes_;
};

/// The nodes of an arrangement's polygons.
inline PolygonNodes nodes_of_polygons(const Arrangement& arrangement) {
  PolygonNodes result(arrangement.polygons.size());
  for (const CutEdge& e : arrangement.edges)
    for (const std::uint32_t polygon : {e.left, e.right}) {
      result.add(polygon, e.from);
      result.add(polygon, e.to);
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::uint32_t k = 0; k < arrangement.section_polygons[i].size(); ++k) {
      result.add(arrangement.section_polygons[i][k], arrangement.edge_node(i, k));
      result.add(arrangement.section_polygons[i][k], arrangement.edge_node(i, k + 1));
    }
  result.finish();
  return result;
}

}  // namespace cut

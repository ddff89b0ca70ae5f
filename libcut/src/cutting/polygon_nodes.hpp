/// @file
/// Which nodes lie on which polygon of a triangle, and what can be seen from where: merges stay within one
/// polygon and do not reach across a cut.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
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
  explicit PolygonNodes(std::size_t polygons) : first_(polygons + 1) { all_.reserve(32); }

  void add(std::uint32_t polygon, std::uint32_t node) { all_.push_back({polygon, node}); }
  void finish() {
    lattice::sort_unique(all_);
    nodes_.reserve(all_.size());
    for (const auto& [polygon, node] : all_) {
      nodes_.push_back(node);
      first_[polygon + 1] = nodes_.size();
    }
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] = std::max(first_[p], first_[p - 1]);
  }
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t polygon) const {
    return {nodes_.data() + first_[polygon], nodes_.data() + first_[polygon + 1]};
  }

 private:
  std::vector<std::array<std::uint32_t, 2>> all_;  ///< polygon, node
  std::vector<std::uint32_t> nodes_;
  std::vector<std::size_t> first_;  ///< per polygon (+1), in nodes_
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

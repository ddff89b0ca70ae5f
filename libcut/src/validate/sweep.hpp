/// @file
/// A sweep line over an arrangement, after Shamos and Hoey: finds out whether any two edges cross, and what
/// lies below each node. Exact. In: an arrangement and its graph. Out: the first conflict, nearest edges.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "validate/planar_graph.hpp"

namespace cut::validation {

struct Sweep {
  std::string conflict;  ///< two elements that meet where they must not; empty: the arrangement is planar
  /// Per node: the edge next below it that does not end there; `outside` when there is none.
  std::vector<std::uint32_t> below;
};

/// Nodes are distinct, no node lies on an edge that it does not end, no two edges cross or overlap.
/// @pre all points lie in the triangle. O(n log n)
[[nodiscard]] Sweep sweep(const Arrangement& arrangement, const std::vector<GraphEdge>& edges);

}  // namespace cut::validation

/// @file
/// An arrangement seen as a graph: the sections of the triangle's border and the cuts inside, each with the
/// polygons at its sides. In: an arrangement. Out: edges, and the walks round its faces.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/arrangement.hpp"

namespace cut::validation {

/// Edge from → to and the polygon on its left and on its right.
struct GraphEdge {
  std::uint32_t from;
  std::uint32_t to;
  std::uint32_t left;
  std::uint32_t right;
};

/// The "polygon" outside of the triangle.
inline constexpr std::uint32_t outside = 0xffffffffu;

/// All sections in counterclockwise order, then all cut edges.
[[nodiscard]] std::vector<GraphEdge> graph_of(const Arrangement& arrangement);

/// Half-edge 2e runs along edge e, half-edge 2e + 1 against it.
[[nodiscard]] inline std::uint32_t origin(const std::vector<GraphEdge>& edges, std::size_t half) {
  return half % 2 == 0 ? edges[half / 2].from : edges[half / 2].to;
}
[[nodiscard]] inline std::uint32_t left_of(const std::vector<GraphEdge>& edges, std::size_t half) {
  return half % 2 == 0 ? edges[half / 2].left : edges[half / 2].right;
}

/// For each half-edge the one that follows it round the face on its left, by exact angular order.
/// @pre no two edges overlap, no edge has length zero. O(n log n)
[[nodiscard]] std::vector<std::uint32_t> face_walk(const Arrangement& arrangement,
                                                   const std::vector<GraphEdge>& edges);

}  // namespace cut::validation

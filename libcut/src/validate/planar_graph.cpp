/// @file
/// Graph and face walks of an arrangement.
#include "validate/planar_graph.hpp"

#include <algorithm>

#include "lattice/orientation.hpp"

namespace cut::validation {

std::vector<GraphEdge> graph_of(const Arrangement& arrangement) {
  std::vector<GraphEdge> edges;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::uint32_t k = 0; k <= arrangement.boundary_counts[i]; ++k)
      edges.push_back({arrangement.edge_node(i, k), arrangement.edge_node(i, k + 1),
                       arrangement.section_polygons[i][k], outside});
  for (const CutEdge& e : arrangement.edges) edges.push_back({e.from, e.to, e.left, e.right});
  return edges;
}

std::vector<std::uint32_t> face_walk(const Arrangement& arrangement, const std::vector<GraphEdge>& edges) {
  const auto direction = [&](std::uint32_t half) {
    using lattice::operator-;
    return arrangement.nodes[origin(edges, half ^ 1u)].point - arrangement.nodes[origin(edges, half)].point;
  };
  std::vector<std::uint32_t> order(2 * edges.size());
  for (std::size_t h = 0; h < order.size(); ++h) order[h] = static_cast<std::uint32_t>(h);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from_a = origin(edges, a);
    const std::uint32_t from_b = origin(edges, b);
    return from_a != from_b ? from_a < from_b : lattice::angle_less(direction(a), direction(b));
  });

  // Having come along h, the face on the left goes on along the first edge clockwise from the way back.
  std::vector<std::uint32_t> next(order.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && origin(edges, order[end]) == origin(edges, order[begin])) ++end;
    for (std::size_t i = begin; i < end; ++i) next[order[i] ^ 1u] = order[i == begin ? end - 1 : i - 1];
    begin = end;
  }
  return next;
}

}  // namespace cut::validation

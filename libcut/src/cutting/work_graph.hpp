/// @file
/// How the nodes of a TriangleWork's graph lie on the sides of its triangle. Nodes are numbered as in
/// Arrangement: corners, boundary nodes of sides 0, 1, 2 counterclockwise, inner nodes.
#pragma once
#include <cstdint>

#include "cutting/state.hpp"
#include "lattice/intersection.hpp"

namespace cut {

/// Index of the k-th node along side i, counterclockwise from its corner.
inline std::uint32_t side_node(const TriangleWork& work, std::size_t i, std::uint32_t k) {
  if (k == 0) return static_cast<std::uint32_t>(i);
  if (k == work.boundary_counts[i] + 1) return static_cast<std::uint32_t>(next_corner(i));
  std::uint32_t first = 3;
  for (std::size_t j = 0; j < i; ++j) first += work.boundary_counts[j];
  return first + k - 1;
}

inline std::uint32_t first_inner_node(const TriangleWork& work) {
  return 3 + work.boundary_counts[0] + work.boundary_counts[1] + work.boundary_counts[2];
}

/// The side on which both points lie, 3 when there is none.
inline std::size_t common_side(LatticePoint a, LatticePoint b) {
  const unsigned sides = lattice::sides_of(a) & lattice::sides_of(b);
  for (std::size_t i = 0; i < 3; ++i)
    if ((sides >> last_corner(i) & 1u) != 0) return i;
  return 3;
}

/// Calls visit(section) for each section of side i between points a and b, both on that side.
template <class Visit>
void for_sections_between(const TriangleWork& work, std::size_t i, LatticePoint a, LatticePoint b,
                          Visit&& visit) {
  const std::int32_t low = std::min(a[next_corner(i)], b[next_corner(i)]);
  const std::int32_t high = std::max(a[next_corner(i)], b[next_corner(i)]);
  for (std::uint32_t k = 0; k <= work.boundary_counts[i]; ++k) {
    const std::int32_t from = work.graph.points[side_node(work, i, k)][next_corner(i)];
    const std::int32_t to = work.graph.points[side_node(work, i, k + 1)][next_corner(i)];
    if (from >= low && to <= high) visit(k);
  }
}

}  // namespace cut

/// @file
/// Improves a triangulation of lattice points by flipping edges. In and out: triangles and their adjacency.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "lattice/metric.hpp"

namespace cut::lattice {

/// Marks a half-edge without another side, and in general "none".
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// Flips edges while that enlarges the smaller of the smallest angles of the two triangles at an edge.
///
/// Half-edge 3t + k runs from corner k of triangle t to the next one. An edge is flipped only if its two
/// triangles form a strictly convex quadrilateral, by exact test; half-edges without a twin stay. The number
/// of passes over all edges is bounded.
///
/// @param points     positions that the triangles refer to.
/// @param triangles  counterclockwise, with positive area; changed in place.
/// @param twins      for each half-edge the half-edge on its other side, or `no_index`; kept up to date.
void flip_edges(std::span<const LatticePoint> points, const Metric& metric,
                std::span<std::array<std::uint32_t, 3>> triangles, std::span<std::uint32_t> twins);

}  // namespace cut::lattice

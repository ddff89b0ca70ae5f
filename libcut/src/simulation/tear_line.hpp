/// @file
/// The line along which one fragment tears, on its tension-free triangle.
#pragma once
#include <array>
#include <optional>

#include "cut/hybrid_mesh.hpp"
#include "lattice/plane.hpp"

namespace cut {

/// Where a line begins: the point of side `side` (counterclockwise) that is t lattice units from its start.
struct TearStart {
  std::size_t side = 0;
  std::int32_t t = 0;
};

/// Where the tear of polygon `polygon` of ancestor `t` begins: at the end of a cut on one of its sides, or
/// else near the middle of side `side`, as far as it belongs to the polygon. Nothing when the side has no
/// part of it, or when `fresh` is false and there is no such end.
std::optional<TearStart> tear_start(const HybridMesh& mesh, AncestorId t, std::size_t polygon,
                                    std::size_t side, bool fresh);

/// From the start straight through the polygon to its opposite contour, across the direction of the greatest
/// stretch. In coordinates b1 / N, b2 / N. Nothing when the triangle has no area in space.
std::optional<std::array<lattice::PlanePoint, 2>> tear_line(const HybridMesh& mesh, AncestorId t,
                                                            std::size_t polygon, TearStart start);

}  // namespace cut

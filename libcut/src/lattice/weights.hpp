/// @file
/// How much of a physics triangle's material a fragment carries (docs/decisions.md, "Conserving material").
/// In: the loops or the triangles of a fragment. Out: one weight for each corner of the physics triangle.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "cut/lattice_point.hpp"

namespace cut::lattice {

/// 128 bits hold a moment: it is below 2^77 for one triangle, N³ = 2^75 for a whole physics triangle.
__extension__ typedef __int128 Moment;

/// For each corner i of the physics triangle the integral of 6 b_i over a region, in lattice units: an
/// integer for every polygon of lattice points. Moments of disjoint regions add up without rounding.
using Moments = std::array<Moment, 3>;

/// Each of the three moments of a whole physics triangle: N³.
inline constexpr Moment whole_moment = Moment{lattice_size} * lattice_size * lattice_size;

/// Moments of the triangle (a, b, c); negative when it is clockwise.
[[nodiscard]] Moments triangle_moments(LatticePoint a, LatticePoint b, LatticePoint c);

/// Moments of a polygon with holes.
/// @param points     the corners of all loops, one loop after another; hulls counterclockwise, holes
/// clockwise.
/// @param loop_ends  for each loop, the index behind its last corner. @pre increasing, at most points.size()
[[nodiscard]] Moments polygon_moments(std::span<const LatticePoint> points,
                                      std::span<const std::uint32_t> loop_ends);

/// The weights w_i = ∫_f N_i / ∫_T N_i of a fragment f of the physics triangle T, N_i being the barycentric
/// coordinate: moment i divided by N³, rounded once.
[[nodiscard]] std::array<double, 3> corner_weights(const Moments& moments);

/// Weights of a polygon, as `polygon_moments` takes it.
[[nodiscard]] std::array<double, 3> corner_weights(std::span<const LatticePoint> points,
                                                   std::span<const std::uint32_t> loop_ends);

}  // namespace cut::lattice

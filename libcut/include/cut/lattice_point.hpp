/// @file
/// A point of a physics triangle as integer barycentric coordinates (docs/decisions.md, "Points are
/// integers").
///
/// A point is (b0, b1, b2) with b0 + b1 + b2 = N. It lies on a physics edge exactly when one coordinate is 0
/// and on a physics node when one is N. Neighbours agree on their common edge to the bit, deformation changes
/// nothing, and every orientation test is exact in 64-bit integers. One unit of the lattice is the paper's
/// δf.
#pragma once
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace cut {

/// N: the sum of the three coordinates.
inline constexpr std::int32_t lattice_size = 1 << 25;

/// A point of a physics triangle. b1 and b2 are stored, as plane coordinates x and y: a triangle that is
/// counterclockwise in space is counterclockwise in (x, y).
struct LatticePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;

  constexpr auto operator<=>(const LatticePoint&) const = default;

  /// Coordinate b_i. @pre i < 3
  [[nodiscard]] constexpr std::int32_t operator[](std::size_t i) const {
    return i == 0 ? lattice_size - x - y : (i == 1 ? x : y);
  }
  /// True when no coordinate is negative: the point lies in the closed triangle.
  [[nodiscard]] constexpr bool inside() const { return x >= 0 && y >= 0 && x + y <= lattice_size; }
};

/// Corner i of the triangle: b_i = N.
constexpr LatticePoint lattice_corner(std::size_t i) {
  return {i == 1 ? lattice_size : 0, i == 2 ? lattice_size : 0};
}

/// The corner that edge `i` starts at is `i`, the one it ends at is `next_corner(i)`, the third is
/// `last_corner(i)`.
constexpr std::size_t next_corner(std::size_t i) { return i == 2 ? 0 : i + 1; }
constexpr std::size_t last_corner(std::size_t i) { return i == 0 ? 2 : i - 1; }

/// The point of edge i that is t units away from its start. @pre 0 <= t <= N
constexpr LatticePoint lattice_point_on_edge(std::size_t i, std::int32_t t) {
  const std::int32_t rest = lattice_size - t;
  return i == 0 ? LatticePoint{t, 0} : (i == 1 ? LatticePoint{rest, t} : LatticePoint{0, rest});
}

/// Index of the edge on which p lies, 3 when it lies on none. A corner lies on two edges; the one that starts
/// there is returned.
constexpr std::size_t edge_of(LatticePoint p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (p[last_corner(i)] == 0 && p[next_corner(i)] != lattice_size) return i;
  return 3;
}

/// Index of the corner at which p lies, 3 when it lies at none.
constexpr std::size_t corner_of(LatticePoint p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (p[i] == lattice_size) return i;
  return 3;
}

}  // namespace cut

/// @file
/// Where two edges of a triangle meet, rounded to the lattice, and when an edge passes a lattice point so
/// closely that it is led through it: the two constructions of snap rounding. All arithmetic is exact.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "cut/lattice_point.hpp"
#include "lattice/orientation.hpp"

namespace cut::lattice {

__extension__ using Wide = __int128;

/// n / d to the nearest integer, halves away from zero. @pre d > 0
constexpr std::int64_t divide_rounded(Wide n, Wide d) {
  return static_cast<std::int64_t>(n >= 0 ? (2 * n + d) / (2 * d) : -((-2 * n + d) / (2 * d)));
}

/// Moves a point that rounding put onto (or over) the border of the triangle back inside, by one unit at
/// most: what a triangle shares with its neighbours is settled before its inside is.
constexpr LatticePoint clamp_inside(LatticePoint p) {
  p.x = std::clamp(p.x, std::int32_t{1}, lattice_size - 2);
  p.y = std::clamp(p.y, std::int32_t{1}, lattice_size - 1 - p.x);
  return p;
}

/// The crossing of ab and cd, rounded to a lattice point inside the triangle. Does not depend on the
/// direction or order in which the edges are given. @pre the lines are not parallel
constexpr LatticePoint crossing(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  if (b < a) std::swap(a, b);
  if (d < c) std::swap(c, d);
  if (c < a || (c == a && d < b)) {
    std::swap(a, c);
    std::swap(b, d);
  }
  std::int64_t den = cross(b - a, d - c);
  std::int64_t num = cross(c - a, d - c);
  if (den < 0) {
    den = -den;
    num = -num;
  }
  const Vector ab = b - a;
  return clamp_inside({static_cast<std::int32_t>(a.x + divide_rounded(Wide{num} * ab.x, den)),
                       static_cast<std::int32_t>(a.y + divide_rounded(Wide{num} * ab.y, den))});
}

/// True when the edge ab passes through the cell of p (the closed unit square around it) and p projects onto
/// its inside.
constexpr bool passes_through_cell(LatticePoint a, LatticePoint b, LatticePoint p) {
  const Vector ab = b - a;
  const Vector ap = p - a;
  const std::int64_t along = dot(ap, ab);
  if (along <= 0 || along >= dot(ab, ab)) return false;
  const std::int64_t across = cross(ab, ap);
  const auto magnitude = [](std::int64_t v) { return v < 0 ? -v : v; };
  return 2 * magnitude(across) <= magnitude(ab.x) + magnitude(ab.y);
}

/// Bit k is set when p lies on the side of the triangle where coordinate k is 0.
constexpr unsigned sides_of(LatticePoint p) {
  return (p[0] == 0 ? 1u : 0u) | (p[1] == 0 ? 2u : 0u) | (p[2] == 0 ? 4u : 0u);
}

}  // namespace cut::lattice

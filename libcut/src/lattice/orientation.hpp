/// @file
/// Exact predicates on lattice points (docs/decisions.md, "Points are integers"). Differences are at most N =
/// 2^25 in each coordinate, products stay below 2^51: 64-bit integers never overflow.
#pragma once
#include <cstdint>

#include "cut/lattice_point.hpp"

namespace cut::lattice {

struct Vector {
  std::int64_t x;
  std::int64_t y;
};

constexpr Vector operator-(LatticePoint a, LatticePoint b) {
  return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y};
}
constexpr std::int64_t cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
constexpr std::int64_t dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }

/// Twice the signed area of (a, b, c) in lattice units: positive when counterclockwise, 0 when collinear.
constexpr std::int64_t orientation(LatticePoint a, LatticePoint b, LatticePoint c) {
  return cross(b - a, c - a);
}

/// True when p lies on the closed segment ab.
constexpr bool on_segment(LatticePoint a, LatticePoint b, LatticePoint p) {
  return orientation(a, b, p) == 0 && dot(a - p, b - p) <= 0;
}

/// True when the open segments ab and cd cross in one point that is an end of neither.
constexpr bool cross_properly(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  const auto sign = [](std::int64_t v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); };
  return sign(orientation(a, b, c)) * sign(orientation(a, b, d)) < 0 &&
         sign(orientation(c, d, a)) * sign(orientation(c, d, b)) < 0;
}

/// Orders directions counterclockwise by angle in [0, 2π), starting at +x. Exact. @pre neither vector is zero
constexpr bool angle_less(Vector a, Vector b) {
  const auto half = [](Vector v) { return v.y > 0 || (v.y == 0 && v.x > 0) ? 0 : 1; };
  return half(a) != half(b) ? half(a) < half(b) : cross(a, b) > 0;
}

/// True when direction d lies strictly inside the angle swept counterclockwise from `from` to `to`. When
/// `from` and `to` are the same direction the angle is the whole turn.
constexpr bool strictly_between(Vector from, Vector d, Vector to) {
  const auto after = [&](Vector v) {  // v relative to `from`: 0 same direction, 1 (0, π), 2 π, 3 (π, 2π)
    const std::int64_t c = cross(from, v);
    return c > 0 ? 1 : (c < 0 ? 3 : (dot(from, v) > 0 ? 0 : 2));
  };
  const int d_after = after(d);
  const int to_after = after(to) == 0 ? 4 : after(to);
  if (d_after == 0) return false;
  if (d_after != to_after) return d_after < to_after;
  return cross(d, to) > 0;
}

}  // namespace cut::lattice

/// @file
/// Exact areas in lattice units. In: points. Out: twice the area as an integer.
#pragma once
#include <cstdint>

#include "cut/arrangement.hpp"

namespace cut::validation {

/// Adds up modulo 2^64: a partial sum may wrap, the sum over a loop within the triangle is at most 2^50 and
/// comes out right.
class AreaSum {
 public:
  /// The next side of the loop. @pre coordinates in [0, N]
  void add(LatticePoint from, LatticePoint to) {
    sum_ += static_cast<std::uint64_t>(std::int64_t{from.x} * to.y - std::int64_t{from.y} * to.x);
  }
  [[nodiscard]] std::int64_t value() const { return static_cast<std::int64_t>(sum_); }

 private:
  std::uint64_t sum_ = 0;
};

inline std::int64_t wrapping_sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

/// Twice the area of the polygon: hull less holes.
inline std::int64_t twice_area(const Arrangement& arrangement, const RenderPolygon& polygon) {
  AreaSum sum;
  std::size_t begin = 0;
  for (const std::uint32_t end : polygon.loop_ends) {
    for (std::size_t i = begin; i < end; ++i)
      sum.add(arrangement.nodes[polygon.corners[i].node].point,
              arrangement.nodes[polygon.corners[i + 1 < end ? i + 1 : begin].node].point);
    begin = end;
  }
  return sum.value();
}

}  // namespace cut::validation

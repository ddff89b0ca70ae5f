/// @file
/// Lengths on a physics triangle in its tension-free state: merge distances (§4.2, §4.3) and the
/// quality of triangulations are measured here. Topology never depends on it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "lattice/orientation.hpp"

namespace cut::lattice {

/// Squared distance of a point from a segment, and where on the segment its foot point is: 0 at the start, 1
/// at the end.
struct SegmentDistance {
  double squared;
  double parameter;
};

/// The tension-free shape of a physics triangle, given by the squared rest lengths of its three edges. All
/// results are in the unit of these lengths. A vector along an edge has the same length, to the bit, in both
/// triangles at that edge.
class Metric {
 public:
  /// @param squared_rest_lengths entry i is the squared rest length of edge i (from corner i to the next).
  explicit constexpr Metric(const std::array<double, 3>& squared_rest_lengths)
      : edge_(squared_rest_lengths),
        doubled_area_squared_((4 * edge_[0] * edge_[2] - square(edge_[0] + edge_[2] - edge_[1])) / 4) {}

  [[nodiscard]] double longest_edge() const { return std::sqrt(std::max({edge_[0], edge_[1], edge_[2]})); }
  [[nodiscard]] double smallest_height() const {
    return std::sqrt(std::max(doubled_area_squared_, 0.0)) / longest_edge();
  }
  [[nodiscard]] constexpr double squared_length(Vector d) const { return std::max(inner_product(d, d), 0.0); }
  [[nodiscard]] double length(LatticePoint a, LatticePoint b) const {
    return std::sqrt(squared_length(b - a));
  }

  [[nodiscard]] constexpr double inner_product(Vector a, Vector b) const {
    // |d|² = -(l01² d0 d1 + l12² d1 d2 + l20² d2 d0) / N² for d0 + d1 + d2 = 0, and its polar form. The
    // integer products are below 2^53, so they convert exactly.
    const std::int64_t a0 = -a.x - a.y, b0 = -b.x - b.y;
    const double sum = edge_[0] * static_cast<double>(a0 * b.x + b0 * a.x) +
                       edge_[1] * static_cast<double>(a.x * b.y + b.x * a.y) +
                       edge_[2] * static_cast<double>(a.y * b0 + b.y * a0);
    return -sum * (0.5 / squared_size);
  }

  /// Distance of p from segment ab. Where the foot point lies inside the segment the distance comes from the
  /// exact area of (a, b, p): it is 0 exactly when p lies on the segment.
  [[nodiscard]] constexpr SegmentDistance distance_to_segment(LatticePoint p, LatticePoint a,
                                                              LatticePoint b) const {
    const Vector along = b - a;
    const double squared = squared_length(along);
    const double projection = inner_product(p - a, along);
    if (!(projection > 0)) return {squared_length(p - a), 0};
    if (projection >= squared) return {squared_length(p - b), 1};
    const double area = static_cast<double>(orientation(a, b, p)) / squared_size;
    return {area * area * std::max(doubled_area_squared_, 0.0) / squared, projection / squared};
  }

 private:
  static constexpr double square(double v) { return v * v; }
  static constexpr double squared_size = static_cast<double>(lattice_size) * lattice_size;

  std::array<double, 3> edge_;
  double doubled_area_squared_;
};

}  // namespace cut::lattice

#include "lattice/weights.hpp"

#include "lattice/orientation.hpp"

namespace cut::lattice {

Moments triangle_moments(LatticePoint a, LatticePoint b, LatticePoint c) {
  // The integral of a linear function is the area times its mean over the corners; 6 · 1/2 · 1/3 = 1.
  const Moment doubled_area = orientation(a, b, c);
  Moments result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = doubled_area * (std::int64_t{a[i]} + b[i] + c[i]);
  return result;
}

Moments polygon_moments(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends) {
  // Each edge spans a signed triangle with corner 0; what lies outside the polygon cancels.
  Moments sum{};
  std::uint32_t begin = 0;
  for (const std::uint32_t end : loop_ends) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const Moments part =
          triangle_moments(lattice_corner(0), points[k], points[k + 1 == end ? begin : k + 1]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
    }
    begin = end;
  }
  return sum;
}

std::array<double, 3> corner_weights(const Moments& moments) {
  std::array<double, 3> weights;
  for (std::size_t i = 0; i < 3; ++i)
    weights[i] = static_cast<double>(moments[i]) / static_cast<double>(whole_moment);
  return weights;
}

std::array<double, 3> corner_weights(std::span<const LatticePoint> points,
                                     std::span<const std::uint32_t> loop_ends) {
  return corner_weights(polygon_moments(points, loop_ends));
}

}  // namespace cut::lattice

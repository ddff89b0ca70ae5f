/// @file
/// Arithmetic of an implicit step's system: 3×3 blocks of its diagonal, and the size of impulses.
#pragma once
#include <vector>

#include "cut/simulation.hpp"
#include "simulation/padded.hpp"

namespace cut {

inline PaddedVector product(const ImplicitWork::Block& b, const PaddedVector& v) {
  return {b[0] * v.x + b[3] * v.y + b[5] * v.z, b[3] * v.x + b[1] * v.y + b[4] * v.z,
          b[5] * v.x + b[4] * v.y + b[2] * v.z, 0};
}

/// @pre positive definite
inline ImplicitWork::Block inverse(const ImplicitWork::Block& b) {
  const double xx = b[1] * b[2] - b[4] * b[4], xy = b[4] * b[5] - b[3] * b[2], zx = b[3] * b[4] - b[1] * b[5];
  const double factor = 1 / ((b[0] * xx + b[3] * xy) + b[5] * zx);
  return {factor * xx, factor * (b[0] * b[2] - b[5] * b[5]), factor * (b[0] * b[1] - b[3] * b[3]),
          factor * xy, factor * (b[3] * b[5] - b[0] * b[4]), factor * zx};
}

/// Σ |v|²/m: of impulses, twice the energy that they give to nodes at rest.
inline double weighted_square(const std::vector<PaddedVector>& v, const std::vector<double>& inverse_mass) {
  double sum = 0;
  for (std::size_t n = 0; n < v.size(); ++n)
    sum += inverse_mass[n] * ((v[n].x * v[n].x + v[n].y * v[n].y) + v[n].z * v[n].z);
  return sum;
}

}  // namespace cut

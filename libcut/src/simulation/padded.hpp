/// @file
/// Arithmetic of padded vectors, component by component in a fixed order, so that every compiler gets the
/// same bits.
#pragma once
#include "cut/simulation.hpp"

namespace cut {

inline PaddedVector padded(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0}; }
inline Eigen::Vector3d plain(const PaddedVector& v) { return {v.x, v.y, v.z}; }
inline PaddedVector operator+(const PaddedVector& a, const PaddedVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, 0};
}
inline PaddedVector operator-(const PaddedVector& a, const PaddedVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z, 0};
}
inline PaddedVector operator*(double s, const PaddedVector& a) { return {s * a.x, s * a.y, s * a.z, 0}; }

}  // namespace cut

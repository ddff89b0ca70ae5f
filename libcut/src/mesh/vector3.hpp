/// @file
/// Products of vectors with one fixed order of operations, so that every compiler gets the same bits.
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace cut {

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}
inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}
inline double squared_length(const Eigen::Vector3d& a) { return dot(a, a); }
inline double length(const Eigen::Vector3d& a) { return std::sqrt(dot(a, a)); }

}  // namespace cut

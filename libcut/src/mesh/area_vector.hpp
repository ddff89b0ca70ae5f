/// @file
/// The vector across a triangle that is as long as twice its area, for triangles that have an area
/// (cut::has_area).
#pragma once
#include <Eigen/Core>

namespace cut {

/// Zero for a needle: a triangle whose height is no more than 1e-14 of its longest side.
Eigen::Vector3d area_vector(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace cut

/// @file
/// Where lattice points are in space.
#pragma once
#include <Eigen/Core>
#include <array>

#include "cut/hybrid_mesh.hpp"

inline Eigen::Vector3d interpolated(const std::array<Eigen::Vector3d, 3>& corners, cut::LatticePoint point) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) p += corners[k] * (static_cast<double>(point[k]) / cut::lattice_size);
  return p;
}

/// Of an ancestor on the tension-free cloth.
inline std::array<Eigen::Vector3d, 3> rest_corners(const cut::HybridMesh& mesh, cut::AncestorId t) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = mesh.ancestors.rest_positions[mesh.ancestors.triangles[t.index()].nodes[k].index()];
  return corners;
}

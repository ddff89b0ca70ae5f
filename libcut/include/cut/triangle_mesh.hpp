/// @file
/// The plain triangle mesh that comes in: a cloth before its first cut, or a cutter.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace cut {

/// Points in space and triangles of point indices, counterclockwise seen from outside. Nothing is checked
/// here: `HybridMesh::build` and `Cutter::cut` say what they require of it.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace cut

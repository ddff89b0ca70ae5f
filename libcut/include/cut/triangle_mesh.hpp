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

/// Coordinates must be smaller than this, so that no product of them overflows.
constexpr double largest_coordinate = 1e50;

/// Whether a triangle is wide enough to have a plane: its height is more than 1e-14 of its longest side. One
/// that is not is refused in a cloth, and cuts nothing.
[[nodiscard]] bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace cut

/// @file
/// Where a cutter triangle meets a physics triangle (§4.1), feature by feature from small to large: physics
/// node with cutter, physics edge with cutter, cutter node with triangle, cutter edge with triangle. Each
/// contact is computed from the two features alone, in an order that does not depend on which triangle asks:
/// all triangles at a feature see the same contact, to the bit.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "cut/lattice_point.hpp"

namespace cut {

/// A cutter triangle, made ready: corners in lexicographic order, unit normal, inward unit vectors of its
/// edges.
struct CutterFace {
  std::array<Eigen::Vector3d, 3> corners;
  Eigen::Vector3d normal;
  std::array<Eigen::Vector3d, 3> inward;  ///< edge k runs from corner k to k + 1

  /// @return false when the triangle has no area to speak of
  bool prepare(std::array<Eigen::Vector3d, 3> points);
  /// Whether the triangle lies on one side of the plane, or in it, so that `intersect` would find no line.
  [[nodiscard]] bool misses(const std::array<Eigen::Vector3d, 3>& triangle, double slack) const;
  /// Signed distances of p from the three edges are at least -slack. @pre p lies in the plane
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double slack) const;
};

/// A physics triangle in space. reversed[k] tells that edge k runs against its ancestor edge.
struct PhysicsFace {
  std::array<Eigen::Vector3d, 3> corners;
  std::array<bool, 3> reversed;
};

/// The points at which the two triangles touch or cross each other, along their common line; fewer than two
/// when there is no line (apart, coplanar, or touching in a point).
void intersect(const PhysicsFace& triangle, const CutterFace& cutter, double slack,
               std::vector<LatticePoint>& points);

/// Where a line crosses a triangle.
struct Pierced {
  double parameter;  ///< on the line, 0 at its start, 1 at its end
  LatticePoint point;
};

/// Where the line from a to b crosses the triangle, as `intersect` sees it for a cutter with this edge.
/// Nothing for a line in the triangle's plane.
std::optional<Pierced> pierce(const PhysicsFace& triangle, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              double slack);

}  // namespace cut

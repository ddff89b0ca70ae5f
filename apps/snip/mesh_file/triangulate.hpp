/// @file
/// Triangles from the polygons of a mesh file: a polygon in space, not quite planar, possibly concave, goes
/// in; triangles over its corners come out. Ear clipping in the plane that fits it best.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "snip/mesh_file/mesh.hpp"

namespace snip {

/// The most corners that a polygon may have; the time grows with their square.
inline constexpr std::size_t max_polygon_corners = 10000;

/// Appends corners - 2 triangles of corner numbers, in the polygon's winding. They cover a simple polygon
/// (also one that touches itself, as a hole joined to the outline by a bridge does) exactly once; for any
/// other they are some triangulation of its corners. A quadrilateral is split along the diagonal that
/// leaves the better shaped triangles. Appends nothing for less than three corners.
/// @pre polygon.size() <= max_polygon_corners, coordinates are finite and below cut::largest_coordinate
/// Complexity: O(n^2)
void triangulate_polygon(std::span<const Eigen::Vector3d> polygon, std::vector<Triangle>& triangles);

}  // namespace snip

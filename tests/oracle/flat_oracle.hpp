/// @file
/// The pieces of a flat sheet after straight cuts, computed by GEOS: outline and cuts are noded and their
/// polygons collected. Shares nothing with the code under test. In: sheet, segments. Out: areas.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "cut/triangle_mesh.hpp"

namespace oracle {

using Segment = std::array<Eigen::Vector2d, 2>;

/// Areas of the pieces into which the segments divide the sheet, largest first. Ends that hang free divide
/// nothing. Points closer than about `grid` are one. z is ignored.
std::vector<double> flat_pieces(const cut::TriangleMesh& sheet, const std::vector<Segment>& segments,
                                double grid);

}  // namespace oracle

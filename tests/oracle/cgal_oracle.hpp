/// @file
/// The pieces of a curved surface after cuts, computed by CGAL with exact numbers. Shares nothing with the
/// code under test. In: cloth, cutters. Out: areas.
#pragma once
#include <vector>

#include "cut/triangle_mesh.hpp"

namespace oracle {

/// Areas of the connected components of the cloth that was cut by one cutter after another, largest
/// first.
/// @pre the cloth is consistently wound; no cutter meets itself
std::vector<double> split_pieces(const cut::TriangleMesh& cloth,
                                 const std::vector<cut::TriangleMesh>& cutters);

}  // namespace oracle

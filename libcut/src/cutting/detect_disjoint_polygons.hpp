/// @file
/// Step 9, Detect Disjoint Polygons (§4.9): the faces of a triangle's graph are its render polygons.
/// In: a TriangleWork whose graph is planar. Out: its new Arrangement, and which polygon each new polygon was
/// part of.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/arrangement.hpp"
#include "cutting/state.hpp"

namespace cut {

struct DisjointPolygons {
  /// Complete but for physics triangles, render vertices and render triangles.
  Arrangement arrangement;
  std::vector<std::uint32_t> parent;       ///< per polygon: the polygon of `before` that it was part of
  std::vector<std::uint32_t> graph_edge;   ///< per edge of the arrangement: its index in the work's graph
  std::vector<std::int64_t> doubled_area;  ///< per polygon, in lattice units
};

/// Inner nodes without edges are dropped, the others sorted by position, edges by their nodes: the result
/// depends on the graph alone. O(n log n), and O(n) for each loose cut.
DisjointPolygons detect_disjoint_polygons(const TriangleWork& work);

}  // namespace cut

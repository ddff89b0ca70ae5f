/// @file
/// Step 9, Detect Disjoint Polygons (§4.9): the faces of a triangle's graph are its render polygons.
/// In: a TriangleWork whose graph is planar. Out: its new Arrangement, and which polygon each new polygon was
/// part of.
#pragma once
#include "cutting/state.hpp"

namespace cut {

/// Inner nodes without edges are dropped, the others sorted by position, edges by their nodes: the result
/// depends on the graph alone. O(n log n), and O(n) for each loose cut.
DisjointPolygons detect_disjoint_polygons(const TriangleWork& work);

}  // namespace cut

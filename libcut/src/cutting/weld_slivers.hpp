/// @file
/// Crumbs that a cut leaves between itself and an older cut, thinner than the distance within which line ends
/// merge, are welded to the neighbour that they share most with. In: an arranged work. Out: the work without
/// the edges that cut off crumbs.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "cutting/detect_disjoint_polygons.hpp"
#include "cutting/state.hpp"

namespace cut {

/// A crumb is a new polygon narrower than δn that shares no uncut section with another triangle. It is welded
/// by taking back new edges between it and one neighbour; its other sides stay cut, so that nothing that a
/// cut has separated is joined again. Without this, the same cut made twice leaves crumbs where merging had
/// led its line beside where it was detected.
/// Nothing when the work's graph is not complete.
DisjointPolygons weld_slivers(const HybridMesh& mesh, TriangleWork& work);

/// False when rounding has left nothing of a fragment that was there before, or has failed: the lines must
/// not be cut.
bool keeps_all_fragments(const TriangleWork& work, const DisjointPolygons& polygons);

}  // namespace cut

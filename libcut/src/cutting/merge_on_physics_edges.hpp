/// @file
/// Step 2 on edges (§4.2): points where cutting lines meet a physics edge become boundary nodes of it,
/// decided once for the edge and not by one of its triangles. After this step, what a triangle shares with
/// others is settled. In: works with ends on physics edges. Out: EdgeStates with their new boundary nodes,
/// works of all triangles beside them.
#pragma once
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/state.hpp"

namespace cut {

/// Moves each end on a physics edge to a node of the edge: one of the previous cut within δc, else any within
/// δn, else a new boundary node for all points within δn. Adds works for neighbours whose edge has a new
/// boundary node.
/// @param next_centres gets what the next cut is to remember of the points on edges
/// O(ends · log), and the nodes of each edge.
void merge_on_physics_edges(HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context,
                            const Executor& executor, ClusterCentres& next_centres);

}  // namespace cut

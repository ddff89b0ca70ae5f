/// @file
/// Step 2, Merge Cut Endpoints (§4.2): ends of cutting lines go to existing nodes (δn, δc for nodes of the
/// previous cut) and edges (δe), but never across a cut. In: lines with free ends. Out: each end on a node,
/// on a physics edge, on a cut, or free.
#pragma once
#include "cutting/state.hpp"

namespace cut {

/// Decides each line end of one triangle by the mesh as it was before this cut, neighbours included (see
/// merge_across_edges). Writes to `work` only. O(ends · nodes).
void merge_cut_endpoints(const HybridMesh& mesh, TriangleWork& work, const CutContext& context);

/// Merges ends that are still free to each other and to the boundary nodes that this cut made, within δn, in
/// an order given by their positions alone. @pre merge_on_physics_edges has settled the boundary nodes:
/// `boundary_points` are the new ones
void merge_free_endpoints(TriangleWork& work, const std::vector<LatticePoint>& boundary_points,
                          const CutContext& context);

}  // namespace cut

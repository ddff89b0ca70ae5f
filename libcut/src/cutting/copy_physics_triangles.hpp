/// @file
/// Step 10, Copy Physics Triangles (§4.10): each disjoint polygon gets a physics triangle of its own.
/// In: works with their new polygons. Out: arrangements stored in the mesh, new physics triangles that still
/// share all nodes with the triangle they were cut off from.
#pragma once
#include <span>
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/change_log.hpp"
#include "cutting/state.hpp"

namespace cut {

/// The largest polygon of each old one keeps its physics triangle. Render corners of new polygons have no
/// vertices yet. The works' polygons are gone afterwards.
/// @return the nodes of ancestors whose number of physics triangles changed, some more than once
std::vector<AncestorNodeId> copy_physics_triangles(HybridMesh& mesh, std::span<TriangleWork> works,
                                                   const Executor& executor, ChangeLog& log);

/// Marks the sections that lines run along as cut (§4.5), on the edges themselves. @return the edges with
/// newly cut sections
std::vector<AncestorEdgeId> cut_edge_sections(HybridMesh& mesh, const TriangleWork& work);

}  // namespace cut

/// @file
/// Step 10, Copy Physics Triangles (§4.10): each disjoint polygon gets a physics triangle of its own.
/// In: works with their new polygons. Out: arrangements stored in the mesh, new physics triangles that still
/// share all nodes with the triangle they were cut off from.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "cutting/change_log.hpp"
#include "cutting/detect_disjoint_polygons.hpp"
#include "cutting/state.hpp"

namespace cut {

/// The largest polygon of each old one keeps its physics triangle. Render corners of new polygons have no
/// vertices yet.
/// @return true when the number of physics triangles changed
bool copy_physics_triangles(HybridMesh& mesh, const TriangleWork& work, DisjointPolygons&& polygons,
                            ChangeLog& log);

/// Marks the sections that lines run along as cut (§4.5), on the edges themselves. @return the edges with
/// newly cut sections
std::vector<AncestorEdgeId> cut_edge_sections(HybridMesh& mesh, const TriangleWork& work);

}  // namespace cut

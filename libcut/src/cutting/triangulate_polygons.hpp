/// @file
/// The end of step 10 (§4.10): the render areas of new polygons are triangulated, and vertices learn of
/// copied nodes. In: complete arrangements. Out: render triangles and up-to-date render vertices.
#pragma once
#include <cstdint>
#include <span>
#include <utility>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/change_log.hpp"
#include "cutting/state.hpp"

namespace cut {

/// Triangulates all polygons of the works' triangles, into the entries that they had and free ones.
void triangulate_polygons(HybridMesh& mesh, std::span<const TriangleWork> works, const Executor& executor,
                          ChangeLog& log);

/// Writes the render triangles of polygons anew, into the entries that they have: two angles at one node have
/// got vertices of their own. @pre the corners are where they were
void triangulate_again(HybridMesh& mesh, std::span<const std::pair<AncestorId, std::uint32_t>> polygons,
                       ChangeLog& log);

/// Render vertices take over the nodes of the physics triangles that the log names.
void update_vertex_nodes(HybridMesh& mesh, const Executor& executor, ChangeLog& log);

}  // namespace cut

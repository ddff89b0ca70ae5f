/// @file
/// Step 6, Copy Boundary Nodes (§4.6), for all render vertices: those at a boundary node or a physics node
/// are the connected components of the angles that polygons have there, two angles being connected when they
/// share an uncut section that ends at the node; an inner node has one for each angle. In: arrangements
/// without render vertices. Out: arrangements complete but for render triangles (triangulate_polygons.hpp),
/// and the buffer of render vertices.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/change_log.hpp"
#include "cutting/state.hpp"

namespace cut {

/// @param works those whose arrangement or whose sides' sections have changed, `before` still being their old
/// arrangement.
///        O(corners of these polygons and of the neighbours at their border · log)
/// @return polygons, by ancestor and index, two of whose angles at one node no longer share their vertex:
/// which render triangles belong to which angle, only triangulation tells
std::vector<std::pair<AncestorId, std::uint32_t>> copy_boundary_nodes(HybridMesh& mesh,
                                                                      std::span<const TriangleWork> works,
                                                                      const Executor& executor,
                                                                      ChangeLog& log);

}  // namespace cut

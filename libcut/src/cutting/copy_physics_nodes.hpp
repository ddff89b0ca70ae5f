/// @file
/// Step 8, Copy Physics Nodes (§4.8), by the one rule of reconnection: the copies of a node are the connected
/// components of the fragments around it, two fragments being connected when they share an uncut section of a
/// physics edge that ends there (the paper's node-triangle-union). Springs follow. In: arrangements and edge
/// sections as they are now. Out: physics nodes of all fragments, springs.
#pragma once
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/change_log.hpp"

namespace cut {

/// Splits the copies of these nodes that are no longer connected. The component that renders a node keeps its
/// id, or else the first one. O(fragments around the nodes).
void copy_physics_nodes(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                        ChangeLog& log);

/// Brings the springs on all edges of the triangles around these nodes up to date: one for each pair of
/// physics nodes.
void update_springs(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                    ChangeLog& log);

}  // namespace cut

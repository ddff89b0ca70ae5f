/// @file
/// Changing what cuts made of an ancestor edge: its boundary nodes and which of its sections are cut.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/hybrid_mesh.hpp"
#include "mesh/sections.hpp"  // reading

namespace cut {

/// The state of an edge, made when it has none yet.
EdgeState& edge_state_for_writing(HybridMesh& mesh, AncestorEdgeId edge);

/// Inserts a boundary node; the section that it divides is cut on both sides of it, or on neither. @pre there
/// is none at t
void insert_boundary_node(EdgeState& state, std::int32_t t, std::uint32_t stamp);

/// Notes that the node at t (a boundary node, or a physics node at 0 or N) takes part in cut number `stamp`.
void stamp_edge_node(HybridMesh& mesh, AncestorEdgeId edge, std::int32_t t, std::uint32_t stamp);

/// The points of the boundary nodes on side i of a triangle, counterclockwise.
std::vector<LatticePoint> boundary_points(const HybridMesh& mesh, AncestorId triangle, std::size_t i);

}  // namespace cut

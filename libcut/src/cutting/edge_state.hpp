/// @file
/// Changing what cuts made of an ancestor edge: its boundary nodes and which of its sections are cut.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/hybrid_mesh.hpp"
#include "mesh/sections.hpp"  // reading

namespace cut {

/// Numbers the states of edges that have none yet. The next call for writing makes them, which may then run
/// in parallel. @param edge_of what gives an entry's edge
template <class List, class EdgeOf>
void number_edge_states(HybridMesh& mesh, const List& list, const EdgeOf& edge_of) {
  std::size_t next = mesh.edge_states.size();
  for (const auto& entry : list)
    if (std::uint32_t& index = mesh.edge_state_of[edge_of(entry).index()]; index == HybridMesh::none)
      index = static_cast<std::uint32_t>(next++);
  mesh.edge_states.resize(next, EdgeState{{}, {}, {}});
}

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

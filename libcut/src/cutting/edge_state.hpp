/// @file
/// Reading and changing what cuts made of an ancestor edge: its boundary nodes and which of its sections are
/// cut.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/hybrid_mesh.hpp"

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

/// The polygon that triangle t has at each section of its side i, in the direction of the ancestor edge.
/// Calls `visit(section, polygon)`.
template <class Visit>
void for_each_section(const HybridMesh& mesh, AncestorId t, std::size_t i, Visit&& visit) {
  const Arrangement* arrangement = mesh.arrangement(t);
  if (arrangement == nullptr) {
    visit(std::size_t{0}, std::uint32_t{0});
    return;
  }
  const auto& polygons = arrangement->section_polygons[i];
  const bool reversed = mesh.ancestors.reversed(t, i);
  for (std::size_t k = 0; k < polygons.size(); ++k)
    visit(k, polygons[reversed ? polygons.size() - 1 - k : k]);
}

/// True when the two sides of a section are no longer joined. A border edge's sections are not cut.
inline bool is_cut(const EdgeState* state, std::size_t section) {
  return state != nullptr && state->cut[section] != 0;
}

}  // namespace cut

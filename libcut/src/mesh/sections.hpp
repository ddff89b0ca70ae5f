/// @file
/// Reading what cuts made of the sections of an ancestor edge: where each is, which polygon lies at it, and
/// whether it is cut. Places along an edge, which the triangles beside it count in different directions.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "cut/hybrid_mesh.hpp"

namespace cut {

/// Where a point of side i of a triangle lies, in lattice units from the start of the edge.
inline std::int32_t along_edge(const AncestorMesh& ancestors, AncestorId t, std::size_t i, LatticePoint p) {
  const std::int32_t along = p[next_corner(i)];
  return ancestors.reversed(t, i) ? lattice_size - along : along;
}

/// The point of side i of a triangle that lies so far along the edge.
inline LatticePoint point_along_edge(const AncestorMesh& ancestors, AncestorId t, std::size_t i,
                                     std::int32_t along) {
  return lattice_point_on_edge(i, ancestors.reversed(t, i) ? lattice_size - along : along);
}

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

/// Where a section begins and ends, in lattice units from the start of the edge.
inline std::array<std::int32_t, 2> section_range(const EdgeState* state, std::size_t section) {
  if (state == nullptr) return {0, lattice_size};
  return {section == 0 ? 0 : state->nodes[section - 1].t,
          section == state->nodes.size() ? lattice_size : state->nodes[section].t};
}

/// True when the two sides of a section are no longer joined.
inline bool is_cut(const EdgeState* state, std::size_t section) {
  return state != nullptr && state->cut[section] != 0;
}

}  // namespace cut

/// @file
/// Tension-free area of a triangle of the uncut mesh.
#pragma once
#include "cut/hybrid_mesh.hpp"
#include "mesh/vector3.hpp"

namespace cut {

[[nodiscard]] inline double rest_area(const AncestorMesh& ancestors, AncestorId t) {
  const auto& nodes = ancestors.triangles[t.index()].nodes;
  const auto rest = [&](std::size_t i) { return ancestors.rest_positions[nodes[i].index()]; };
  return length(cross(rest(1) - rest(0), rest(2) - rest(0))) / 2;
}

}  // namespace cut

/// @file
/// Where on the uncut cloth a point of a triangle lies, in terms on which all triangles there agree. In: a
/// triangle and a lattice point. Out: a value to compare.
#pragma once
#include <compare>

#include "cut/hybrid_mesh.hpp"

namespace cut::validation {

/// A node, a point t along an edge, or a point (x, y) of a triangle of the uncut mesh.
struct Place {
  enum class Kind { none, node, edge, inside };
  Kind kind = Kind::none;
  std::uint32_t index = 0;
  std::int32_t x = 0;  ///< t on an edge
  std::int32_t y = 0;
  bool operator==(const Place&) const = default;
};

[[nodiscard]] inline Place place_of(const AncestorMesh& ancestors, AncestorId t, LatticePoint p) {
  const std::size_t corner = corner_of(p);
  if (corner < 3) return {Place::Kind::node, ancestors.triangles[t.index()].nodes[corner].value, 0, 0};
  const std::size_t i = edge_of(p);
  if (i == 3) return {Place::Kind::inside, t.value, p.x, p.y};
  const std::int32_t along = p[next_corner(i)];
  return {Place::Kind::edge, ancestors.triangles[t.index()].edges[i].value,
          ancestors.reversed(t, i) ? lattice_size - along : along, 0};
}

/// Place of a render vertex; kind `none` where the entry is free or broken.
[[nodiscard]] inline Place place_of(const HybridMesh& mesh, RenderVertexId id) {
  const RenderVertex& v = mesh.buffers.render_vertices[id.index()];
  if (!v.triangle.valid()) return {};
  const AncestorId ancestor = mesh.buffers.triangles[v.triangle.index()].ancestor;
  const auto in_range = [](std::int32_t c) { return c >= 0 && c <= lattice_size; };
  if (!ancestor.valid() || !in_range(v.point.x) || !in_range(v.point.y) || !v.point.inside()) return {};
  return place_of(mesh.ancestors, ancestor, v.point);
}

}  // namespace cut::validation

/// @file
/// Finds the wedges at both ends of each section by walking the polygons' loops once.
#include "validate/flood.hpp"

namespace cut::validation {
namespace {

/// What one triangle has at its sections: edges 0, 1, 2 one after the other, counterclockwise.
struct TriangleSections {
  std::array<std::uint32_t, 3> first{};
  std::vector<std::array<std::uint32_t, 2>> wedges;
  std::vector<std::uint32_t> polygons;
};

TriangleSections sections_of(const Arrangement* a, std::uint32_t first_wedge) {
  TriangleSections result;
  if (!a) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      result.first[i] = i;
      result.wedges.push_back({first_wedge + i, first_wedge + static_cast<std::uint32_t>(next_corner(i))});
      result.polygons.push_back(0);
    }
    return result;
  }
  // Section that starts at each node of the border, counterclockwise.
  std::vector<std::uint32_t> starting(a->first_inner_node(), nothing);
  std::vector<std::uint32_t> end_node;
  for (std::size_t i = 0; i < 3; ++i) {
    result.first[i] = static_cast<std::uint32_t>(result.polygons.size());
    for (std::uint32_t k = 0; k <= a->boundary_counts[i]; ++k) {
      starting[a->edge_node(i, k)] = static_cast<std::uint32_t>(result.polygons.size());
      end_node.push_back(a->edge_node(i, k + 1));
      result.polygons.push_back(a->section_polygons[i][k]);
    }
  }
  result.wedges.assign(result.polygons.size(), {nothing, nothing});
  std::uint32_t wedge = first_wedge;
  for (std::uint32_t p = 0; p < a->polygons.size(); ++p) {
    const RenderPolygon& polygon = a->polygons[p];
    std::uint32_t begin = 0;
    for (const std::uint32_t end : polygon.loop_ends) {
      for (std::uint32_t i = begin; i < end; ++i) {
        const std::uint32_t node = polygon.corners[i].node;
        const std::uint32_t next = i + 1 < end ? i + 1 : begin;
        if (node >= starting.size()) continue;
        const std::uint32_t section = starting[node];
        if (end_node[section] == polygon.corners[next].node && result.polygons[section] == p)
          result.wedges[section] = {wedge + i, wedge + next};
      }
      begin = end;
    }
    wedge += static_cast<std::uint32_t>(polygon.corners.size());
  }
  return result;
}

}  // namespace

Flood::Flood(const HybridMesh& mesh) {
  const AncestorMesh& ancestors = mesh.ancestors;
  const std::size_t count = ancestors.triangles.size();
  first_fragment.assign(count + 1, 0);
  first_wedge.assign(count + 1, 0);
  for (std::size_t t = 0; t < count; ++t) {
    const Arrangement* a = mesh.arrangement(AncestorId{t});
    std::size_t wedges = a ? 0 : 3;
    for (std::size_t p = 0; a && p < a->polygons.size(); ++p) wedges += a->polygons[p].corners.size();
    first_fragment[t + 1] = first_fragment[t] + static_cast<std::uint32_t>(a ? a->polygons.size() : 1);
    first_wedge[t + 1] = first_wedge[t] + static_cast<std::uint32_t>(wedges);
  }

  // The first side of an edge that comes by leaves its sections here; the second meets them.
  std::vector<std::vector<SectionSide>> waiting(ancestors.edges.size());
  for (std::size_t t = 0; t < count; ++t) {
    const TriangleSections sections = sections_of(mesh.arrangement(AncestorId{t}), first_wedge[t]);
    for (std::size_t i = 0; i < 3; ++i) {
      const AncestorEdgeId e = ancestors.triangles[t].edges[i];
      if (!ancestors.edges[e.index()].triangles[1].valid()) continue;
      const bool reversed = ancestors.reversed(AncestorId{t}, i);
      const std::size_t end = i < 2 ? sections.first[i + 1] : sections.polygons.size();
      std::vector<SectionSide> sides;
      for (std::size_t k = sections.first[i]; k < end; ++k) {
        const std::size_t s = reversed ? end - 1 - (k - sections.first[i]) : k;
        SectionSide side;
        side.fragment = first_fragment[t] + sections.polygons[s];
        side.corner = {i, next_corner(i)};
        side.wedge = sections.wedges[s];
        if (reversed) {
          std::swap(side.corner[0], side.corner[1]);
          std::swap(side.wedge[0], side.wedge[1]);
        }
        sides.push_back(side);
      }
      std::vector<SectionSide>& other = waiting[e.index()];
      if (other.empty()) {
        other = std::move(sides);
        continue;
      }
      const EdgeState* state = mesh.edge_state(e);
      for (std::size_t s = 0; s < sides.size() && s < other.size(); ++s) {
        if (state && s < state->cut.size() && state->cut[s] != 0) continue;
        joined.push_back({e, {other[s], sides[s]}});
      }
      other = {};
    }
  }
}

}  // namespace cut::validation

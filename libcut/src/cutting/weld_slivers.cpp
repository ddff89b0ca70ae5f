#include "cutting/weld_slivers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cutting/arrange_triangle.hpp"
#include "cutting/detect_disjoint_polygons.hpp"
#include "cutting/edge_state.hpp"
#include "lattice/orientation.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;
using lattice::operator-;

/// Area over half the diameter: the width of a thin polygon.
double width(const TriangleWork& work, const DisjointPolygons& polygons, Index polygon) {
  const Arrangement& arrangement = polygons.arrangement;
  double diameter = 0;
  const auto& corners = arrangement.polygons[polygon].corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      diameter = std::max(diameter, work.metric.squared_length(arrangement.nodes[corners[i].node].point -
                                                               arrangement.nodes[corners[j].node].point));
  const lattice::Vector u{lattice_size, 0};
  const lattice::Vector v{0, lattice_size};
  const double uv = work.metric.inner_product(u, v);
  const double rest_area = std::sqrt(
      std::max(work.metric.squared_length(u) * work.metric.squared_length(v) - uv * uv, 0.0));  // doubled
  const double share = static_cast<double>(polygons.doubled_area[polygon]) / lattice_size / lattice_size;
  return share * rest_area / std::sqrt(diameter);
}

/// Polygons that share an uncut section with another triangle.
std::vector<std::uint8_t> joined_to_neighbours(const HybridMesh& mesh, const TriangleWork& work,
                                               const Arrangement& arrangement) {
  std::vector<std::uint8_t> joined(arrangement.polygons.size(), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!mesh.ancestors.neighbour(work.ancestor, i).valid()) continue;
    const EdgeState* state = mesh.edge_state(mesh.ancestors.triangles[work.ancestor.index()].edges[i]);
    const bool reversed = mesh.ancestors.reversed(work.ancestor, i);
    const std::size_t count = arrangement.section_polygons[i].size();
    for (std::size_t k = 0; k < count; ++k)
      if (work.cut_sections[i][k] == 0 && !is_cut(state, reversed ? count - 1 - k : k))
        joined[arrangement.section_polygons[i][k]] = 1;
  }
  return joined;
}

/// Takes back the new edges that cut off the smallest crumb. @return false when there is none
bool weld_smallest(const HybridMesh& mesh, TriangleWork& work, const DisjointPolygons& polygons,
                   const CutContext& context) {
  const Arrangement& arrangement = polygons.arrangement;
  if (arrangement.polygons.size() <= work.before.polygons.size()) return false;
  const auto joined = joined_to_neighbours(mesh, work, arrangement);

  // Length of new edges between each polygon and each neighbour that was one with it before.
  std::map<std::pair<Index, Index>, double> shared;
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    const CutEdge& e = arrangement.edges[i];
    if (e.left == e.right || !work.graph.edges[polygons.graph_edge[i]].is_new ||
        polygons.parent[e.left] != polygons.parent[e.right])
      continue;
    const double length = work.metric.length(arrangement.nodes[e.from].point, arrangement.nodes[e.to].point);
    shared[{e.left, e.right}] += length;
    shared[{e.right, e.left}] += length;
  }
  Index crumb = HybridMesh::none;
  for (const auto& [pair, length] : shared) {
    const Index p = pair.first;
    if (joined[p] != 0 ||
        (crumb != HybridMesh::none && polygons.doubled_area[p] >= polygons.doubled_area[crumb]))
      continue;
    if (width(work, polygons, p) < context.distances.node) crumb = p;
  }
  if (crumb == HybridMesh::none) return false;
  Index neighbour = HybridMesh::none;
  double longest = -1;  // in a needle rounding may leave no length at all
  for (const auto& [pair, length] : shared)
    if (pair.first == crumb && length > longest) {
      longest = length;
      neighbour = pair.second;
    }
  std::vector<std::uint8_t> taken_back(work.graph.edges.size(), 0);
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    const CutEdge& e = arrangement.edges[i];
    if (std::minmax(e.left, e.right) == std::minmax(crumb, neighbour) &&
        work.graph.edges[polygons.graph_edge[i]].is_new)
      taken_back[polygons.graph_edge[i]] = 1;
  }
  Index kept = 0;
  for (Index i = 0; i < taken_back.size(); ++i)
    if (taken_back[i] == 0) work.graph.edges[kept++] = work.graph.edges[i];
  work.graph.edges.resize(kept);
  return true;
}

}  // namespace

bool keeps_all_fragments(const TriangleWork& work, const DisjointPolygons& polygons) {
  if (!work.graph.complete) return false;
  std::vector<std::uint8_t> kept(work.before.polygons.size(), 0);
  for (const Index parent : polygons.parent)
    if (parent < kept.size()) kept[parent] = 1;
  return std::find(kept.begin(), kept.end(), 0) == kept.end();
}

DisjointPolygons weld_slivers(const HybridMesh& mesh, TriangleWork& work, const CutContext& context) {
  if (!work.graph.complete) return {};
  DisjointPolygons polygons = detect_disjoint_polygons(work);
  while (weld_smallest(mesh, work, polygons, context)) {
    work.changed = differs_from_before(work);
    polygons = detect_disjoint_polygons(work);
  }
  return polygons;
}

}  // namespace cut

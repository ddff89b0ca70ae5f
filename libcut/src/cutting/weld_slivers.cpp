#include "cutting/weld_slivers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cutting/arrange_triangle.hpp"
#include "cutting/detect_disjoint_polygons.hpp"
#include "cutting/edge_state.hpp"
#include "lattice/orientation.hpp"
#include "lattice/scratch.hpp"

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
lattice::ScratchList<std::uint8_t> joined_to_neighbours(const HybridMesh& mesh, const TriangleWork& work,
                                                        const Arrangement& arrangement,
                                                        lattice::Scratch& scratch) {
  lattice::ScratchList<std::uint8_t> joined(arrangement.polygons.size(), 0, &scratch);
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

/// Two polygons that were one before this cut, and the length of the new edges between them.
struct Contact {
  Index polygon;
  Index neighbour;
  double length;
};

/// From both sides, sorted by polygon.
lattice::ScratchList<Contact> contacts_of(const TriangleWork& work, const DisjointPolygons& polygons,
                                          lattice::Scratch& scratch) {
  const Arrangement& arrangement = polygons.arrangement;
  lattice::ScratchList<Contact> contacts(&scratch);
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    const CutEdge& e = arrangement.edges[i];
    if (e.left == e.right || !work.graph.edges[polygons.graph_edge[i]].is_new ||
        polygons.parent[e.left] != polygons.parent[e.right])
      continue;
    const double length = work.metric.length(arrangement.nodes[e.from].point, arrangement.nodes[e.to].point);
    contacts.push_back({e.left, e.right, length});
    contacts.push_back({e.right, e.left, length});
  }
  const auto pair_of = [](const Contact& c) { return std::pair(c.polygon, c.neighbour); };
  std::stable_sort(contacts.begin(), contacts.end(),
                   [&](const Contact& a, const Contact& b) { return pair_of(a) < pair_of(b); });
  std::size_t last = 0;
  for (std::size_t i = 1; i < contacts.size(); ++i) {
    if (pair_of(contacts[i]) == pair_of(contacts[last]))
      contacts[last].length += contacts[i].length;
    else
      contacts[++last] = contacts[i];
  }
  if (!contacts.empty()) contacts.resize(last + 1);
  return contacts;
}

/// Takes back the new edges that cut off crumbs, the smallest first. A crumb beside one that was welded, or
/// that had to wait, waits for the next round, in which it may be none. @return false when there is none
bool weld_crumbs(const HybridMesh& mesh, TriangleWork& work, const DisjointPolygons& polygons) {
  const Arrangement& arrangement = polygons.arrangement;
  if (arrangement.polygons.size() <= work.before.polygons.size()) return false;
  lattice::Scratch scratch;
  const auto joined = joined_to_neighbours(mesh, work, arrangement, scratch);
  const auto contacts = contacts_of(work, polygons, scratch);
  lattice::ScratchList<Index> crumbs(&scratch);  // each by its first contact
  for (Index c = 0; c < contacts.size(); ++c) {
    const Index p = contacts[c].polygon;
    if ((c == 0 || contacts[c - 1].polygon != p) && joined[p] == 0 &&
        width(work, polygons, p) < work.distances.node)
      crumbs.push_back(c);
  }
  if (crumbs.empty()) return false;
  std::sort(crumbs.begin(), crumbs.end(), [&](Index a, Index b) {
    return std::pair(polygons.doubled_area[contacts[a].polygon], a) <
           std::pair(polygons.doubled_area[contacts[b].polygon], b);
  });
  constexpr Index nobody = HybridMesh::none;
  lattice::ScratchList<Index> welded_to(arrangement.polygons.size(), nobody, &scratch);
  lattice::ScratchList<std::uint8_t> touched(arrangement.polygons.size(), 0, &scratch);
  for (const Index first : crumbs) {
    const Index crumb = contacts[first].polygon;
    Index longest = first;
    bool waits = touched[crumb] != 0;
    Index end = first;
    for (; end < contacts.size() && contacts[end].polygon == crumb; ++end) {
      waits = waits || touched[contacts[end].neighbour] != 0;
      if (contacts[end].length > contacts[longest].length) longest = end;
    }
    if (!waits) welded_to[crumb] = contacts[longest].neighbour;
    touched[crumb] = 1;
    for (Index c = first; c < end; ++c) touched[contacts[c].neighbour] = 1;
  }
  lattice::ScratchList<std::uint8_t> taken_back(work.graph.edges.size(), 0, &scratch);
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    const CutEdge& e = arrangement.edges[i];
    if (e.left != e.right && (welded_to[e.left] == e.right || welded_to[e.right] == e.left) &&
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
  lattice::Scratch scratch;
  lattice::ScratchList<std::uint8_t> kept(work.before.polygons.size(), 0, &scratch);
  for (const Index parent : polygons.parent)
    if (parent < kept.size()) kept[parent] = 1;
  return std::find(kept.begin(), kept.end(), 0) == kept.end();
}

DisjointPolygons weld_slivers(const HybridMesh& mesh, TriangleWork& work) {
  if (!work.graph.complete) return {};
  DisjointPolygons polygons = detect_disjoint_polygons(work);
  while (weld_crumbs(mesh, work, polygons)) {
    work.changed = differs_from_before(work);
    polygons = detect_disjoint_polygons(work);
  }
  return polygons;
}

}  // namespace cut

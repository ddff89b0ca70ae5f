#include "cutting/angles.hpp"

#include <algorithm>
#include <tuple>

#include "cutting/in_parts.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

/// When from → to is a section of a side, notes it in the angle.
void find_section(const HybridMesh& mesh, const Arrangement& arrangement, Index from, Index to, Angle& angle,
                  std::size_t which) {
  const Index first_inner = arrangement.first_inner_node();
  if (from >= first_inner || to >= first_inner) return;
  Index first = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index count = arrangement.boundary_counts[i];
    const Index section =
        from == i ? 0 : (from >= first && from < first + count ? from - first + 1 : HybridMesh::none);
    first += count;
    if (section == HybridMesh::none || arrangement.edge_node(i, section + 1) != to) continue;
    angle.edge[which] = mesh.ancestors.triangles[angle.ancestor.index()].edges[i];
    angle.section[which] = mesh.ancestors.reversed(angle.ancestor, i) ? count - section : section;
    return;
  }
}

/// Appends all angles of a cut triangle, sorted by node.
void append_angles(const HybridMesh& mesh, AncestorId a, std::vector<Angle>& list) {
  const auto first = static_cast<std::ptrdiff_t>(list.size());
  const Arrangement& arrangement = *mesh.arrangement(a);
  for (Index p = 0; p < arrangement.polygons.size(); ++p) {
    const RenderPolygon& polygon = arrangement.polygons[p];
    Index begin = 0;
    for (const Index end : polygon.loop_ends) {
      for (Index c = begin; c < end; ++c) {
        const Index previous = polygon.corners[c == begin ? end - 1 : c - 1].node;
        const Index next = polygon.corners[c + 1 == end ? begin : c + 1].node;
        Angle angle{a, polygon.corners[c].node, p, c, {}, {}};
        find_section(mesh, arrangement, previous, angle.node, angle, 0);
        find_section(mesh, arrangement, angle.node, next, angle, 1);
        list.push_back(angle);
      }
      begin = end;
    }
  }
  std::sort(list.begin() + first, list.end(), [](const Angle& l, const Angle& r) {
    return std::tie(l.node, l.polygon, l.corner) < std::tie(r.node, r.polygon, r.corner);
  });
}

/// Index, among the nodes of triangle a, of the boundary node at t of one of its edges.
Index boundary_node_index(const HybridMesh& mesh, AncestorId a, AncestorEdgeId edge, std::int32_t t) {
  const Arrangement& arrangement = *mesh.arrangement(a);
  const EdgeState& state = *mesh.edge_state(edge);
  const std::size_t i = mesh.ancestors.local_edge(a, edge);
  const auto k = static_cast<Index>(
      std::find_if(state.nodes.begin(), state.nodes.end(), [&](const BoundaryNode& n) { return n.t == t; }) -
      state.nodes.begin());
  const auto count = static_cast<Index>(state.nodes.size());
  return arrangement.edge_node(i, mesh.ancestors.reversed(a, i) ? count - k : k + 1);
}

}  // namespace

Angles::Angles(const HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor)
    : mesh_(mesh) {
  for (const auto& part : in_parts<std::vector<AncestorId>>(
           executor, nodes.size(), [&](std::size_t i, std::vector<AncestorId>& cut) {
             for (const AncestorId a : mesh.ancestors.triangles_around(nodes[i]))
               if (mesh.arrangement(a) != nullptr) cut.push_back(a);
           }))
    append(triangles_, part);
  lattice::sort_unique(triangles_);
  parts_ = in_parts<Part>(executor, triangles_.size(), [&](std::size_t i, Part& part) {
    append_angles(mesh, triangles_[i], part.angles);
    part.ends.push_back(part.angles.size());
  });
}

std::span<const Angle> Angles::of(AncestorId a) const {
  const auto found = std::lower_bound(triangles_.begin(), triangles_.end(), a);
  const auto i = static_cast<std::size_t>(found - triangles_.begin());
  const std::size_t turns = turns_per_part(triangles_.size());
  const Part& part = parts_[i / turns];
  const std::size_t begin = i % turns == 0 ? 0 : part.ends[i % turns - 1];
  return {part.angles.data() + begin, part.ends[i % turns] - begin};
}

void Angles::append_at(AncestorId a, Index node, std::vector<Angle>& group) const {
  if (mesh_.arrangement(a) == nullptr) {
    const auto& edges = mesh_.ancestors.triangles[a.index()].edges;
    group.push_back({a, node, 0, node, {edges[last_corner(node)], edges[node]}, {}});
    return;
  }
  const auto list = of(a);
  const auto [begin, end] = std::equal_range(list.begin(), list.end(), Angle{a, node, 0, 0, {}, {}},
                                             [](const Angle& l, const Angle& r) { return l.node < r.node; });
  group.insert(group.end(), begin, end);
}

void Angles::append_at(AncestorId a, AncestorEdgeId edge, std::int32_t t, std::vector<Angle>& group) const {
  append_at(a, boundary_node_index(mesh_, a, edge, t), group);
}

}  // namespace cut

#include "cutting/copy_boundary_nodes.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cutting/angles.hpp"
#include "cutting/edge_state.hpp"
#include "cutting/in_parts.hpp"
#include "lattice/components.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

class VertexCopier {
 public:
  VertexCopier(HybridMesh& mesh, ChangeLog& log, const Executor& executor)
      : mesh_(mesh), log_(log), executor_(executor) {}

  std::vector<std::pair<AncestorId, Index>> run(std::span<const TriangleWork> works) {
    struct Around {
      std::vector<AncestorNodeId> nodes;
      std::vector<AncestorEdgeId> edges;
      std::vector<RenderVertexId> lost;
    };
    std::vector<AncestorNodeId> nodes;
    std::vector<AncestorEdgeId> edges;
    std::vector<RenderVertexId> lost;
    for (const Around& part : in_parts<Around>(executor_, works.size(), [&](std::size_t i, Around& around) {
           inherit_vertices(works[i], around.lost);
           const Ancestor& ancestor = mesh_.ancestors.triangles[works[i].ancestor.index()];
           append(around.nodes, ancestor.nodes);
           for (const AncestorEdgeId edge : ancestor.edges)
             if (mesh_.edge_state(edge)) around.edges.push_back(edge);
         })) {
      append(nodes, part.nodes);
      append(edges, part.edges);
      append(lost, part.lost);
    }
    lattice::sort_unique(nodes);
    lattice::sort_unique(edges);
    const Angles angles(mesh_, nodes, executor_);
    std::vector<Groups> parts = in_parts<Groups>(executor_, works.size() + edges.size() + nodes.size(),
                                                 [&](std::size_t i, Groups& groups) {
                                                   if (i < works.size())
                                                     groups_of_inner_nodes(works[i].ancestor, angles, groups);
                                                   else if (i -= works.size(); i < edges.size())
                                                     groups_of_edge(edges[i], angles, groups);
                                                   else
                                                     group_of_node(nodes[i - edges.size()], angles, groups);
                                                 });
    number(parts);
    executor_.for_each(parts.size(), [&](std::size_t p) { assign_all(parts[p]); });
    for (const Groups& part : parts) {
      append(log_.render_vertices, part.written);
      append(log_.render_triangles, part.written_triangles);
      append(lost, part.lost);
      for (const auto& [angle, id] : part.triangulated) replace_in_triangles(angle, id);
    }
    free(lost);
    lattice::sort_unique(come_apart_);
    return std::move(come_apart_);
  }

 private:
  /// Angles at some nodes, one node after the other, which of them are connected, and their vertices. A
  /// vertex belongs to one node, so that nodes need not know what others do but for the numbers of new
  /// vertices.
  struct Groups {
    std::vector<Angle> angles;
    std::vector<Index> roots;  ///< per angle: the first angle of its component, counted within the node
    std::vector<RenderVertexId> vertices;  ///< per angle that is a root: invalid where a new one is needed
    std::vector<std::size_t> ends;
    std::size_t fresh = 0;  ///< how many new vertices; then the number of the next
    std::vector<RenderVertexId> lost;
    std::vector<Index> written;
    std::vector<Index> written_triangles;
    std::vector<std::pair<Angle, RenderVertexId>> triangulated;  ///< of polygons that are not arranged anew
    lattice::Components components{0};
    std::vector<std::tuple<AncestorEdgeId, Index, Index>> sides;
    std::vector<RenderVertexId> claimed;

    [[nodiscard]] std::size_t begin() const { return ends.empty() ? 0 : ends.back(); }
  };

  void groups_of_inner_nodes(AncestorId a, const Angles& angles, Groups& groups) {
    const std::span<const Angle> all = angles.of(a);
    const Index first_inner = mesh_.arrangement(a)->first_inner_node();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].node < first_inner) continue;
      groups.roots.push_back(static_cast<Index>(groups.angles.size() - groups.begin()));
      groups.angles.push_back(all[i]);
      if (i + 1 == all.size() || all[i + 1].node != all[i].node) end_group(groups);
    }
  }
  void groups_of_edge(AncestorEdgeId edge, const Angles& angles, Groups& groups) {
    for (const BoundaryNode& n : mesh_.edge_state(edge)->nodes) {
      for (const AncestorId a : mesh_.ancestors.edges[edge.index()].triangles)
        if (a.valid()) angles.append_at(a, edge, n.t, groups.angles);
      connect(groups);
      end_group(groups);
    }
  }
  void group_of_node(AncestorNodeId node, const Angles& angles, Groups& groups) {
    for (const AncestorId a : mesh_.ancestors.triangles_around(node))
      angles.append_at(a, static_cast<Index>(mesh_.ancestors.local_node(a, node)), groups.angles);
    connect(groups);
    end_group(groups);
  }

  /// Finds the components of the angles since the last end.
  void connect(Groups& groups) const {
    const std::size_t begin = groups.begin();
    const std::span<const Angle> group{groups.angles.data() + begin, groups.angles.size() - begin};
    groups.components.reset(group.size());
    groups.sides.clear();
    for (Index i = 0; i < group.size(); ++i)
      for (std::size_t which = 0; which < 2; ++which)
        if (group[i].edge[which].valid())
          groups.sides.emplace_back(group[i].edge[which], group[i].section[which], i);
    std::sort(groups.sides.begin(), groups.sides.end());
    for (std::size_t k = 0; k + 1 < groups.sides.size(); ++k) {
      const auto& [edge, section, i] = groups.sides[k];
      const auto& [next_edge, next_section, j] = groups.sides[k + 1];
      if (edge == next_edge && section == next_section && !is_cut(mesh_.edge_state(edge), section))
        groups.components.join(i, j);
    }
    for (Index i = 0; i < group.size(); ++i) groups.roots.push_back(groups.components.root(i));
  }

  /// Each component of the angles since the last end gets the first of the vertices that it proposes which no
  /// component before it has got.
  void end_group(Groups& groups) {
    const std::size_t begin = groups.begin(), end = groups.angles.size();
    groups.vertices.resize(end);
    groups.claimed.clear();
    const auto is_claimed = [&](RenderVertexId id) {
      return std::ranges::find(groups.claimed, id) != groups.claimed.end();
    };
    for (std::size_t root = begin; root < end; ++root) {
      if (groups.roots[root] != root - begin) continue;
      RenderVertexId& id = groups.vertices[root];
      for (std::size_t i = root; i < end && !id.valid(); ++i)
        if (groups.roots[i] == root - begin)
          if (const RenderVertexId proposed = vertex(groups.angles[i]);
              proposed.valid() && !is_claimed(proposed))
            id = proposed;
      if (id.valid())
        groups.claimed.push_back(id);
      else
        ++groups.fresh;
    }
    for (std::size_t i = begin; i < end; ++i)
      if (const RenderVertexId proposed = vertex(groups.angles[i]); proposed.valid() && !is_claimed(proposed))
        groups.lost.push_back(proposed);
    if (end > begin) groups.ends.push_back(end);
  }

  /// Numbers the new vertices: free entries, then new ones.
  void number(std::vector<Groups>& parts) {
    std::size_t all = 0;
    for (Groups& groups : parts) all += std::exchange(groups.fresh, all);
    auto& free = mesh_.free_render_vertices;
    const std::size_t reused = std::min(all, free.size());
    fresh_.assign(free.rbegin(), free.rbegin() + static_cast<std::ptrdiff_t>(reused));
    free.resize(free.size() - reused);
    auto& vertices = mesh_.buffers.render_vertices;
    for (std::size_t next = vertices.size(); fresh_.size() < all; ++next) fresh_.emplace_back(next);
    vertices.resize(vertices.size() + all - reused);
  }

  /// Gives all components their vertices.
  void assign_all(Groups& groups) {
    std::size_t begin = 0;
    for (const std::size_t end : groups.ends) {
      for (std::size_t root = begin; root < end; ++root) {
        if (groups.roots[root] != root - begin) continue;
        const RenderVertexId id =
            groups.vertices[root].valid() ? groups.vertices[root] : fresh_[groups.fresh++];
        const Angle* representative = &groups.angles[root];
        for (std::size_t i = root; i < end; ++i) {
          if (groups.roots[i] != root - begin) continue;
          const Angle& angle = groups.angles[i];
          if (vertex(angle) != id) replace_vertex(angle, id, groups);
          if (triangle(angle) < triangle(*representative)) representative = &angle;
        }
        write(id, *representative, groups);
      }
      begin = end;
    }
  }

  RenderVertexId& vertex(const Angle& a) {
    const Index index = mesh_.arrangement_of[a.ancestor.index()];
    return index == HybridMesh::none ? mesh_.buffers.render_triangles[a.ancestor.index()].vertices[a.corner]
                                     : mesh_.arrangements[index].polygons[a.polygon].corners[a.corner].vertex;
  }

  /// New corners propose the vertex that their fragment, or the one that it was cut off from, had at their
  /// place before; who comes first gets it. Not that of another fragment: it may be elsewhere in space.
  /// @param lost gets the vertices that no corner of this work proposes
  void inherit_vertices(const TriangleWork& work, std::vector<RenderVertexId>& lost) {
    struct OldCorner {
      LatticePoint point;
      TriangleId fragment;
      RenderVertexId vertex;
      auto operator<=>(const OldCorner&) const = default;
    };
    std::vector<OldCorner> old;
    for (const RenderPolygon& polygon : work.before.polygons)
      for (const PolygonCorner& c : polygon.corners)
        old.push_back({work.before.nodes[c.node].point, polygon.triangle, c.vertex});
    lattice::sort_unique(old);
    std::vector<std::uint8_t> inherited(old.size());
    Arrangement& now = mesh_.arrangements[mesh_.arrangement_of[work.ancestor.index()]];
    for (RenderPolygon& polygon : now.polygons) {
      const TriangleId fragment = source_of(polygon.triangle);
      for (PolygonCorner& c : polygon.corners) {
        const LatticePoint p = now.nodes[c.node].point;
        const auto found =
            std::lower_bound(old.begin(), old.end(), OldCorner{p, fragment, RenderVertexId{0}});
        const bool is_old = found != old.end() && found->point == p && found->fragment == fragment;
        c.vertex = is_old ? found->vertex : RenderVertexId{};
        if (is_old) inherited[static_cast<std::size_t>(found - old.begin())] = 1;
      }
    }
    for (std::size_t i = 0; i < old.size(); ++i)
      if (inherited[i] == 0) lost.push_back(old[i].vertex);
  }

  /// The physics triangle that this one was cut off from by this cut, or itself.
  [[nodiscard]] TriangleId source_of(TriangleId triangle) const {
    const auto& copies = log_.triangle_copies;  // by increasing id, as they were made
    const auto found = std::lower_bound(copies.begin(), copies.end(), triangle,
                                        [](const TriangleCopy& c, TriangleId t) { return c.triangle < t; });
    return found != copies.end() && found->triangle == triangle ? found->source : triangle;
  }

  [[nodiscard]] TriangleId triangle(const Angle& a) const { return mesh_.fragment(a.ancestor, a.polygon); }

  void replace_vertex(const Angle& a, RenderVertexId id, Groups& groups) {
    const Arrangement* arrangement = mesh_.arrangement(a.ancestor);
    if (arrangement != nullptr && !arrangement->polygons[a.polygon].triangles.empty()) {
      groups.triangulated.emplace_back(a, id);
      return;
    }
    vertex(a) = id;  // triangulated later, or uncut
    if (arrangement == nullptr) groups.written_triangles.push_back(a.ancestor.value);
  }

  /// Where the polygon has its render triangles already. Other nodes have their vertices in them, too.
  void replace_in_triangles(const Angle& a, RenderVertexId id) {
    const RenderVertexId old = vertex(a);
    vertex(a) = id;
    const RenderPolygon& polygon = mesh_.arrangement(a.ancestor)->polygons[a.polygon];
    if (old.valid() && std::ranges::count(polygon.corners, old, &PolygonCorner::vertex) > 0) {
      come_apart_.emplace_back(a.ancestor, a.polygon);
      return;
    }
    for (const RenderTriangleId t : polygon.triangles)
      for (RenderVertexId& v : mesh_.buffers.render_triangles[t.index()].vertices)
        if (v == old) {
          v = id;
          log_.render_triangles.push_back(t.value);
        }
  }

  void write(RenderVertexId id, const Angle& a, Groups& groups) {
    RenderVertex value;
    value.triangle = triangle(a);
    value.nodes = mesh_.buffers.triangles[value.triangle.index()].nodes;
    const Arrangement* arrangement = mesh_.arrangement(a.ancestor);
    value.point = arrangement == nullptr ? lattice_corner(a.node) : arrangement->nodes[a.node].point;
    RenderVertex& entry = mesh_.buffers.render_vertices[id.index()];
    if (entry == value) return;
    entry = value;
    groups.written.push_back(id.value);
  }

  /// Frees those of these vertices that no corner has.
  void free(std::vector<RenderVertexId>& lost) {
    lattice::sort_unique(lost);
    for (const RenderVertexId id : lost) {
      if (has_corner(id)) continue;
      mesh_.buffers.render_vertices[id.index()] = RenderVertex{};
      log_.render_vertices.push_back(id.value);
      mesh_.free_render_vertices.push_back(id);
    }
  }

  /// Whether the fragment that the vertex was last written for has it at a corner.
  [[nodiscard]] bool has_corner(RenderVertexId id) const {
    const TriangleId fragment = mesh_.buffers.render_vertices[id.index()].triangle;
    const AncestorId ancestor = mesh_.buffers.triangles[fragment.index()].ancestor;
    if (!ancestor.valid()) return false;
    const Arrangement* arrangement = mesh_.arrangement(ancestor);
    if (arrangement == nullptr)
      return std::ranges::count(mesh_.buffers.render_triangles[ancestor.index()].vertices, id) > 0;
    return std::ranges::any_of(arrangement->polygons, [&](const RenderPolygon& polygon) {
      return polygon.triangle == fragment &&
             std::ranges::count(polygon.corners, id, &PolygonCorner::vertex) > 0;
    });
  }

  HybridMesh& mesh_;
  ChangeLog& log_;
  const Executor& executor_;
  std::vector<RenderVertexId> fresh_;
  std::vector<std::pair<AncestorId, Index>> come_apart_;
};

}  // namespace

std::vector<std::pair<AncestorId, std::uint32_t>> copy_boundary_nodes(HybridMesh& mesh,
                                                                      std::span<const TriangleWork> works,
                                                                      const Executor& executor,
                                                                      ChangeLog& log) {
  return VertexCopier(mesh, log, executor).run(works);
}

}  // namespace cut

#include "cutting/copy_boundary_nodes.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cutting/edge_state.hpp"
#include "cutting/number_set.hpp"
#include "lattice/components.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

/// An angle that a polygon has at a node of its triangle.
struct Angle {
  AncestorId ancestor;
  Index node;
  Index polygon;
  Index corner;
  /// The sections beside it, as indices along their ancestor edges: the one that ends here and the one that
  /// starts here, counterclockwise; an invalid edge where a cut bounds the angle.
  std::array<AncestorEdgeId, 2> edge;
  std::array<Index, 2> section{};
};

class VertexCopier {
 public:
  VertexCopier(HybridMesh& mesh, ChangeLog& log, const Executor& executor)
      : mesh_(mesh), log_(log), executor_(executor) {}

  std::vector<std::pair<AncestorId, Index>> run(std::span<const TriangleWork> works) {
    executor_.for_each(works.size(), [&](std::size_t i) { inherit_vertices(works[i]); });
    std::vector<AncestorNodeId> physics_nodes;
    std::vector<AncestorEdgeId> edges;
    for (std::size_t i = 0; i < works.size(); ++i) {
      for (const RenderPolygon& polygon : works[i].before.polygons)
        for (const PolygonCorner& c : polygon.corners) released_.push_back(c.vertex);
      const Ancestor& ancestor = mesh_.ancestors.triangles[works[i].ancestor.index()];
      physics_nodes.insert(physics_nodes.end(), ancestor.nodes.begin(), ancestor.nodes.end());
      for (const AncestorEdgeId edge : ancestor.edges)
        if (mesh_.edge_state(edge)) edges.push_back(edge);
    }
    lattice::sort_unique(physics_nodes);
    lattice::sort_unique(edges);
    find_angles(physics_nodes);
    claimed_.reserve(2 * released_.size());
    for (const TriangleWork& work : works) {
      const Index first_inner = mesh_.arrangement(work.ancestor)->first_inner_node();
      for (const Angle& angle : angles(work.ancestor))
        if (angle.node >= first_inner) assign({{&angle, 1}, {&only, 1}});
    }
    // In groups of nodes, since one node alone is hardly worth a turn.
    assign_all(edges.size(), [&](std::size_t i, Groups& groups) {
      for (const BoundaryNode& n : mesh_.edge_state(edges[i])->nodes) {
        for (const AncestorId a : mesh_.ancestors.edges[edges[i].index()].triangles)
          if (a.valid()) append_angles(a, boundary_node_index(a, edges[i], n.t), groups.angles);
        end_group(groups);
      }
    });
    assign_all(physics_nodes.size(), [&](std::size_t i, Groups& groups) {
      for (const AncestorId a : mesh_.ancestors.triangles_around(physics_nodes[i]))
        append_angles(a, static_cast<Index>(mesh_.ancestors.local_node(a, physics_nodes[i])), groups.angles);
      end_group(groups);
    });
    free_unclaimed();
    lattice::sort_unique(come_apart_);
    return std::move(come_apart_);
  }

 private:
  /// Angles at some nodes, one node after the other, and which of them are connected.
  struct Groups {
    std::vector<Angle> angles;
    std::vector<Index> roots;  ///< per angle: the first angle of its component, counted within the node
    std::vector<std::size_t> ends;
    lattice::Components components{0};
    std::vector<std::tuple<AncestorEdgeId, Index, Index>> sides;
  };
  struct Group {
    std::span<const Angle> angles;
    std::span<const Index> roots;
  };

  /// Collects angles side by side, and gives them their vertices in order.
  template <class Collect>
  void assign_all(std::size_t count, const Collect& collect) {
    constexpr std::size_t per_turn = 64;
    std::vector<Groups> parts((count + per_turn - 1) / per_turn);
    executor_.for_each(parts.size(), [&](std::size_t part) {
      for (std::size_t i = part * per_turn; i < std::min(count, (part + 1) * per_turn); ++i)
        collect(i, parts[part]);
    });
    for (const Groups& part : parts) {
      std::size_t begin = 0;
      for (const std::size_t end : part.ends) {
        assign({{&part.angles[begin], end - begin}, {&part.roots[begin], end - begin}});
        begin = end;
      }
    }
  }

  /// Finds the components of the angles since the last end.
  void end_group(Groups& groups) const {
    const std::size_t begin = groups.ends.empty() ? 0 : groups.ends.back();
    const std::span<const Angle> group{groups.angles.data() + begin, groups.angles.size() - begin};
    if (group.empty()) return;
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
    groups.ends.push_back(groups.angles.size());
  }

  RenderVertexId& vertex(const Angle& a) {
    const Index index = mesh_.arrangement_of[a.ancestor.index()];
    return index == HybridMesh::none ? mesh_.buffers.render_triangles[a.ancestor.index()].vertices[a.corner]
                                     : mesh_.arrangements[index].polygons[a.polygon].corners[a.corner].vertex;
  }

  /// New corners propose the vertex that their fragment, or the one that it was cut off from, had at their
  /// place before; who comes first gets it. Not that of another fragment: it may be elsewhere in space.
  void inherit_vertices(const TriangleWork& work) {
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
    Arrangement& now = mesh_.arrangements[mesh_.arrangement_of[work.ancestor.index()]];
    for (RenderPolygon& polygon : now.polygons) {
      const TriangleId fragment = source_of(polygon.triangle);
      for (PolygonCorner& c : polygon.corners) {
        const LatticePoint p = now.nodes[c.node].point;
        const auto found =
            std::lower_bound(old.begin(), old.end(), OldCorner{p, fragment, RenderVertexId{0}});
        const bool is_old = found != old.end() && found->point == p && found->fragment == fragment;
        c.vertex = is_old ? found->vertex : RenderVertexId{};
      }
    }
  }

  /// The physics triangle that this one was cut off from by this cut, or itself.
  [[nodiscard]] TriangleId source_of(TriangleId triangle) const {
    const auto& copies = log_.triangle_copies;  // by increasing id, as they were made
    const auto found = std::lower_bound(copies.begin(), copies.end(), triangle,
                                        [](const TriangleCopy& c, TriangleId t) { return c.triangle < t; });
    return found != copies.end() && found->triangle == triangle ? found->source : triangle;
  }

  /// Index, among the nodes of triangle a, of the boundary node at t of one of its edges.
  [[nodiscard]] Index boundary_node_index(AncestorId a, AncestorEdgeId edge, std::int32_t t) const {
    const Arrangement& arrangement = *mesh_.arrangement(a);
    const EdgeState& state = *mesh_.edge_state(edge);
    const std::size_t i = mesh_.ancestors.local_edge(a, edge);
    const auto k = static_cast<Index>(std::find_if(state.nodes.begin(), state.nodes.end(),
                                                   [&](const BoundaryNode& n) { return n.t == t; }) -
                                      state.nodes.begin());
    const auto count = static_cast<Index>(state.nodes.size());
    return arrangement.edge_node(i, mesh_.ancestors.reversed(a, i) ? count - k : k + 1);
  }

  /// Those of all cut triangles around these nodes.
  void find_angles(const std::vector<AncestorNodeId>& physics_nodes) {
    for (const AncestorNodeId node : physics_nodes)
      for (const AncestorId a : mesh_.ancestors.triangles_around(node))
        if (mesh_.arrangement(a) != nullptr) with_angles_.push_back(a);
    lattice::sort_unique(with_angles_);
    angles_.resize(with_angles_.size());
    executor_.for_each(with_angles_.size(), [&](std::size_t i) { angles_[i] = angles_of(with_angles_[i]); });
  }

  [[nodiscard]] const std::vector<Angle>& angles(AncestorId a) const {
    const auto found = std::lower_bound(with_angles_.begin(), with_angles_.end(), a);
    return angles_[static_cast<std::size_t>(found - with_angles_.begin())];
  }

  /// All angles of a cut triangle, sorted by node.
  [[nodiscard]] std::vector<Angle> angles_of(AncestorId a) const {
    std::vector<Angle> list;
    const Arrangement& arrangement = *mesh_.arrangement(a);
    for (Index p = 0; p < arrangement.polygons.size(); ++p) {
      const RenderPolygon& polygon = arrangement.polygons[p];
      Index begin = 0;
      for (const Index end : polygon.loop_ends) {
        for (Index c = begin; c < end; ++c) {
          const Index previous = polygon.corners[c == begin ? end - 1 : c - 1].node;
          const Index next = polygon.corners[c + 1 == end ? begin : c + 1].node;
          Angle angle{a, polygon.corners[c].node, p, c, {}, {}};
          find_section(arrangement, previous, angle.node, angle, 0);
          find_section(arrangement, angle.node, next, angle, 1);
          list.push_back(angle);
        }
        begin = end;
      }
    }
    std::sort(list.begin(), list.end(), [](const Angle& l, const Angle& r) {
      return std::tie(l.node, l.polygon, l.corner) < std::tie(r.node, r.polygon, r.corner);
    });
    return list;
  }

  /// When from → to is a section of a side, notes it in the angle.
  void find_section(const Arrangement& arrangement, Index from, Index to, Angle& angle,
                    std::size_t which) const {
    const Index first_inner = arrangement.first_inner_node();
    if (from >= first_inner || to >= first_inner) return;
    Index first = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index count = arrangement.boundary_counts[i];
      const Index section =
          from == i ? 0 : (from >= first && from < first + count ? from - first + 1 : HybridMesh::none);
      first += count;
      if (section == HybridMesh::none || arrangement.edge_node(i, section + 1) != to) continue;
      angle.edge[which] = mesh_.ancestors.triangles[angle.ancestor.index()].edges[i];
      angle.section[which] = mesh_.ancestors.reversed(angle.ancestor, i) ? count - section : section;
      return;
    }
  }

  void append_angles(AncestorId a, Index node, std::vector<Angle>& group) const {
    if (mesh_.arrangement(a) == nullptr) {
      const auto& edges = mesh_.ancestors.triangles[a.index()].edges;
      group.push_back({a, node, 0, node, {edges[last_corner(node)], edges[node]}, {}});
      return;
    }
    const auto& list = angles(a);
    const auto [begin, end] =
        std::equal_range(list.begin(), list.end(), Angle{a, node, 0, 0, {}, {}},
                         [](const Angle& l, const Angle& r) { return l.node < r.node; });
    group.insert(group.end(), begin, end);
  }

  /// Gives each component of angles at one node its vertex.
  void assign(const Group& group) {
    const auto size = static_cast<Index>(group.angles.size());
    for (Index root = 0; root < size; ++root) {
      if (group.roots[root] != root) continue;
      RenderVertexId id;
      const Angle* representative = nullptr;
      for (Index i = root; i < size; ++i) {
        if (group.roots[i] != root) continue;
        const Angle& angle = group.angles[i];
        const RenderVertexId proposed = vertex(angle);
        if (proposed.valid()) released_.push_back(proposed);
        if (!id.valid() && proposed.valid() && !claimed_.contains(proposed.value)) id = proposed;
        if (representative == nullptr || triangle(angle) < triangle(*representative)) representative = &angle;
      }
      if (!id.valid()) id = allocate();
      claimed_.insert(id.value);
      for (Index i = root; i < size; ++i)
        if (group.roots[i] == root && vertex(group.angles[i]) != id) replace_vertex(group.angles[i], id);
      write(id, *representative);
    }
  }

  [[nodiscard]] TriangleId triangle(const Angle& a) const { return mesh_.fragment(a.ancestor, a.polygon); }

  void replace_vertex(const Angle& a, RenderVertexId id) {
    const RenderVertexId old = vertex(a);
    vertex(a) = id;
    const Arrangement* arrangement = mesh_.arrangement(a.ancestor);
    if (arrangement == nullptr) {
      log_.render_triangles.push_back(a.ancestor.value);
      return;
    }
    const RenderPolygon& polygon = arrangement->polygons[a.polygon];
    if (polygon.triangles.empty()) return;  // it is arranged anew, and triangulated later
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

  RenderVertexId allocate() {
    if (!mesh_.free_render_vertices.empty()) {
      const RenderVertexId id = mesh_.free_render_vertices.back();
      mesh_.free_render_vertices.pop_back();
      return id;
    }
    mesh_.buffers.render_vertices.emplace_back();
    return RenderVertexId{mesh_.buffers.render_vertices.size() - 1};
  }

  void write(RenderVertexId id, const Angle& a) {
    RenderVertex value;
    value.triangle = triangle(a);
    value.nodes = mesh_.buffers.triangles[value.triangle.index()].nodes;
    const Arrangement* arrangement = mesh_.arrangement(a.ancestor);
    value.point = arrangement == nullptr ? lattice_corner(a.node) : arrangement->nodes[a.node].point;
    RenderVertex& entry = mesh_.buffers.render_vertices[id.index()];
    if (entry == value) return;
    entry = value;
    log_.render_vertices.push_back(id.value);
  }

  void free_unclaimed() {
    std::erase_if(released_, [&](RenderVertexId id) { return claimed_.contains(id.value); });
    lattice::sort_unique(released_);
    for (const RenderVertexId id : released_) {
      mesh_.buffers.render_vertices[id.index()] = RenderVertex{};
      log_.render_vertices.push_back(id.value);
      mesh_.free_render_vertices.push_back(id);
    }
  }

  static constexpr Index only = 0;  ///< the root of an angle by itself
  HybridMesh& mesh_;
  ChangeLog& log_;
  const Executor& executor_;
  std::vector<AncestorId> with_angles_;  ///< sorted
  std::vector<std::vector<Angle>> angles_;
  std::vector<RenderVertexId> released_;
  std::vector<std::pair<AncestorId, Index>> come_apart_;
  NumberSet claimed_;
};

}  // namespace

std::vector<std::pair<AncestorId, std::uint32_t>> copy_boundary_nodes(HybridMesh& mesh,
                                                                      std::span<const TriangleWork> works,
                                                                      const Executor& executor,
                                                                      ChangeLog& log) {
  return VertexCopier(mesh, log, executor).run(works);
}

}  // namespace cut

#include "cutting/copy_boundary_nodes.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cutting/edge_state.hpp"
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
  VertexCopier(HybridMesh& mesh, ChangeLog& log) : mesh_(mesh), log_(log) {}

  void run(std::span<const TriangleWork> works) {
    for (const TriangleWork& work : works) inherit_vertices(work);
    std::vector<AncestorNodeId> physics_nodes;
    std::vector<std::pair<AncestorEdgeId, std::int32_t>> boundary_nodes;
    for (const TriangleWork& work : works) {
      const Ancestor& ancestor = mesh_.ancestors.triangles[work.ancestor.index()];
      for (std::size_t i = 0; i < 3; ++i) {
        physics_nodes.push_back(ancestor.nodes[i]);
        if (const EdgeState* state = mesh_.edge_state(ancestor.edges[i]))
          for (const BoundaryNode& n : state->nodes) boundary_nodes.emplace_back(ancestor.edges[i], n.t);
      }
      const Index first_inner = mesh_.arrangement(work.ancestor)->first_inner_node();
      for (const Angle& angle : angles(work.ancestor))
        if (angle.node >= first_inner) assign({&angle, 1});
    }
    lattice::sort_unique(physics_nodes);
    lattice::sort_unique(boundary_nodes);
    std::vector<Angle> group;
    for (const auto& [edge, t] : boundary_nodes) {
      group.clear();
      for (const AncestorId a : mesh_.ancestors.edges[edge.index()].triangles)
        if (a.valid()) append_angles(a, boundary_node_index(a, edge, t), group);
      assign(group);
    }
    for (const AncestorNodeId node : physics_nodes) {
      group.clear();
      for (const AncestorId a : mesh_.ancestors.triangles_around(node))
        append_angles(a, static_cast<Index>(mesh_.ancestors.local_node(a, node)), group);
      assign(group);
    }
    free_unclaimed();
  }

 private:
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
      for (const PolygonCorner& c : polygon.corners) {
        old.push_back({work.before.nodes[c.node].point, polygon.triangle, c.vertex});
        released_.push_back(c.vertex);
      }
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

  /// All angles of a cut triangle, sorted by node.
  const std::vector<Angle>& angles(AncestorId a) {
    const auto [entry, added] = angles_.try_emplace(a);
    if (!added) return entry->second;
    std::vector<Angle>& list = entry->second;
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

  void append_angles(AncestorId a, Index node, std::vector<Angle>& group) {
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
  void assign(std::span<const Angle> group) {
    lattice::Components& components = components_;
    auto& sides = sides_;
    components.reset(group.size());
    sides.clear();
    for (Index i = 0; i < group.size(); ++i)
      for (std::size_t which = 0; which < 2; ++which)
        if (group[i].edge[which].valid())
          sides.emplace_back(group[i].edge[which], group[i].section[which], i);
    std::sort(sides.begin(), sides.end());
    for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
      const auto& [edge, section, i] = sides[k];
      const auto& [next_edge, next_section, j] = sides[k + 1];
      if (edge == next_edge && section == next_section && !is_cut(mesh_.edge_state(edge), section))
        components.join(i, j);
    }
    for (Index root = 0; root < group.size(); ++root) {
      if (components.root(root) != root) continue;
      RenderVertexId id;
      const Angle* representative = nullptr;
      for (Index i = root; i < group.size(); ++i) {
        if (components.root(i) != root) continue;
        const RenderVertexId proposed = vertex(group[i]);
        if (proposed.valid()) released_.push_back(proposed);
        if (!id.valid() && proposed.valid() && !claimed_.contains(proposed.value)) id = proposed;
        if (representative == nullptr || triangle(group[i]) < triangle(*representative))
          representative = &group[i];
      }
      if (!id.valid()) id = allocate();
      claimed_.insert(id.value);
      for (Index i = root; i < group.size(); ++i)
        if (components.root(i) == root && vertex(group[i]) != id) replace_vertex(group[i], id);
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
    for (const RenderTriangleId t : arrangement->polygons[a.polygon].triangles)
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
    lattice::sort_unique(released_);
    for (const RenderVertexId id : released_) {
      if (claimed_.contains(id.value)) continue;
      mesh_.buffers.render_vertices[id.index()] = RenderVertex{};
      log_.render_vertices.push_back(id.value);
      mesh_.free_render_vertices.push_back(id);
    }
  }

  HybridMesh& mesh_;
  ChangeLog& log_;
  std::unordered_map<AncestorId, std::vector<Angle>> angles_;
  std::vector<RenderVertexId> released_;
  std::unordered_set<Index> claimed_;
  // Of `assign`, kept for their memory.
  lattice::Components components_{0};
  std::vector<std::tuple<AncestorEdgeId, Index, Index>> sides_;
};

}  // namespace

void copy_boundary_nodes(HybridMesh& mesh, std::span<const TriangleWork> works, ChangeLog& log) {
  VertexCopier(mesh, log).run(works);
}

}  // namespace cut

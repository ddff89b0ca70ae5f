/// @file
/// Rules physics_nodes_are_components, render_vertices_are_components and components_agree: a flood fill over
/// uncut sections says which corners must be one physics node, which wedges one render vertex, and which
/// fragments hang together (§4.6, §4.8, §4.10). In: the mesh. Out: violations.
#include "validate/flood.hpp"
#include "validate/place.hpp"
#include "validate/rules.hpp"
#include "validate/union_find.hpp"

namespace cut::validation {
namespace {

/// Checks that two elements have the same id exactly when they are in the same set.
class OneToOne {
 public:
  OneToOne(std::size_t sets, std::size_t ids) : id_of_(sets, nothing), set_of_(ids, nothing) {}
  bool add(std::uint32_t set, std::uint32_t id) {
    if (id_of_[set] == nothing) id_of_[set] = id;
    if (set_of_[id] == nothing) set_of_[id] = set;
    return id_of_[set] == id && set_of_[id] == set;
  }
  [[nodiscard]] bool used(std::uint32_t id) const { return set_of_[id] != nothing; }

 private:
  std::vector<std::uint32_t> id_of_;
  std::vector<std::uint32_t> set_of_;
};

/// The copies of a node are the connected components of its fragments, joined by sections of edges that end
/// there.
void check_physics_nodes(const HybridMesh& mesh, const Flood& flood, Report& report) {
  constexpr const char* rule = "physics_nodes_are_components";
  UnionFind corners(std::size_t{3} * flood.first_fragment.back());
  for (const Section& s : flood.joined)
    for (std::size_t end = 0; end < 2; ++end)
      corners.join(static_cast<std::uint32_t>(3 * s.sides[0].fragment + s.sides[0].corner[end]),
                   static_cast<std::uint32_t>(3 * s.sides[1].fragment + s.sides[1].corner[end]));

  OneToOne match(corners.size(), mesh.buffers.nodes.size());
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t)
    for (std::size_t f = 0; f < mesh.fragment_count(AncestorId{t}); ++f) {
      const TriangleId id = mesh.fragment(AncestorId{t}, f);
      if (id.index() >= mesh.buffers.triangles.size()) continue;
      const PhysicsTriangle& triangle = mesh.buffers.triangles[id.index()];
      if (!triangle.ancestor.valid()) continue;  // reported by fragments_match
      for (std::size_t i = 0; i < 3; ++i) {
        const auto corner = static_cast<std::uint32_t>(3 * (flood.first_fragment[t] + f) + i);
        if (!match.add(corners.find(corner), triangle.nodes[i].value))
          report.add(rule, name("node", triangle.nodes[i].index()) + " of triangle " +
                               std::to_string(id.index()) + " is not one connected set of fragments");
      }
    }
  for (std::size_t n = 0; n < mesh.buffers.nodes.size(); ++n) {
    const bool lonely = mesh.ancestors.triangles_around(mesh.buffers.nodes[n]).empty();  // so in the input
    if (match.used(static_cast<std::uint32_t>(n)) == lonely)
      report.add(rule, name("node", n) + (lonely ? " came out of nowhere" : " belongs to no triangle"));
  }
}

/// The vertex that the mesh uses at each wedge, and the place where it should be.
struct Wedges {
  std::vector<std::uint32_t> vertex;
  std::vector<Place> place;
};

Wedges wedges_of(const HybridMesh& mesh, const Flood& flood) {
  Wedges wedges{std::vector<std::uint32_t>(flood.first_wedge.back(), nothing), {}};
  wedges.place.reserve(wedges.vertex.size());
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const Arrangement* a = mesh.arrangement(AncestorId{t});
    for (std::size_t i = 0; !a && i < 3; ++i)
      wedges.place.push_back(place_of(mesh.ancestors, AncestorId{t}, lattice_corner(i)));
    for (std::size_t p = 0; a && p < a->polygons.size(); ++p)
      for (const PolygonCorner& c : a->polygons[p].corners) {
        wedges.vertex[wedges.place.size()] = c.vertex.value;
        wedges.place.push_back(place_of(mesh.ancestors, AncestorId{t}, a->nodes[c.node].point));
      }
  }
  // The corners of uncut triangles: their render triangle tells.
  for (const RenderTriangle& triangle : mesh.buffers.render_triangles) {
    const std::size_t t = triangle.triangle.index();
    if (!triangle.triangle.valid() || t >= mesh.ancestors.triangles.size() || mesh.arrangement(AncestorId{t}))
      continue;
    for (const RenderVertexId v : triangle.vertices)
      for (std::size_t i = 0; i < 3; ++i)
        if (place_of(mesh, v) == wedges.place[flood.first_wedge[t] + i])
          wedges.vertex[flood.first_wedge[t] + i] = v.value;
  }
  return wedges;
}

/// A render vertex is one connected fan of wedges, and it lies at their node.
void check_render_vertices(const HybridMesh& mesh, const Flood& flood, Report& report) {
  constexpr const char* rule = "render_vertices_are_components";
  const Wedges wedges = wedges_of(mesh, flood);
  UnionFind fans(wedges.vertex.size());
  for (const Section& s : flood.joined)
    for (std::size_t end = 0; end < 2; ++end) {
      if (s.sides[0].wedge[end] == nothing || s.sides[1].wedge[end] == nothing) continue;  // edge_sides_agree
      fans.join(s.sides[0].wedge[end], s.sides[1].wedge[end]);
    }

  const auto& vertices = mesh.buffers.render_vertices;
  OneToOne match(wedges.vertex.size(), vertices.size());
  std::vector<std::uint8_t> seen_from_owner(vertices.size(), 0);
  std::uint32_t w = 0;
  const auto check = [&](TriangleId fragment) {
    const std::uint32_t v = wedges.vertex[w];
    if (v == nothing) return;  // reported by render_triangles_cover_polygons
    if (!match.add(fans.find(w), v))
      report.add(rule, name("render vertex", v) + " of triangle " + std::to_string(fragment.index()) +
                           " is not one connected fan");
    if (place_of(mesh, RenderVertexId{v}) != wedges.place[w])
      report.add(rule, name("render vertex", v) + " of triangle " + std::to_string(fragment.index()) +
                           " lies elsewhere than its node");
    if (vertices[v].triangle == fragment) seen_from_owner[v] = 1;
  };
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const Arrangement* a = mesh.arrangement(AncestorId{t});
    for (std::size_t i = 0; !a && i < 3; ++i, ++w) check(TriangleId{t});
    for (std::size_t p = 0; a && p < a->polygons.size(); ++p)
      for (std::size_t i = 0; i < a->polygons[p].corners.size(); ++i, ++w) check(a->polygons[p].triangle);
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (vertices[v].triangle.valid() && seen_from_owner[v] == 0)
      report.add(rule, name("render vertex", v) + " is no corner of the triangle that it names");
}

/// Triangles joined by uncut sections, by common nodes and by common render vertices: the same components.
void check_components(const HybridMesh& mesh, const Flood& flood, Report& report) {
  constexpr const char* rule = "components_agree";
  const std::size_t count = mesh.buffers.triangles.size();
  std::vector<std::uint32_t> triangle_of(flood.first_fragment.back(), nothing);
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t)
    for (std::size_t f = 0; f < mesh.fragment_count(AncestorId{t}); ++f) {
      const TriangleId id = mesh.fragment(AncestorId{t}, f);
      if (id.index() < count) triangle_of[flood.first_fragment[t] + f] = id.value;
    }

  UnionFind by_section(count);
  for (const Section& s : flood.joined) {
    const std::uint32_t a = triangle_of[s.sides[0].fragment];
    const std::uint32_t b = triangle_of[s.sides[1].fragment];
    if (a != nothing && b != nothing) by_section.join(a, b);
  }
  UnionFind by_node(count);
  std::vector<std::uint32_t> first_at(mesh.buffers.nodes.size(), nothing);
  for (std::uint32_t t = 0; t < count; ++t)
    for (const NodeId n : mesh.buffers.triangles[t].nodes) {
      if (!mesh.buffers.triangles[t].ancestor.valid()) continue;
      if (first_at[n.index()] == nothing) first_at[n.index()] = t;
      by_node.join(first_at[n.index()], t);
    }
  UnionFind by_vertex(count);
  first_at.assign(mesh.buffers.render_vertices.size(), nothing);
  for (const RenderTriangle& triangle : mesh.buffers.render_triangles)
    for (const RenderVertexId v : triangle.vertices) {
      if (!triangle.triangle.valid()) continue;
      if (first_at[v.index()] == nothing) first_at[v.index()] = triangle.triangle.value;
      by_vertex.join(first_at[v.index()], triangle.triangle.value);
    }

  OneToOne nodes(count, count);
  OneToOne vertices(count, count);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (!mesh.buffers.triangles[t].ancestor.valid()) continue;
    if (!nodes.add(by_section.find(t), by_node.find(t)))
      report.add(rule, name("triangle", t) + " hangs on another piece by its nodes than by its edges");
    if (!vertices.add(by_section.find(t), by_vertex.find(t)))
      report.add(rule,
                 name("triangle", t) + " hangs on another piece by its render vertices than by its edges");
  }
}

}  // namespace

void check_connectivity(const HybridMesh& mesh, Report& report) {
  const Flood flood(mesh);
  check_physics_nodes(mesh, flood, report);
  check_render_vertices(mesh, flood, report);
  check_components(mesh, flood, report);
}

}  // namespace cut::validation

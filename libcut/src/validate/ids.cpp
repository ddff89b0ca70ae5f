/// @file
/// Rule ids_in_range: what all other rules stand on. In: the mesh as it is, however broken. Out: every array
/// whose size does not fit and every index that points nowhere.
#include "validate/rules.hpp"

namespace cut::validation {
namespace {

constexpr const char* rule = "ids_in_range";

class Checker {
 public:
  Checker(const HybridMesh& mesh, Report& report) : mesh_(mesh), report_(report) {}

  void ancestors() {
    const AncestorMesh& a = mesh_.ancestors;
    size("input_node", a.input_node.size(), nodes());
    size("input_corner", a.input_corner.size(), triangles());
    size("node_stamps", mesh_.node_stamps.size(), nodes());
    size("arrangement_of", mesh_.arrangement_of.size(), triangles());
    size("edge_state_of", mesh_.edge_state_of.size(), edges());
    for (std::size_t t = 0; t < triangles(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        index("node of ancestor", t, a.triangles[t].nodes[i].index(), nodes());
        index("edge of ancestor", t, a.triangles[t].edges[i].index(), edges());
      }
    for (std::size_t e = 0; e < edges(); ++e) {
      for (const AncestorNodeId n : a.edges[e].nodes) index("node of ancestor edge", e, n.index(), nodes());
      index("triangle of ancestor edge", e, a.edges[e].triangles[0].index(), triangles());
      if (a.edges[e].triangles[1].valid())
        index("triangle of ancestor edge", e, a.edges[e].triangles[1].index(), triangles());
    }
    for (std::size_t t = 0; t < a.input_corner.size(); ++t) index("input_corner", t, a.input_corner[t], 3);
    incidences();
  }

  void tables() {
    for (std::size_t t = 0; t < mesh_.arrangement_of.size(); ++t)
      if (mesh_.arrangement_of[t] != HybridMesh::none)
        index("arrangement_of", t, mesh_.arrangement_of[t], mesh_.arrangements.size());
    for (std::size_t e = 0; e < mesh_.edge_state_of.size(); ++e)
      if (mesh_.edge_state_of[e] != HybridMesh::none)
        index("edge_state_of", e, mesh_.edge_state_of[e], mesh_.edge_states.size());
    for (std::size_t s = 0; s < mesh_.edge_states.size(); ++s) {
      const EdgeState& state = mesh_.edge_states[s];
      size(name("cut of edge state", s), state.cut.size(), state.nodes.size() + 1);
      for (const SpringId spring : state.springs)
        index("spring of edge state", s, spring.index(), mesh_.buffers.springs.size());
    }
  }

  void buffers() {
    const Buffers& b = mesh_.buffers;
    size("positions", mesh_.positions.size(), b.nodes.size());
    for (std::size_t n = 0; n < b.nodes.size(); ++n)
      index("ancestor of node", n, b.nodes[n].index(), nodes());
    for (std::size_t t = 0; t < b.triangles.size(); ++t) {
      if (!b.triangles[t].ancestor.valid()) continue;
      index("ancestor of triangle", t, b.triangles[t].ancestor.index(), triangles());
      for (const NodeId n : b.triangles[t].nodes) index("node of triangle", t, n.index(), b.nodes.size());
    }
    for (std::size_t s = 0; s < b.springs.size(); ++s) {
      const Spring& spring = b.springs[s];
      if (!spring.nodes[0].valid() && !spring.nodes[1].valid()) continue;
      index("edge of spring", s, spring.edge.index(), edges());
      for (const NodeId n : spring.nodes) index("node of spring", s, n.index(), b.nodes.size());
    }
    for (std::size_t v = 0; v < b.render_vertices.size(); ++v) {
      const RenderVertex& vertex = b.render_vertices[v];
      if (!vertex.triangle.valid()) continue;
      index("triangle of render vertex", v, vertex.triangle.index(), b.triangles.size());
      for (const NodeId n : vertex.nodes) index("node of render vertex", v, n.index(), b.nodes.size());
    }
    for (std::size_t t = 0; t < b.render_triangles.size(); ++t) {
      const RenderTriangle& triangle = b.render_triangles[t];
      if (!triangle.triangle.valid()) continue;
      index("triangle of render triangle", t, triangle.triangle.index(), b.triangles.size());
      for (const RenderVertexId v : triangle.vertices)
        index("vertex of render triangle", t, v.index(), b.render_vertices.size());
    }
    for (std::size_t i = 0; i < mesh_.free_render_vertices.size(); ++i)
      index("free_render_vertices", i, mesh_.free_render_vertices[i].index(), b.render_vertices.size());
    for (std::size_t i = 0; i < mesh_.free_render_triangles.size(); ++i)
      index("free_render_triangles", i, mesh_.free_render_triangles[i].index(), b.render_triangles.size());
  }

  void arrangement(std::size_t i) {
    const Arrangement& a = mesh_.arrangements[i];
    std::size_t known_nodes = 3;
    for (std::size_t e = 0; e < 3; ++e) {
      known_nodes += a.boundary_counts[e];
      size(name("section_polygons of arrangement", i), a.section_polygons[e].size(),
           std::size_t{a.boundary_counts[e]} + 1);
      for (const std::uint32_t p : a.section_polygons[e])
        index("section of arrangement", i, p, a.polygons.size());
    }
    if (known_nodes > a.nodes.size()) report_.add(rule, name("arrangement", i) + " lacks boundary nodes");
    for (const CutEdge& e : a.edges) {
      for (const std::uint32_t n : {e.from, e.to}) index("edge of arrangement", i, n, a.nodes.size());
      for (const std::uint32_t p : {e.left, e.right}) index("side of arrangement", i, p, a.polygons.size());
    }
    for (const RenderPolygon& polygon : a.polygons) {
      index("polygon of arrangement", i, polygon.triangle.index(), mesh_.buffers.triangles.size());
      for (const PolygonCorner& c : polygon.corners) {
        index("polygon node of arrangement", i, c.node, a.nodes.size());
        index("polygon vertex of arrangement", i, c.vertex.index(), mesh_.buffers.render_vertices.size());
      }
      for (const RenderTriangleId t : polygon.triangles)
        index("render triangle of arrangement", i, t.index(), mesh_.buffers.render_triangles.size());
      std::uint32_t begin = 0;
      for (const std::uint32_t end : polygon.loop_ends) {
        if (end <= begin)
          report_.add(rule, "loops of arrangement " + std::to_string(i) + " do not follow each other");
        begin = end;
      }
      size(name("loops of a polygon of arrangement", i), begin, polygon.corners.size());
    }
  }

 private:
  [[nodiscard]] std::size_t nodes() const { return mesh_.ancestors.rest_positions.size(); }
  [[nodiscard]] std::size_t triangles() const { return mesh_.ancestors.triangles.size(); }
  [[nodiscard]] std::size_t edges() const { return mesh_.ancestors.edges.size(); }

  void incidences() {
    const AncestorMesh& a = mesh_.ancestors;
    size("first_incidence", a.first_incidence.size(), nodes() + 1);
    for (std::size_t i = 0; i < a.incidences.size(); ++i)
      index("incidence", i, a.incidences[i].index(), triangles());
    if (a.first_incidence.empty()) return;
    if (a.first_incidence.front() != 0) report_.add(rule, "first_incidence does not begin with 0");
    for (std::size_t n = 0; n + 1 < a.first_incidence.size(); ++n)
      if (a.first_incidence[n] > a.first_incidence[n + 1])
        report_.add(rule, name("first_incidence", n) + " is larger than the next one");
    size("incidences", a.incidences.size(), a.first_incidence.back());
  }

  void size(const std::string& what, std::size_t is, std::size_t expected) {
    if (is == expected) return;
    report_.add(rule, what + ": " + std::to_string(is) + " entries instead of " + std::to_string(expected));
  }
  void index(const char* what, std::size_t of, std::size_t is, std::size_t end) {
    if (is < end) return;
    report_.add(rule, name(what, of) + ": index " + std::to_string(is) + " of " + std::to_string(end));
  }

  const HybridMesh& mesh_;
  Report& report_;
};

}  // namespace

void check_ids(const HybridMesh& mesh, Report& report) {
  Checker checker(mesh, report);
  checker.ancestors();
  checker.tables();
  checker.buffers();
  for (std::size_t i = 0; i < mesh.arrangements.size() && !report.full(); ++i) checker.arrangement(i);
}

}  // namespace cut::validation

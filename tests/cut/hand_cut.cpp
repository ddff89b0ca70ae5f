// Everything that follows from polygons and cut sections, by repeating until nothing changes.
#include "cut/hand_cut.hpp"

#include <algorithm>
#include <map>
#include <scenes/cloths.hpp>
#include <scenes/surfaces.hpp>
#include <set>

using namespace cut;

namespace hand {
namespace {

std::uint32_t u32(std::size_t i) { return static_cast<std::uint32_t>(i); }

AncestorEdgeId find_edge(const AncestorMesh& a, std::array<std::uint32_t, 2> ends) {
  for (std::size_t e = 0; e < a.edges.size(); ++e)
    if (a.edges[e].nodes[0].value == ends[0] && a.edges[e].nodes[1].value == ends[1])
      return AncestorEdgeId{e};
  return {};
}

/// The polygon that has the side from → to, or `otherwise`.
std::uint32_t polygon_at(const Triangle& t, std::uint32_t from, std::uint32_t to, std::uint32_t otherwise) {
  for (std::size_t p = 0; p < t.polygons.size(); ++p)
    for (const auto& loop : t.polygons[p].loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop[i] == from && loop[(i + 1) % loop.size()] == to) return u32(p);
  return otherwise;
}

void add_arrangement(HybridMesh& mesh, const Triangle& t) {
  Arrangement a;
  for (std::size_t i = 0; i < 3; ++i) a.nodes.push_back({lattice_corner(i)});
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeState* state = mesh.edge_state(mesh.ancestors.triangles[t.ancestor].edges[i]);
    if (!state) continue;
    std::vector<std::int32_t> along;
    for (const BoundaryNode& n : state->nodes) along.push_back(n.t);
    if (mesh.ancestors.reversed(AncestorId{t.ancestor}, i)) {
      std::reverse(along.begin(), along.end());
      for (std::int32_t& s : along) s = lattice_size - s;
    }
    for (const std::int32_t s : along) a.nodes.push_back({lattice_point_on_edge(i, s)});
    a.boundary_counts[i] = u32(along.size());
  }
  for (const LatticePoint p : t.inner) a.nodes.push_back({p});
  for (const auto& [from, to] : t.cuts)
    a.edges.push_back({from, to, polygon_at(t, from, to, t.slits_in), polygon_at(t, to, from, t.slits_in)});
  for (std::size_t i = 0; i < 3; ++i)
    for (std::uint32_t k = 0; k <= a.boundary_counts[i]; ++k)
      a.section_polygons[i].push_back(polygon_at(t, a.edge_node(i, k), a.edge_node(i, k + 1), t.slits_in));
  for (std::size_t p = 0; p < t.polygons.size(); ++p) {
    RenderPolygon polygon;
    polygon.triangle = TriangleId{p == 0 ? t.ancestor : mesh.buffers.triangles.size()};
    if (p > 0) mesh.buffers.triangles.push_back(mesh.buffers.triangles[t.ancestor]);
    for (const auto& loop : t.polygons[p].loops) {
      for (const std::uint32_t n : loop) polygon.corners.push_back({n, {}});
      polygon.loop_ends.push_back(u32(polygon.corners.size()));
    }
    for (const auto& corners : t.polygons[p].triangles) {
      auto& all = mesh.buffers.render_triangles;
      RenderTriangle* slot = nullptr;  // the triangle of the uncut ancestor is used again
      if (polygon.triangle.index() == t.ancestor && polygon.triangles.empty()) slot = &all[t.ancestor];
      if (!slot) slot = &all.emplace_back();
      polygon.triangles.emplace_back(static_cast<std::size_t>(slot - all.data()));
      slot->triangle = polygon.triangle;
      for (std::size_t i = 0; i < 3; ++i)
        slot->vertices[i] = RenderVertexId{corners[i]};  // see name_vertices
    }
    a.polygons.push_back(std::move(polygon));
  }
  mesh.arrangement_of[t.ancestor] = u32(mesh.arrangements.size());
  mesh.arrangements.push_back(std::move(a));
}

/// A fragment's angle at a node; an uncut triangle has three.
struct Wedge {
  std::uint32_t ancestor;
  std::uint32_t polygon;
  std::uint32_t node;    // of the arrangement
  std::uint32_t before;  // node before it in the loop
  std::uint32_t after;
  std::uint32_t label;
};

std::vector<Wedge> all_wedges(const HybridMesh& mesh) {
  std::vector<Wedge> wedges;
  for (std::uint32_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const Arrangement* a = mesh.arrangement(AncestorId{t});
    for (std::uint32_t i = 0; !a && i < 3; ++i)
      wedges.push_back({t, 0, i, u32(last_corner(i)), u32(next_corner(i)), u32(wedges.size())});
    for (std::uint32_t p = 0; a && p < a->polygons.size(); ++p) {
      const auto& corners = a->polygons[p].corners;
      std::uint32_t begin = 0;
      for (const std::uint32_t end : a->polygons[p].loop_ends) {
        for (std::uint32_t i = begin; i < end; ++i)
          wedges.push_back({t, p, corners[i].node, corners[i == begin ? end - 1 : i - 1].node,
                            corners[i + 1 < end ? i + 1 : begin].node, u32(wedges.size())});
        begin = end;
      }
    }
  }
  return wedges;
}

/// One side of section k of an ancestor edge: the nodes at the section's start and end, and the fragment.
struct Side {
  std::uint32_t ancestor;
  std::uint32_t polygon;
  std::array<std::uint32_t, 2> nodes;
  std::array<std::uint32_t, 2> corners;
};

Side side_of(const HybridMesh& mesh, AncestorId t, AncestorEdgeId e, std::uint32_t k) {
  const Arrangement* a = mesh.arrangement(t);
  const std::size_t i = mesh.ancestors.local_edge(t, e);
  const bool reversed = mesh.ancestors.reversed(t, i);
  const std::uint32_t count = a ? a->boundary_counts[i] + 1 : 1;
  const std::uint32_t own = reversed ? count - 1 - k : k;
  Side side{t.value, a ? a->section_polygons[i][own] : 0, {}, {u32(i), u32(next_corner(i))}};
  side.nodes = {a ? a->edge_node(i, own) : u32(i), a ? a->edge_node(i, own + 1) : u32(next_corner(i))};
  if (reversed) {
    std::swap(side.nodes[0], side.nodes[1]);
    std::swap(side.corners[0], side.corners[1]);
  }
  return side;
}

std::vector<std::array<Side, 2>> joined_sections(const HybridMesh& mesh) {
  std::vector<std::array<Side, 2>> result;
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) {
    const AncestorEdgeId id{e};
    const auto& triangles = mesh.ancestors.edges[e].triangles;
    const std::vector<std::uint8_t> cut =
        mesh.edge_state(id) ? mesh.edge_state(id)->cut : std::vector<std::uint8_t>{0};
    for (std::uint32_t k = 0; triangles[1].valid() && k < cut.size(); ++k)
      if (cut[k] == 0)
        result.push_back({side_of(mesh, triangles[0], id, k), side_of(mesh, triangles[1], id, k)});
  }
  return result;
}

bool touches(const Wedge& w, const Side& s, std::size_t end) {
  const std::uint32_t other = s.nodes[1 - end];
  return w.ancestor == s.ancestor && w.polygon == s.polygon && w.node == s.nodes[end] &&
         (w.before == other || w.after == other);
}

/// Fills the vertices in, in the order of the wedges, and one free entry.
void name_vertices(HybridMesh& mesh) {
  std::vector<Wedge> wedges = all_wedges(mesh);
  const auto sections = joined_sections(mesh);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& section : sections)
      for (std::size_t end = 0; end < 2; ++end)
        for (Wedge& a : wedges)
          for (Wedge& b : wedges)
            if (a.label != b.label && touches(a, section[0], end) && touches(b, section[1], end)) {
              a.label = b.label = std::min(a.label, b.label);
              changed = true;
            }
  }
  mesh.buffers.render_vertices.assign(1, RenderVertex{});
  mesh.free_render_vertices = {RenderVertexId{0}};
  std::map<std::uint32_t, RenderVertexId> vertex_of;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<RenderVertexId>> corners;  // per fragment
  for (const Wedge& w : wedges) {
    const AncestorId t{w.ancestor};
    const Arrangement* a = mesh.arrangement(t);
    if (!vertex_of.count(w.label)) {
      vertex_of[w.label] = RenderVertexId{mesh.buffers.render_vertices.size()};
      const TriangleId physics = mesh.fragment(t, w.polygon);
      mesh.buffers.render_vertices.push_back({physics, mesh.buffers.triangles[physics.index()].nodes,
                                              a ? a->nodes[w.node].point : lattice_corner(w.node)});
    }
    corners[{w.ancestor, w.polygon}].push_back(vertex_of[w.label]);
  }
  for (std::uint32_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    if (mesh.arrangement_of[t] == HybridMesh::none) {
      for (std::size_t i = 0; i < 3; ++i) mesh.buffers.render_triangles[t].vertices[i] = corners[{t, 0}][i];
      continue;
    }
    auto& polygons = mesh.arrangements[mesh.arrangement_of[t]].polygons;
    for (std::uint32_t p = 0; p < polygons.size(); ++p) {
      for (std::size_t i = 0; i < polygons[p].corners.size(); ++i)
        polygons[p].corners[i].vertex = corners[{t, p}][i];
      for (const RenderTriangleId id : polygons[p].triangles)
        for (RenderVertexId& v : mesh.buffers.render_triangles[id.index()].vertices)
          v = corners[{t, p}][v.index()];
    }
  }
}

/// The copies of the physics nodes.
void name_nodes(HybridMesh& mesh) {
  using Corner = std::array<std::uint32_t, 3>;  // ancestor, polygon, corner
  std::map<Corner, std::uint32_t> label;
  for (std::uint32_t t = 0; t < mesh.ancestors.triangles.size(); ++t)
    for (std::uint32_t f = 0; f < mesh.fragment_count(AncestorId{t}); ++f)
      for (std::uint32_t i = 0; i < 3; ++i) label.emplace(Corner{t, f, i}, u32(label.size()));
  const auto sections = joined_sections(mesh);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : sections)
      for (std::size_t end = 0; end < 2; ++end) {
        std::uint32_t& left = label[{a.ancestor, a.polygon, a.corners[end]}];
        std::uint32_t& right = label[{b.ancestor, b.polygon, b.corners[end]}];
        changed = changed || left != right;
        left = right = std::min(left, right);
      }
  }
  std::map<std::uint32_t, NodeId> node_of;
  std::set<std::uint32_t> taken;
  for (const auto& [corner, set] : label) {
    const std::uint32_t original = mesh.ancestors.triangles[corner[0]].nodes[corner[2]].value;
    if (!node_of.count(set)) {
      node_of[set] = taken.insert(original).second ? NodeId{original} : NodeId{mesh.buffers.nodes.size()};
      if (node_of[set].value != original) {
        mesh.buffers.nodes.emplace_back(original);
        mesh.positions.push_back(mesh.ancestors.rest_positions[original]);
      }
    }
    const TriangleId t = mesh.fragment(AncestorId{corner[0]}, corner[1]);
    mesh.buffers.triangles[t.index()].nodes[corner[2]] = node_of[set];
  }
}

EdgeState& state_of(HybridMesh& mesh, std::size_t e) {
  if (mesh.edge_state_of[e] == HybridMesh::none) {
    mesh.edge_state_of[e] = u32(mesh.edge_states.size());
    mesh.edge_states.emplace_back();
  }
  return mesh.edge_states[mesh.edge_state_of[e]];
}

void add_springs(HybridMesh& mesh) {
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) {
    std::vector<std::array<NodeId, 2>> pairs;
    for (const PhysicsTriangle& t : mesh.buffers.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        if (mesh.ancestors.triangles[t.ancestor.index()].edges[i].index() != e) continue;
        std::array<NodeId, 2> pair{t.nodes[i], t.nodes[next_corner(i)]};
        if (mesh.ancestors.reversed(t.ancestor, i)) std::swap(pair[0], pair[1]);
        if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
      }
    mesh.buffers.springs[e].nodes = pairs[0];
    if (pairs.size() > 1) state_of(mesh, e);
    for (std::size_t k = 1; k < pairs.size(); ++k) {
      state_of(mesh, e).springs.emplace_back(mesh.buffers.springs.size());
      mesh.buffers.springs.push_back({pairs[k], AncestorEdgeId{e}});
    }
    if (mesh.edge_state_of[e] != HybridMesh::none) state_of(mesh, e).springs.emplace_back(e);
  }
}

}  // namespace

HybridMesh cut_by_hand(const TriangleMesh& cloth, const std::vector<Edge>& edges,
                       const std::vector<Triangle>& triangles) {
  HybridMesh mesh = *HybridMesh::build(cloth);
  mesh.cut_count = 1;
  for (const Edge& edge : edges) {
    EdgeState& state = state_of(mesh, find_edge(mesh.ancestors, edge.ends).index());
    for (const std::int32_t t : edge.nodes) state.nodes.push_back({t, 1});
    state.cut = edge.cut;
  }
  for (const Triangle& t : triangles) add_arrangement(mesh, t);
  mesh.free_render_triangles = {RenderTriangleId{mesh.buffers.render_triangles.size()}};
  mesh.buffers.render_triangles.emplace_back();
  name_nodes(mesh);
  name_vertices(mesh);
  add_springs(mesh);
  return mesh;
}

constexpr std::int32_t eighth = lattice_size / 8;

HybridMesh square_cut_in_two() {
  // Nodes 0 1 below, 2 3 above; triangles 0 1 3 and 0 3 2.
  return cut_by_hand(
      scenes::grid(1, 1),
      {{{0, 1}, {2 * eighth}, {0, 0}}, {{0, 3}, {3 * eighth}, {0, 0}}, {{2, 3}, {4 * eighth}, {0, 0}}},
      {{0, {}, {{3, 4}}, {{{{0, 3, 4}}, {{0, 1, 2}}}, {{{3, 1, 2, 4}}, {{0, 1, 2}, {0, 2, 3}}}}},
       {1, {}, {{3, 4}}, {{{{0, 3, 4, 2}}, {{0, 1, 2}, {0, 2, 3}}}, {{{3, 1, 4}}, {{0, 1, 2}}}}}});
}

HybridMesh moebius_with_cut() {
  const TriangleMesh cloth = scenes::moebius_strip(8, 1);
  const HybridMesh uncut = *HybridMesh::build(cloth);
  // A triangle with one border edge; cut between the two others.
  std::uint32_t t = 0;
  std::size_t border = 0;
  for (std::uint32_t i = 0; i < uncut.ancestors.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!uncut.ancestors.neighbour(AncestorId{i}, k).valid()) {
        t = i;
        border = k;
      }
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  // Boundary nodes 3 and 4 lie on the two edges that are not on the border, so one corner is cut off.
  const std::array<std::size_t, 2> crossed{std::min(next_corner(border), last_corner(border)),
                                           std::max(next_corner(border), last_corner(border))};
  for (const std::size_t i : crossed) {
    const auto& ends = uncut.ancestors.edges[uncut.ancestors.triangles[t].edges[i].index()].nodes;
    edges.push_back({{ends[0].value, ends[1].value}, {3 * eighth}, {0, 0}});
  }
  const auto c = static_cast<std::uint32_t>(last_corner(border));  // the corner between the crossed edges
  const auto a = static_cast<std::uint32_t>(next_corner(c));
  const auto b = static_cast<std::uint32_t>(last_corner(c));
  const std::uint32_t leaving = crossed[0] == c ? 3 : 4;  // the node on the edge that starts at c
  const std::uint32_t arriving = 7 - leaving;
  triangles.push_back(
      {t,
       {},
       {{3, 4}},
       {{{{c, leaving, arriving}}, {{0, 1, 2}}}, {{{leaving, a, b, arriving}}, {{0, 1, 2}, {0, 2, 3}}}}});
  // Its neighbours get the node on their side and are cut no further.
  for (const std::size_t i : crossed) {
    const AncestorId n = uncut.ancestors.neighbour(AncestorId{t}, i);
    const std::size_t k = uncut.ancestors.local_edge(n, uncut.ancestors.triangles[t].edges[i]);
    const auto from = static_cast<std::uint32_t>(k);
    const auto to = static_cast<std::uint32_t>(next_corner(k));
    const auto top = static_cast<std::uint32_t>(last_corner(k));
    triangles.push_back({n.value, {}, {}, {{{{from, 3, to, top}}, {{0, 1, 3}, {1, 2, 3}}}}});
  }
  return cut_by_hand(cloth, edges, triangles);
}

HybridMesh hexagon_with_cuts() {
  const TriangleMesh cloth = scenes::hexagon(1);
  const HybridMesh uncut = *HybridMesh::build(cloth);
  const AncestorMesh& a = uncut.ancestors;
  std::uint32_t centre = 0;
  while (a.triangles_around(AncestorNodeId{centre}).size() != 6) ++centre;
  const auto inside = [](std::int32_t x, std::int32_t y) { return LatticePoint{x * eighth, y * eighth}; };

  // Triangle 0: island 3 4 5, slit 6-7, and an edge 3-8 that hangs on the island.
  const Triangle island{
      0,
      {inside(2, 2), inside(4, 2), inside(2, 4), inside(1, 1), inside(3, 1), inside(1, 3)},
      {{3, 4}, {3, 5}, {3, 8}, {4, 5}, {6, 7}},
      {{{{0, 1, 2}, {3, 5, 4}}, {{0, 1, 5}, {0, 5, 3}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}, {2, 0, 3}}},
       {{{3, 4, 5}}, {{0, 1, 2}}}}};

  // The first triangle from 2 on that is no neighbour of 0: a drop from the centre.
  const auto far = [&](std::uint32_t t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (a.neighbour(AncestorId{t}, i).value == 0) return false;
    return t != 0;
  };
  std::uint32_t drop = 1;
  while (!far(drop)) ++drop;
  const auto c = static_cast<std::uint32_t>(a.local_node(AncestorId{drop}, AncestorNodeId{centre}));
  const auto right = static_cast<std::uint32_t>(next_corner(c));
  const auto left = static_cast<std::uint32_t>(last_corner(c));
  const auto at = [&](std::int32_t to_right, std::int32_t to_left) {
    std::array<std::int32_t, 3> b{};
    b[c] = 8 - to_right - to_left;
    b[right] = to_right;
    b[left] = to_left;
    return inside(b[1], b[2]);
  };
  const Triangle pinch{drop,
                       {at(3, 1), at(1, 3)},
                       {{c, 3}, {c, 4}, {3, 4}},
                       {{{{c, right, left, c, 4, 3}}, {{0, 1, 5}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}}},
                        {{{c, 3, 4}}, {{0, 1, 2}}}}};

  // An edge from the centre that neither of them has: cut from its outer end to the middle.
  std::size_t e = 0;
  const auto fits = [&](const AncestorEdge& edge) {
    if (!edge.triangles[1].valid()) return false;
    for (const AncestorId t : edge.triangles)
      if (t.value == 0 || t.value == drop) return false;
    return true;
  };
  while (!fits(a.edges[e])) ++e;
  const bool outwards = a.edges[e].nodes[0].value == centre;
  std::vector<Triangle> triangles{island, pinch};
  for (const AncestorId t : a.edges[e].triangles) {
    const auto from = static_cast<std::uint32_t>(a.local_edge(t, AncestorEdgeId{e}));
    const auto to = static_cast<std::uint32_t>(next_corner(from));
    const auto top = static_cast<std::uint32_t>(last_corner(from));
    triangles.push_back({t.value, {}, {}, {{{{from, 3, to, top}}, {{0, 1, 3}, {1, 2, 3}}}}});
  }
  const Edge half{{a.edges[e].nodes[0].value, a.edges[e].nodes[1].value},
                  {4 * eighth},
                  outwards ? std::vector<std::uint8_t>{0, 1} : std::vector<std::uint8_t>{1, 0}};
  return cut_by_hand(cloth, {half}, triangles);
}

}  // namespace hand

// Sound meshes pass; every rule finds the fault that it is there for; no broken state makes `validate` crash.
#include "cut/validate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <scenes/cloths.hpp>
#include <scenes/random.hpp>
#include <scenes/surfaces.hpp>

#include "cut/hand_cut.hpp"
#include "cut/pieces.hpp"

using namespace cut;

namespace {

std::string list(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& v : violations) text += v.rule + ": " + v.message + "\n";
  return text;
}

void check_sound(const HybridMesh& mesh) { CHECK(list(validate(mesh)) == ""); }

/// What one fault looks like: `change` brings it into a sound mesh.
void check_found(const char* rule, HybridMesh mesh, const std::function<void(HybridMesh&)>& change) {
  check_sound(mesh);
  change(mesh);
  const std::vector<Violation> found = validate(mesh);
  INFO("expected ", rule, ", found:\n", list(found));
  CHECK(std::any_of(found.begin(), found.end(), [&](const Violation& v) { return v.rule == rule; }));
}

HybridMesh square() { return hand::square_cut_in_two(); }
HybridMesh hexagon() { return hand::hexagon_with_cuts(); }

std::uint32_t random_index(scenes::Random& random) {
  switch (random.below(4)) {
    case 0:
      return 0xffffffffu;
    case 1:
      return static_cast<std::uint32_t>(random.bits());
    default:
      return static_cast<std::uint32_t>(random.below(12));
  }
}

}  // namespace

TEST_CASE("uncut meshes are sound") {
  check_sound(*HybridMesh::build(scenes::twelve_triangles()));
  check_sound(*HybridMesh::build(scenes::grid(7, 5, 1, scenes::Diagonals::alternating)));
  check_sound(*HybridMesh::build(scenes::random_sheet(9, 9, 1, 3)));
  check_sound(*HybridMesh::build(scenes::sphere(2)));
  check_sound(*HybridMesh::build(scenes::torus(7, 5)));
  check_sound(*HybridMesh::build(scenes::moebius_strip(9, 2)));
}

TEST_CASE("meshes cut by hand are sound") {
  check_sound(hand::square_cut_in_two());
  check_sound(hand::hexagon_with_cuts());
  check_sound(hand::moebius_with_cut());
}

TEST_CASE("pieces") {
  const Pieces uncut = pieces(*HybridMesh::build(scenes::torus(8, 6)));
  REQUIRE(uncut.list.size() == 1);
  CHECK(uncut.list[0].euler_characteristic == 0);
  CHECK(uncut.list[0].boundary_loops == 0);
  CHECK(uncut.list[0].triangles == 96);

  const Pieces halves = pieces(hand::square_cut_in_two());
  REQUIRE(halves.list.size() == 2);
  CHECK(halves.list[0].rest_area == doctest::Approx(1 - (15 + 35) / 128.0));  // two trapezia are missing
  CHECK(halves.list[0].rest_area + halves.list[1].rest_area == doctest::Approx(1));
  for (const Piece& p : halves.list) {
    CHECK(p.euler_characteristic == 1);
    CHECK(p.boundary_loops == 1);
    CHECK(p.triangles == 3);
  }

  // The rest, with two holes, one of which touches a slit that does not open; the island; the drop.
  const HybridMesh hexagon_mesh = hand::hexagon_with_cuts();
  const Pieces parts = pieces(hexagon_mesh);
  REQUIRE(parts.list.size() == 3);
  CHECK(parts.list[0].boundary_loops == 3);
  CHECK(parts.list[0].euler_characteristic == -1);
  CHECK(parts.list[1].triangles == 1);
  CHECK(parts.list[2].triangles == 1);
  CHECK(parts.of_vertex[0] == Pieces::none);  // free
  CHECK(parts.of_triangle.back() == Pieces::none);
  HybridMesh stretched = hexagon_mesh;
  for (Eigen::Vector3d& p : stretched.positions) p.x() *= 2;
  CHECK(pieces(stretched).list[1].area == doctest::Approx(2 * parts.list[1].area));
  CHECK(pieces(stretched).list[1].rest_area == parts.list[1].rest_area);

  const Pieces strip = pieces(hand::moebius_with_cut());
  REQUIRE(strip.list.size() == 1);
  CHECK(strip.list[0].boundary_loops == 1);
}

TEST_CASE("ids_in_range") {
  constexpr const char* rule = "ids_in_range";
  check_found(rule, square(), [](HybridMesh& m) { m.positions.pop_back(); });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangement_of[0] = 99; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].edges[0].left = 2; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].boundary_counts[1] = 0xffffffffu; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].polygons[0].loop_ends.clear(); });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].polygons[0].corners[0].vertex = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[0].cut.push_back(0); });
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[0].springs.push_back({}); });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.springs[0].nodes[1] = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.nodes[0] = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.triangles[1].nodes[2] = NodeId{1000}; });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.render_vertices[1].triangle = TriangleId{50}; });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.render_triangles[0].vertices[0] = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.free_render_vertices[0] = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.ancestors.first_incidence[1] = 100; });
}

TEST_CASE("ancestors_consistent") {
  constexpr const char* rule = "ancestors_consistent";
  check_found(rule, square(),
              [](HybridMesh& m) { std::swap(m.ancestors.edges[0].nodes[0], m.ancestors.edges[0].nodes[1]); });
  check_found(rule, square(),
              [](HybridMesh& m) { m.ancestors.edges[0].triangles[1] = m.ancestors.edges[0].triangles[0]; });
  check_found(rule, square(), [](HybridMesh& m) {
    std::swap(m.ancestors.triangles[0].edges[0], m.ancestors.triangles[0].edges[1]);
  });
  check_found(rule, square(), [](HybridMesh& m) {
    auto& t = m.ancestors.triangles[0];
    std::rotate(t.nodes.begin(), t.nodes.begin() + 1, t.nodes.end());
    std::rotate(t.edges.begin(), t.edges.begin() + 1, t.edges.end());
  });
  check_found(rule, square(), [](HybridMesh& m) { m.ancestors.incidences[1] = m.ancestors.incidences[0]; });
  check_found(rule, square(), [](HybridMesh& m) {
    m.ancestors.rest_positions[3].z() = std::numeric_limits<double>::quiet_NaN();
  });
  check_found(rule, square(),
              [](HybridMesh& m) { m.ancestors.rest_positions[3] = m.ancestors.rest_positions[2]; });
}

TEST_CASE("one_owner_each") {
  constexpr const char* rule = "one_owner_each";
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements.push_back(m.arrangements[0]); });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangement_of[1] = m.arrangement_of[0]; });
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states.emplace_back(); });
}

TEST_CASE("fragments_match") {
  constexpr const char* rule = "fragments_match";
  check_found(rule, square(), [](HybridMesh& m) {
    m.arrangements[0].polygons[0].triangle = m.arrangements[0].polygons[1].triangle;
  });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.triangles[1].ancestor = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.triangles.push_back(m.buffers.triangles[0]); });
  check_found(rule, square(), [](HybridMesh& m) {
    std::swap(m.buffers.triangles[0].nodes[0], m.buffers.triangles[0].nodes[1]);
  });
}

TEST_CASE("free_lists_consistent") {
  constexpr const char* rule = "free_lists_consistent";
  check_found(rule, square(), [](HybridMesh& m) { m.free_render_vertices.clear(); });
  check_found(rule, square(), [](HybridMesh& m) { m.free_render_triangles.clear(); });
  check_found(rule, square(),
              [](HybridMesh& m) { m.free_render_triangles.push_back(m.free_render_triangles[0]); });
  check_found(rule, square(), [](HybridMesh& m) { m.free_render_vertices.emplace_back(std::size_t{1}); });
}

TEST_CASE("stamps_in_range") {
  constexpr const char* rule = "stamps_in_range";
  check_found(rule, square(), [](HybridMesh& m) { m.node_stamps[2] = 2; });
  check_found(rule, square(), [](HybridMesh& m) { m.cut_count = 0; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[1].nodes[3].stamp = 2; });
}

TEST_CASE("vertices_in_triangles") {
  constexpr const char* rule = "vertices_in_triangles";
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.render_vertices[1].point = {-1, 1}; });
  check_found(rule, square(),
              [](HybridMesh& m) { m.buffers.render_vertices[1].point = {0x7fffffff, 0x7fffffff}; });
  check_found(rule, square(),
              [](HybridMesh& m) { m.buffers.render_vertices[1].nodes[2] = NodeId{std::size_t{0}}; });
  check_found(rule, square(), [](HybridMesh& m) {
    m.buffers.render_vertices[1].triangle = TriangleId{m.buffers.triangles.size()};
    m.buffers.triangles.emplace_back();  // a removed one
  });
}

TEST_CASE("boundary_nodes_agree") {
  constexpr const char* rule = "boundary_nodes_agree";
  check_found(rule, square(), [](HybridMesh& m) { ++m.edge_states[1].nodes[0].t; });
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[1].nodes[0].t = 0; });
  check_found(rule, square(), [](HybridMesh& m) { ++m.arrangements[0].nodes[4].point.y; });
  check_found(rule, square(), [](HybridMesh& m) {  // a T-junction: one side knows nothing of the node
    m.edge_states[1].nodes.push_back({lattice_size - 5, 1});
    m.edge_states[1].cut.push_back(0);
  });
  check_found(rule, *HybridMesh::build(scenes::grid(1, 1)), [](HybridMesh& m) {
    m.edge_states.push_back({{{5, 0}}, {0, 0}, {SpringId{std::size_t{0}}}});
    m.edge_state_of[0] = 0;
  });
}

TEST_CASE("nodes_in_place") {
  constexpr const char* rule = "nodes_in_place";
  check_found(rule, square(), [](HybridMesh& m) { ++m.arrangements[0].nodes[1].point.y; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].nodes[3].point.y = 1; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].nodes[3].point.x = 0x7fffffff; });
  check_found(rule, hexagon(), [](HybridMesh& m) { m.arrangements[0].nodes[6].point.y = 0; });
  check_found(rule, hexagon(), [](HybridMesh& m) { m.arrangements[0].nodes.push_back({{11, 12}}); });
  check_found(rule, hexagon(),
              [](HybridMesh& m) { std::swap(m.arrangements[0].edges[0], m.arrangements[0].edges[1]); });
  check_found(rule, hexagon(), [](HybridMesh& m) { m.arrangements[0].edges[4] = {7, 6, 0, 0}; });
}

TEST_CASE("arrangement_planar") {
  constexpr const char* rule = "arrangement_planar";
  constexpr std::int32_t eighth = lattice_size / 8;
  check_found(rule, hexagon(),
              [](HybridMesh& m) { m.arrangements[0].nodes[7].point = {3 * eighth, 3 * eighth - 1}; });
  check_found(rule, hexagon(),
              [](HybridMesh& m) { m.arrangements[0].nodes[7].point = {3 * eighth, 2 * eighth}; });
  check_found(rule, hexagon(),
              [](HybridMesh& m) { m.arrangements[0].nodes[7].point = {2 * eighth, 2 * eighth}; });
  check_found(rule, hexagon(), [](HybridMesh& m) { m.arrangements[0].edges[0] = {3, 3, 0, 0}; });
  check_found(rule, hexagon(),
              [](HybridMesh& m) { m.arrangements[0].edges[1] = m.arrangements[0].edges[0]; });
  // 3-8 laid over 3-5.
  check_found(rule, hexagon(),
              [](HybridMesh& m) { m.arrangements[0].nodes[8].point = {2 * eighth, 3 * eighth}; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].edges.push_back({3, 1, 1, 1}); });
}

TEST_CASE("edge_sides_agree") {
  constexpr const char* rule = "edge_sides_agree";
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[0].cut[0] = 2; });
  check_found(rule, square(), [](HybridMesh& m) {
    std::swap(m.arrangements[0].edges[0].left, m.arrangements[0].edges[0].right);
  });
  check_found(rule, square(),
              [](HybridMesh& m) { m.arrangements[0].edges[0].left = m.arrangements[0].edges[0].right; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].section_polygons[0][0] = 1; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].edges.clear(); });
  check_found(rule, hexagon(), [](HybridMesh& m) { m.arrangements[0].edges[2].left = 1; });
  check_found(rule, square(), [](HybridMesh& m) {
    auto& polygon = m.arrangements[0].polygons[1];
    polygon.corners.pop_back();
    polygon.loop_ends.back() = 3;
  });
}

TEST_CASE("polygon_simple") {
  constexpr const char* rule = "polygon_simple";
  check_found(rule, hexagon(), [](HybridMesh& m) {  // the hole first
    auto& polygon = m.arrangements[0].polygons[0];
    std::rotate(polygon.corners.begin(), polygon.corners.begin() + 3, polygon.corners.end());
  });
  check_found(rule, hexagon(), [](HybridMesh& m) {  // the pinch taken for two loops
    m.arrangements[1].polygons[0].loop_ends = {3, 6};
  });
}

TEST_CASE("polygons_partition_ancestor") {
  constexpr const char* rule = "polygons_partition_ancestor";
  check_found(rule, hexagon(), [](HybridMesh& m) {  // the hole is missing
    auto& polygon = m.arrangements[0].polygons[0];
    polygon.corners.resize(3);
    polygon.loop_ends = {3};
  });
  check_found(rule, hexagon(), [](HybridMesh& m) {  // a slit said to be in the island
    m.arrangements[0].edges[4].left = m.arrangements[0].edges[4].right = 1;
  });
  check_found(rule, square(), [](HybridMesh& m) {
    auto& a = m.arrangements[0];
    a.polygons.push_back(a.polygons[1]);
  });
  check_found(rule, square(), [](HybridMesh& m) {  // both halves said to be one polygon
    auto& a = m.arrangements[0];
    for (auto& sections : a.section_polygons)
      for (std::uint32_t& p : sections) p = 0;
    a.edges[0].left = a.edges[0].right = 0;
  });
}

TEST_CASE("render_triangles_cover_polygons") {
  constexpr const char* rule = "render_triangles_cover_polygons";
  const auto first = [](HybridMesh& m, std::size_t arrangement) -> RenderTriangle& {
    return m.buffers.render_triangles[m.arrangements[arrangement].polygons[0].triangles[0].index()];
  };
  check_found(rule, square(),
              [&](HybridMesh& m) { std::swap(first(m, 0).vertices[0], first(m, 0).vertices[1]); });
  check_found(rule, square(), [&](HybridMesh& m) { first(m, 0).vertices[0] = first(m, 0).vertices[1]; });
  check_found(rule, square(), [&](HybridMesh& m) { first(m, 0).triangle = {}; });
  check_found(rule, square(), [](HybridMesh& m) { m.arrangements[0].polygons[0].triangles.clear(); });
  check_found(rule, square(), [](HybridMesh& m) {  // both halves of a quad over the same three nodes
    const auto& ids = m.arrangements[0].polygons[1].triangles;
    m.buffers.render_triangles[ids[0].index()] = m.buffers.render_triangles[ids[1].index()];
  });
  check_found(rule, square(), [](HybridMesh& m) {  // the other diagonal in one of two triangles: an overlap
    const auto& polygon = m.arrangements[0].polygons[1];
    m.buffers.render_triangles[polygon.triangles[0].index()].vertices = {
        polygon.corners[0].vertex, polygon.corners[1].vertex, polygon.corners[3].vertex};
  });
  check_found(rule, square(),
              [](HybridMesh& m) { m.buffers.render_triangles.push_back(m.buffers.render_triangles[0]); });
  const auto uncut = *HybridMesh::build(scenes::grid(1, 1));
  check_found(rule, uncut, [](HybridMesh& m) {
    std::swap(m.buffers.render_triangles[0].vertices[0], m.buffers.render_triangles[0].vertices[1]);
  });
  check_found(rule, uncut,
              [](HybridMesh& m) { m.buffers.render_triangles[0].triangle = TriangleId{std::size_t{1}}; });
  check_found(rule, hexagon(), [](HybridMesh& m) {  // the drop's tip hangs on the vertex of what surrounds it
    auto& a = m.arrangements[1];
    auto& t = m.buffers.render_triangles[a.polygons[1].triangles[0].index()];
    std::replace(t.vertices.begin(), t.vertices.end(), a.polygons[1].corners[0].vertex,
                 a.polygons[0].corners[0].vertex);
  });
}

TEST_CASE("physics_nodes_are_components") {
  constexpr const char* rule = "physics_nodes_are_components";
  check_found(rule, square(), [](HybridMesh& m) {  // two copies of a node taken for one
    const TriangleId other = m.arrangements[0].polygons[1].triangle;
    m.buffers.triangles[other.index()].nodes[0] = m.buffers.triangles[0].nodes[0];
  });
  check_found(rule, square(), [](HybridMesh& m) {  // a needless copy
    m.buffers.triangles[0].nodes[0] = NodeId{m.buffers.nodes.size()};
    m.buffers.nodes.push_back(m.buffers.nodes[0]);
    m.positions.push_back(m.positions[0]);
  });
  check_found(rule, square(), [](HybridMesh& m) {  // a copy that nobody uses
    m.buffers.nodes.push_back(m.buffers.nodes[0]);
    m.positions.push_back(m.positions[0]);
  });
}

TEST_CASE("render_vertices_are_components") {
  constexpr const char* rule = "render_vertices_are_components";
  const auto replace = [](HybridMesh& m, RenderVertexId from, RenderVertexId to) {
    for (Arrangement& a : m.arrangements)
      for (RenderPolygon& p : a.polygons)
        for (PolygonCorner& c : p.corners)
          if (c.vertex == from) c.vertex = to;
    for (RenderTriangle& t : m.buffers.render_triangles)
      for (RenderVertexId& v : t.vertices)
        if (v == from) v = to;
  };
  check_found(rule, square(), [&](HybridMesh& m) {  // the two lips sewn together at one end
    const auto& polygons = m.arrangements[0].polygons;
    replace(m, polygons[0].corners[1].vertex, polygons[1].corners[0].vertex);
  });
  check_found(rule, square(), [](HybridMesh& m) {  // the two triangles of one piece with a vertex each
    PolygonCorner& corner = m.arrangements[0].polygons[0].corners[2];
    const RenderVertexId fresh{m.buffers.render_vertices.size()};
    m.buffers.render_vertices.push_back(m.buffers.render_vertices[corner.vertex.index()]);
    auto& t = m.buffers.render_triangles[m.arrangements[0].polygons[0].triangles[0].index()];
    std::replace(t.vertices.begin(), t.vertices.end(), corner.vertex, fresh);
    corner.vertex = fresh;
  });
  check_found(rule, square(), [](HybridMesh& m) {
    RenderVertex& v = m.buffers.render_vertices[m.arrangements[0].polygons[0].corners[1].vertex.index()];
    ++v.point.x;
  });
  check_found(rule, square(), [](HybridMesh& m) {  // one that nobody uses
    m.buffers.render_vertices.push_back(m.buffers.render_vertices.back());
  });
}

TEST_CASE("components_agree") {
  constexpr const char* rule = "components_agree";
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[1].cut[0] = 1; });
  check_found(rule, square(), [](HybridMesh& m) {  // pieces that share a vertex
    const auto& polygons = m.arrangements[0].polygons;
    m.buffers.render_triangles[polygons[0].triangles[0].index()].vertices[1] = polygons[1].corners[0].vertex;
  });
  check_found(rule, square(), [](HybridMesh& m) {  // pieces that share a node
    m.buffers.triangles[m.arrangements[0].polygons[1].triangle.index()].nodes[0] =
        m.buffers.triangles[0].nodes[0];
  });
}

TEST_CASE("springs_match") {
  constexpr const char* rule = "springs_match";
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.springs[0] = {}; });
  check_found(rule, square(), [](HybridMesh& m) {  // two springs for one pair
    m.edge_states[0].springs.emplace_back(m.buffers.springs.size());
    m.buffers.springs.push_back(m.buffers.springs[m.edge_states[0].springs[0].index()]);
  });
  check_found(rule, square(), [](HybridMesh& m) { m.edge_states[0].springs.pop_back(); });
  check_found(rule, square(),
              [](HybridMesh& m) { m.edge_states[0].springs.push_back(m.edge_states[0].springs[0]); });
  check_found(rule, square(), [](HybridMesh& m) {  // between the two pieces
    Spring& s = m.buffers.springs[m.edge_states[0].springs[0].index()];
    Spring& other = m.buffers.springs[m.edge_states[0].springs[1].index()];
    std::swap(s.nodes[0], other.nodes[0]);
  });
  const auto uncut = *HybridMesh::build(scenes::grid(1, 1));
  check_found(rule, uncut, [](HybridMesh& m) { std::swap(m.buffers.springs[0], m.buffers.springs[1]); });
}

TEST_CASE("springs_keep_rest_length") {
  constexpr const char* rule = "springs_keep_rest_length";
  check_found(rule, square(),
              [](HybridMesh& m) { std::swap(m.buffers.springs[0].nodes[0], m.buffers.springs[0].nodes[1]); });
  check_found(rule, square(), [](HybridMesh& m) { m.buffers.springs[0].edge = m.buffers.springs[1].edge; });
}

TEST_CASE("at most as many violations as asked for") {
  HybridMesh mesh = square();
  for (Spring& s : mesh.buffers.springs) std::swap(s.nodes[0], s.nodes[1]);
  CHECK(validate(mesh).size() > 3);
  CHECK(validate(mesh, 3).size() == 3);
  CHECK(validate(mesh, 0).empty());
}

TEST_CASE("any one index or coordinate that is wrong is found") {
  for (const HybridMesh& sound :
       {hand::square_cut_in_two(), hand::hexagon_with_cuts(), hand::moebius_with_cut()}) {
    scenes::Random random(1);
    HybridMesh mesh = sound;
    std::vector<std::uint32_t*> words;  // everything but stamps, positions, and what only the input names
    const auto add = [&](auto& field) { words.push_back(&field); };
    for (Arrangement& a : mesh.arrangements) {
      std::vector<std::uint8_t> on_loop(a.nodes.size(), 0);  // a slit may lie elsewhere just as well
      for (const RenderPolygon& p : a.polygons)
        for (const PolygonCorner& c : p.corners) on_loop[c.node] = 1;
      for (std::size_t n = 0; n < a.nodes.size(); ++n)
        for (std::int32_t* c : {&a.nodes[n].point.x, &a.nodes[n].point.y})
          if (on_loop[n] != 0) words.push_back(reinterpret_cast<std::uint32_t*>(c));
      for (std::uint32_t& n : a.boundary_counts) add(n);
      for (CutEdge& e : a.edges)
        for (std::uint32_t* i : {&e.from, &e.to, &e.left, &e.right}) words.push_back(i);
      for (RenderPolygon& p : a.polygons) {
        add(p.triangle.value);
        for (PolygonCorner& c : p.corners) {
          add(c.node);
          add(c.vertex.value);
        }
        for (std::uint32_t& end : p.loop_ends) add(end);
        for (RenderTriangleId& t : p.triangles) add(t.value);
      }
      for (auto& sections : a.section_polygons)
        for (std::uint32_t& p : sections) add(p);
    }
    for (EdgeState& s : mesh.edge_states) {
      for (BoundaryNode& n : s.nodes) words.push_back(reinterpret_cast<std::uint32_t*>(&n.t));
      for (SpringId& id : s.springs) add(id.value);
    }
    for (std::uint32_t& i : mesh.arrangement_of) add(i);
    for (std::uint32_t& i : mesh.edge_state_of) add(i);
    for (RenderVertexId& id : mesh.free_render_vertices) add(id.value);
    for (RenderTriangleId& id : mesh.free_render_triangles) add(id.value);
    for (AncestorNodeId& id : mesh.buffers.nodes) add(id.value);
    for (PhysicsTriangle& t : mesh.buffers.triangles) {
      for (NodeId& id : t.nodes) add(id.value);
      add(t.ancestor.value);
    }
    for (Spring& s : mesh.buffers.springs) {
      for (NodeId& id : s.nodes) add(id.value);
      add(s.edge.value);
    }
    for (RenderVertex& v : mesh.buffers.render_vertices) {
      if (!v.triangle.valid()) continue;
      for (NodeId& id : v.nodes) add(id.value);
      for (std::int32_t* c : {&v.point.x, &v.point.y}) words.push_back(reinterpret_cast<std::uint32_t*>(c));
    }
    for (RenderTriangle& t : mesh.buffers.render_triangles) {
      if (!t.triangle.valid()) continue;
      for (RenderVertexId& id : t.vertices) add(id.value);
      add(t.triangle.value);
    }
    for (Ancestor& t : mesh.ancestors.triangles) {
      for (AncestorNodeId& id : t.nodes) add(id.value);
      for (AncestorEdgeId& id : t.edges) add(id.value);
    }
    for (AncestorEdge& e : mesh.ancestors.edges) {
      for (AncestorNodeId& id : e.nodes) add(id.value);
      for (AncestorId& id : e.triangles) add(id.value);
    }
    for (std::uint32_t& i : mesh.ancestors.first_incidence) add(i);
    for (AncestorId& id : mesh.ancestors.incidences) add(id.value);

    for (std::size_t round = 0; round < 3 * words.size(); ++round) {
      std::uint32_t* word = words[round % words.size()];
      const std::uint32_t before = *word;
      *word = round < words.size() ? before + 1 : random_index(random);
      CAPTURE(round % words.size());
      CAPTURE(before);
      CAPTURE(*word);
      if (*word != before) CHECK(!validate(mesh).empty());
      *word = before;
    }
    check_sound(mesh);
  }
}

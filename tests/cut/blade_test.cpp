// Where a Blade cuts when it moves, when the cloth moves, and when others cut.
#include <cut/blade.hpp>
#include <cut/pieces.hpp>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <set>

#include "cut/cut_and_check.hpp"

namespace {

/// A cloth of 8 by 6 cells of size 1 in the plane z = 0, and an upright blade.
struct Scene {
  cut::HybridMesh mesh = std::move(*cut::HybridMesh::build(scenes::grid(8, 6)));
  cut::Blade blade{cut::default_merge_distances(mesh)};

  bool lead_to(double x, double y, double lean = 0) {
    const auto changes = blade.cut_to(mesh, {{x - lean, y, -1}, {x + lean, y, 1}});
    REQUIRE(changes.has_value());
    REQUIRE(violations(mesh) == "");
    return !changes->empty();
  }
  void move_cloth(const Eigen::Vector3d& way) {
    for (Eigen::Vector3d& p : mesh.positions) p += way;
    mesh.moved();
  }
  /// Moves the piece that reaches to x along x.
  void pull_away(double x, double way) {
    const cut::Pieces pieces = cut::pieces(mesh);
    const auto& vertices = mesh.buffers.render_vertices;
    std::size_t farther = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (vertices[v].triangle.valid() && mesh.position(vertices[v]).x() == x) farther = pieces.of_vertex[v];
    std::set<std::size_t> nodes;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (vertices[v].triangle.valid() && pieces.of_vertex[v] == farther)
        for (const cut::NodeId n : vertices[v].nodes) nodes.insert(n.index());
    for (const std::size_t n : nodes) mesh.positions[n].x() += way;
    mesh.moved();
  }
  [[nodiscard]] std::size_t pieces() const { return cut::pieces(mesh).list.size(); }
};

}  // namespace

TEST_CASE("the first call puts the blade into its place and cuts nothing; so does the first after lift") {
  Scene scene;
  CHECK_FALSE(scene.lead_to(2.3, 3.1));
  REQUIRE(scene.blade.tips().size() == 1);
  CHECK(scene.lead_to(4.6, 3.1));
  scene.blade.lift();
  CHECK(scene.blade.tips().empty());
  const cut::HybridMesh before = scene.mesh;
  CHECK_FALSE(scene.lead_to(4.6, 5.2));
  CHECK(scene.mesh.buffers == before.buffers);
}

TEST_CASE("a blade that is led right through leaves two pieces") {
  Scene scene;
  for (int i = 0; i <= 40; ++i) scene.lead_to(-1 + 0.25 * i, 2.6 + 0.01 * i);
  CHECK(scene.pieces() == 2);
  CHECK(scene.blade.tips().empty());
}

TEST_CASE("cloth and blade that move together: nothing is cut, and the line goes on where it was") {
  Scene scene;
  scene.lead_to(-1, 2.6);
  double x = -1;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d drift = (i % 2 == 0 ? 1.0 : -0.9) * Eigen::Vector3d(0.9, 0.7, 0.3);
    scene.move_cloth(drift);
    // The blade stays behind, is carried along in one call, and goes on in the next: in the cloth it moves by
    // 0.17 a turn.
    const Eigen::Vector3d origin = scene.mesh.positions[0];
    x += 0.17;
    const auto changes = scene.blade.cut_to(
        scene.mesh, {origin + Eigen::Vector3d(x, 2.6, -1), origin + Eigen::Vector3d(x, 2.6, 1)});
    REQUIRE(changes.has_value());
    REQUIRE(violations(scene.mesh) == "");
  }
  REQUIRE(scene.pieces() == 2);
  CHECK(cut::pieces(scene.mesh).list[1].rest_area == doctest::Approx(8 * 2.6).epsilon(0.01));
}

TEST_CASE("cloth that moves over a blade that stands still is cut") {
  Scene scene;
  scene.lead_to(-0.5, 2.6);
  for (int i = 0; i < 30; ++i) {
    scene.move_cloth({-0.31, 0, 0});
    scene.lead_to(-0.5, 2.6);
  }
  CHECK(scene.pieces() == 2);
}

TEST_CASE("a border that passes the blade in one step is cut, too") {
  Scene scene;
  scene.lead_to(-0.5, 2.6);
  scene.move_cloth({-3.2, 0, 0});
  scene.lead_to(-0.5, 2.6);
  for (const double x : {1.0, 3.0, 6.0}) scene.lead_to(x, 2.6);
  CHECK(scene.pieces() == 2);
}

TEST_CASE("a blade that stands still in cloth that stands still goes on with its cut later") {
  Scene scene;
  for (const double x : {-0.5, 0.3, 0.33, 0.36}) scene.lead_to(x, 2.6);
  for (int i = 0; i < 3; ++i) CHECK_FALSE(scene.lead_to(0.36, 2.6));
  for (const double x : {0.39, 1.2, 5.0, 9.0}) scene.lead_to(x, 2.6);
  CHECK(scene.pieces() == 2);
}

TEST_CASE("another cut may divide the triangle that the blade is in; the blade stays with its part") {
  for (const bool to_the_right : {true, false})
    for (const double at : {4.15, 4.3, 4.45, 4.6}) {  // some of these are in the part that is a new triangle
      CAPTURE(to_the_right);
      CAPTURE(at);
      Scene scene;
      const auto x_of = [&](double x) { return to_the_right ? x : 8 - x; };
      scene.lead_to(x_of(-0.5), 2.6);
      scene.lead_to(x_of(at), 2.6);
      cut::Cutter other(cut::default_merge_distances(scene.mesh));
      REQUIRE(
          other.cut(scene.mesh, scenes::plane({x_of(at + 0.15), 3, 0}, {0, 8, 0}, {0, 0, 2})).has_value());
      REQUIRE(scene.pieces() == 2);
      scene.pull_away(x_of(8), x_of(1) - x_of(0));
      // It goes on in the part that it is in: a sweep that starts ahead would leave the rest of it whole.
      scene.lead_to(x_of(7), 2.6);
      scene.lead_to(x_of(10), 2.6);
      CHECK(scene.pieces() == 4);
    }
}

TEST_CASE("two layers of cloth are cut by one blade, each from where it was cut last") {
  cut::TriangleMesh two = scenes::grid(8, 6);
  const auto count = static_cast<std::uint32_t>(two.positions.size());
  for (std::uint32_t n = 0; n < count; ++n)
    two.positions.push_back(two.positions[n] + Eigen::Vector3d(0, 0, 0.5));
  const std::size_t triangles = two.triangles.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = two.triangles[t];
    two.triangles.push_back({a + count, b + count, c + count});
  }
  Scene scene;
  scene.mesh = std::move(*cut::HybridMesh::build(two));
  for (int i = 0; i <= 60; ++i) {
    scene.lead_to(-1 + 0.2 * i, 2.6, 0.2);
    for (std::size_t n = 0; n < scene.mesh.positions.size(); ++n)
      scene.mesh.positions[n].y() += (scene.mesh.positions[n].z() > 0.25 ? 1 : -1) * (i % 4 < 2 ? 0.4 : -0.4);
    scene.mesh.moved();
    if (i > 0) CHECK(scene.blade.tips().size() <= 2);
  }
  CHECK(scene.pieces() == 4);
}

TEST_CASE("cloth that is nowhere is named as the Cutter names it; where it is again, the blade goes on") {
  Scene scene;
  scene.lead_to(-0.5, 2.6);
  scene.lead_to(4.3, 2.6);
  const cut::NodeId node = scene.mesh.buffers.triangles[scene.blade.tips().at(0).triangle.index()].nodes[0];
  Eigen::Vector3d& place = scene.mesh.positions[node.index()];
  const Eigen::Vector3d was = place;
  place.x() = std::nan("");
  scene.mesh.moved();
  const auto changes = scene.blade.cut_to(scene.mesh, {{5, 2.6, -1}, {5, 2.6, 1}});
  REQUIRE_FALSE(changes.has_value());
  CHECK(changes.error().kind == cut::Error::Kind::not_finite);
  CHECK(changes.error().element == node.index());
  place = was;
  scene.mesh.moved();
  scene.lead_to(10, 2.6);
  CHECK(scene.pieces() == 2);
}

TEST_CASE("a blade that is none is an error and changes nothing") {
  Scene scene;
  const auto fails = [&](const std::vector<Eigen::Vector3d>& edge) {
    const auto changes = scene.blade.cut_to(scene.mesh, edge);
    return !changes.has_value();
  };
  CHECK(fails({}));
  CHECK(fails({{0, 0, 0}}));
  scene.lead_to(2.3, 3.1);
  CHECK(fails({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}));
  CHECK(fails({{0, 0, 0}, {0, 0, std::nan("")}}));
  CHECK(scene.lead_to(4.6, 3.1));  // it goes on from where it was
}

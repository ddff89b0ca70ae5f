// Cutters that break cutting methods: through nodes, along edges, coplanar, tangent, without area,
// overlapping, five cuts through one point, slivers, lines that climb along older cuts (docs/cutting.md).
#include <doctest/doctest.h>

#include <cmath>

#include "cut/pieces.hpp"
#include "cut_and_check.hpp"
#include "places.hpp"
#include "scenes/cloths.hpp"
#include "scenes/cutters.hpp"
#include "scenes/surfaces.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

cut::TriangleMesh wall(const scenes::Path& path) { return scenes::ribbon(path, {0, 0, 2}); }

std::size_t piece_count(const Session& s) { return cut::pieces(s.mesh).list.size(); }

double rest_area(const Session& s) {
  double sum = 0;
  for (const cut::Piece& p : cut::pieces(s.mesh).list) sum += p.rest_area;
  return sum;
}

TEST_CASE("two fragments glued to the same three nodes share their springs") {
  Session s(scenes::grid(2, 2));
  const std::size_t springs = s.mesh.buffers.springs.size();
  // A line through one triangle from side to side; its neighbours stay whole.
  s.cut(wall({{0.2, 0.45, 0}, {0.55, 0.45, 0}}));
  REQUIRE(piece_count(s) == 1);
  CHECK(s.mesh.buffers.springs.size() == springs);
  CHECK(s.mesh.buffers.nodes.size() == 9);
}

TEST_CASE("at the front of a cut both halves share the edge with the uncut neighbour") {
  Session s(scenes::grid(4, 1));
  s.cut(wall({{-1, 0.52, 0}, {1.45, 0.52, 0}}));
  CHECK(piece_count(s) == 1);
  CHECK(cut::pieces(s.mesh).list[0].boundary_loops == 1);
  s.cut(wall({{1.45, 0.52, 0}, {5, 0.52, 0}}));
  CHECK(piece_count(s) == 2);
}

TEST_CASE("five cuts through one point") {
  Session s(scenes::grid(4, 4));
  s.cut(scenes::star({2.3, 1.7, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 2}, 5));
  CHECK(piece_count(s) == 10);
  CHECK(rest_area(s) == doctest::Approx(16).epsilon(1e-12));
}

TEST_CASE("five cuts through a node, one after the other") {
  Session s(scenes::grid(4, 4));
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.3 + i * 3.14159265358979 / 5;
    const Vector3 d{6 * std::cos(angle), 6 * std::sin(angle), 0};
    s.cut(wall({Vector3(2, 2, 0) - d, Vector3(2, 2, 0) + d}));
  }
  CHECK(piece_count(s) == 10);
}

TEST_CASE("a coplanar cutter cuts nothing") {
  Session s(scenes::grid(3, 3));
  CHECK(s.cut(scenes::plane({1.5, 1.5, 0}, {1, 0, 0}, {0, 1, 0})).empty());
}

TEST_CASE("a cutter that touches a fold opens the cloth along it") {
  cut::TriangleMesh roof = scenes::grid(2, 2);
  for (Vector3& p : roof.positions) p.z() = -std::abs(p.y() - 1);
  Session s(roof);
  s.cut(scenes::plane({1, 1, 0}, {3, 0, 0}, {0, 3, 0}));
  CHECK(piece_count(s) == 2);
}

TEST_CASE("cutter triangles without area cut nothing, and do not disturb the others") {
  Session with(scenes::grid(3, 3));
  Session without(scenes::grid(3, 3));
  cut::TriangleMesh blade = wall({{-1, 1.2, 0}, {4, 1.9, 0}});
  without.cut(blade);
  const auto n = static_cast<std::uint32_t>(blade.positions.size());
  for (const Vector3& p : {Vector3(0, 0, -1), Vector3(1, 1, 0), Vector3(2, 2, 1)})
    blade.positions.push_back(p);
  blade.triangles.push_back({n, n + 1, n + 2});
  blade.triangles.push_back({0, 0, 1});
  with.cut(blade);
  CHECK(with.mesh.buffers == without.mesh.buffers);
}

TEST_CASE("overlapping and repeated cutter triangles cut once") {
  Session once(scenes::grid(3, 3));
  Session twice(scenes::grid(3, 3));
  const cut::TriangleMesh blade = wall({{-1, 1.2, 0}, {4, 1.9, 0}});
  once.cut(blade);
  twice.cut(scenes::joined({blade, blade, blade}));
  CHECK(once.mesh.buffers == twice.mesh.buffers);
}

TEST_CASE("a cutter that crosses itself") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{0.4, 0.5, 0}, {3.4, 3.1, 0}, {3.5, 0.6, 0}, {0.6, 3.3, 0}}));
  CHECK(piece_count(s) == 2);
}

TEST_CASE("a line that crosses an old cut with close nodes does not climb along it") {
  Session s(scenes::grid(1, 1, 10.0));
  const double edge = s.cutter.distances().edge;
  // An old cut with nodes 0.8 δe apart sideways, and a line nearly along it.
  scenes::Path zigzag;
  for (int i = 0; i <= 60; ++i)
    zigzag.push_back({2 + i * edge * 2.5, 3 + i * edge * 0.8 + (i % 2) * edge * 0.5, 0});
  s.cut(wall(zigzag));
  const Vector3 from{1.5, 3.2, 0};
  const Vector3 to{9.5, 3.3, 0};
  const std::uint32_t before = s.mesh.cut_count;
  s.cut(wall({from, to}));
  const Vector3 along = (to - from).normalized();
  for (const cut::Arrangement& a : s.mesh.arrangements)
    for (const cut::ArrangementNode& n : a.nodes) {
      if (n.stamp <= before || n.point == cut::lattice_corner(0) || edge_of(n.point) < 3) continue;
      Vector3 p = Vector3::Zero();
      const auto index = static_cast<std::size_t>(&a - s.mesh.arrangements.data());
      for (std::size_t t = 0; t < s.mesh.arrangement_of.size(); ++t)
        if (s.mesh.arrangement_of[t] == index)
          p = interpolated(rest_corners(s.mesh, cut::AncestorId{t}), n.point);
      const Vector3 off = (p - from) - along * along.dot(p - from);
      CHECK(off.norm() <= 3.01 * edge);
    }
}

TEST_CASE("a blade that goes on in tiny steps keeps its cut in one line and where it passed") {
  Session s(scenes::grid(3, 3));
  const Vector3 from{-0.3, 1.37, 0};
  const Vector3 to{3.4, 1.81, 0};
  const int steps = 900;  // a tenth of δn each
  for (int i = 0; i < steps; ++i)
    s.cut(wall({from + (to - from) * i / steps, from + (to - from) * (i + 1) / steps}));
  const auto pieces = cut::pieces(s.mesh).list;
  REQUIRE(pieces.size() == 2);
  // Area below the line from edge to edge.
  const double slope = (to.y() - from.y()) / (to.x() - from.x());
  const double below = 3 * (from.y() + slope * (1.5 - from.x()));
  CHECK(std::min(pieces[0].rest_area, pieces[1].rest_area) ==
        doctest::Approx(std::min(below, 9 - below)).epsilon(3 * s.cutter.distances().node / 4));
}

TEST_CASE("pieces are cut again and again down to slivers") {
  Session s(scenes::grid(1, 1), {2e-4, 1e-4, 5e-5});
  for (int i = 0; i < 60; ++i) {
    const double a = (i * 37 % 61) / 61.0;
    const double b = (i * 23 % 59) / 59.0;
    s.cut(
        wall(i % 2 == 0 ? scenes::Path{{-0.5, a, 0}, {1.5, b, 0}} : scenes::Path{{a, -0.5, 0}, {b, 1.5, 0}}));
  }
  CHECK(piece_count(s) > 100);
  CHECK(rest_area(s) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a tube through a sphere gives two caps and a belt") {
  Session s(scenes::sphere(2));
  s.cut(scenes::tube(scenes::circle_path({0.03, 0.02, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 24), {0, 0, 4}));
  const auto pieces = cut::pieces(s.mesh).list;
  REQUIRE(pieces.size() == 3);
  CHECK(pieces[0].boundary_loops == 2);
  CHECK(pieces[1].boundary_loops == 1);
  CHECK(pieces[2].boundary_loops == 1);
}

}  // namespace

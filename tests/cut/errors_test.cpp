// Every error that building a mesh, checking merge distances and cutting can return: its kind, its element, a
// message that names the element, and that a cut that fails leaves mesh and cutter fit for the next one.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "cut/pieces.hpp"
#include "cut_and_check.hpp"
#include "scenes/cloths.hpp"
#include "scenes/cutters.hpp"

namespace {

using cut::Error;
using Kind = Error::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect(const Error& error, Kind kind, std::size_t element, const std::string& words) {
  CAPTURE(error.message);
  CHECK(error.kind == kind);
  CHECK(error.element == element);
  CHECK_MESSAGE(error.message.find(words) != std::string::npos, "expected: " << words);
  CHECK(error.message.find('\n') == std::string::npos);
}

void expect_refused(const cut::TriangleMesh& mesh, Kind kind, std::size_t element, const std::string& words) {
  const auto result = cut::HybridMesh::build(mesh);
  REQUIRE_FALSE(result.has_value());
  expect(result.error(), kind, element, words);
}

/// Four points of a unit square, a fifth above it, a sixth in line with the first two.
cut::TriangleMesh mesh_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}}, triangles};
}

TEST_CASE("a mesh without triangles is not built") {
  expect_refused({}, Kind::empty_mesh, 0, "no triangles");
  expect_refused(mesh_of({}), Kind::empty_mesh, 0, "no triangles");
}

TEST_CASE("a triangle that names a point that is not there is not built") {
  expect_refused(mesh_of({{0, 1, 2}, {0, 2, 6}}), Kind::index_out_of_range, 1, "triangle 1 names point 6");
  expect_refused(mesh_of({{0xffffffffu, 1, 2}}), Kind::index_out_of_range, 0, "point 4294967295");
}

TEST_CASE("a point that is not finite is not built, whether a triangle names it or not") {
  for (const double bad : {not_a_number, infinity, -infinity, 1e50, -1e300})
    for (const std::size_t point : {std::size_t{2}, std::size_t{5}})
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        cut::TriangleMesh mesh = mesh_of({{0, 1, 2}, {0, 2, 3}});
        mesh.positions[point][axis] = bad;
        expect_refused(mesh, Kind::not_finite, point, "point " + std::to_string(point));
      }
}

TEST_CASE("a triangle without area is not built") {
  expect_refused(mesh_of({{0, 1, 2}, {0, 2, 3}, {0, 1, 5}}), Kind::degenerate_triangle, 2, "triangle 2");
  expect_refused(mesh_of({{0, 1, 1}, {0, 2, 3}}), Kind::degenerate_triangle, 0, "triangle 0");
}

TEST_CASE("a triangle that is there twice is not built, however it is turned") {
  for (const std::array<std::uint32_t, 3> again :
       {std::array<std::uint32_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 1, 0}})
    expect_refused(mesh_of({{0, 1, 2}, {0, 2, 3}, again}), Kind::duplicate_triangle, 2,
                   "triangle 2 has the same corners as triangle 0");
}

TEST_CASE("an edge of three triangles is not built") {
  expect_refused(mesh_of({{1, 2, 3}, {0, 1, 3}, {0, 1, 4}, {1, 0, 2}}), Kind::non_manifold_edge, 1,
                 "between points 0 and 1");
}

TEST_CASE("merge distances out of order, or below a lattice unit, are refused") {
  const cut::HybridMesh mesh = *cut::HybridMesh::build(scenes::grid(1, 1));
  const double unit = std::sqrt(2.0) / cut::lattice_size;  // of the diagonal
  CHECK(cut::checked({0.3, 0.2, 0.1}, mesh).has_value());
  CHECK(cut::checked({0.1, 0.1, 0.1}, mesh).has_value());
  CHECK(cut::checked({1.41, 0.2, 0.1}, mesh).has_value());
  CHECK(cut::checked({unit * 1.01, unit * 1.01, unit * 1.01}, mesh).has_value());
  for (const cut::MergeDistances& bad : {cut::MergeDistances{0.1, 0.2, 0.05},
                                         {0.3, 0.1, 0.2},
                                         {0.3, 0.2, unit},
                                         {0.3, 0.2, 0},
                                         {0.3, 0.2, -0.1},
                                         {1.42, 0.2, 0.1},
                                         {infinity, 0.2, 0.1},
                                         {not_a_number, 0.2, 0.1},
                                         {0.3, not_a_number, 0.1},
                                         {0.3, 0.2, not_a_number}}) {
    const auto result = cut::checked(bad, mesh);
    REQUIRE_FALSE(result.has_value());
    expect(result.error(), Kind::bad_merge_distances, 0, "cut >= node >= edge");
  }
}

/// A sheet that is cut already, and what must be the same after a cut that failed.
struct Attempt {
  Session session{scenes::grid(4, 4)};

  Attempt() { session.cut(scenes::ribbon({{-1, 0.4, 0}, {5, 0.7, 0}}, {0, 0, 2})); }

  void expect_failure(const cut::TriangleMesh& cutter, Kind kind, std::size_t element,
                      const std::string& words) {
    const cut::HybridMesh before = session.mesh;
    const auto result = session.cutter.cut(session.mesh, cutter);
    REQUIRE_FALSE(result.has_value());
    expect(result.error(), kind, element, words);
    const cut::HybridMesh& after = session.mesh;
    CHECK(after.buffers == before.buffers);
    CHECK(after.arrangements == before.arrangements);
    CHECK(after.edge_states == before.edge_states);
    CHECK(after.node_stamps == before.node_stamps);
    CHECK(after.cut_count == before.cut_count);
    CHECK(after.topology_version == before.topology_version);
    CHECK(after.state == before.state);
    REQUIRE(after.positions.size() == before.positions.size());
    for (std::size_t n = 0; n < after.positions.size(); ++n)  // a NaN is the same NaN
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double was = before.positions[n][axis], is = after.positions[n][axis];
        CHECK((was == is || (std::isnan(was) && std::isnan(is))));
      }
  }

  /// The same good cut as on a sheet on which nothing has failed.
  void expect_good_cut() {
    const cut::TriangleMesh blade = scenes::ribbon({{-1, 2.3, 0}, {5, 2.6, 0}}, {0, 0, 2});
    Attempt other;
    other.session.cut(blade);
    session.cut(blade);
    CHECK(session.mesh.buffers == other.session.mesh.buffers);
    CHECK(cut::pieces(session.mesh).list.size() == 3);
  }
};

cut::TriangleMesh good_blade() { return scenes::ribbon({{-1, 1.3, 0}, {5, 1.6, 0}}, {0, 0, 2}); }

TEST_CASE("a cutter that names a point that is not there fails and changes nothing") {
  Attempt attempt;
  cut::TriangleMesh blade = good_blade();
  blade.triangles[1][2] = 4;
  attempt.expect_failure(blade, Kind::index_out_of_range, 1, "triangle 1 of the cutter names point 4");
  attempt.expect_good_cut();
}

TEST_CASE("a cutter with a point that is not finite fails and changes nothing") {
  Attempt attempt;
  for (const double bad : {not_a_number, infinity, -infinity, 1e50, -1e300}) {
    cut::TriangleMesh blade = good_blade();
    blade.positions[3].y() = bad;
    attempt.expect_failure(blade, Kind::not_finite, 3, "point 3 of the cutter");
  }
  attempt.expect_good_cut();
}

TEST_CASE("a cutter that reaches too far fails and changes nothing") {
  Attempt attempt;
  const double farthest = 0x1p40 * attempt.session.cutter.distances().edge;
  cut::TriangleMesh blade = good_blade();
  for (const double sign : {-1.0, 1.0}) {
    blade.positions[2].x() = sign * farthest * (1 + 0x1p-50);
    attempt.expect_failure(blade, Kind::too_far, 2, "point 2 of the cutter");
  }
  attempt.expect_good_cut();
  blade.positions[2].x() = farthest;
  CHECK(attempt.session.cutter.cut(attempt.session.mesh, blade).has_value());
}

TEST_CASE("a cloth with a node that is not finite fails to be cut and is not changed") {
  for (const double bad : {not_a_number, infinity}) {
    Attempt attempt;
    cut::HybridMesh& mesh = attempt.session.mesh;
    const double was = mesh.positions[7].z();
    mesh.positions[7].z() = bad;
    mesh.moved();
    attempt.expect_failure(good_blade(), Kind::not_finite, 7, "physics node 7");
    attempt.expect_failure(good_blade(), Kind::not_finite, 7, "physics node 7");  // it is still so
    mesh.positions[7].z() = was;
    mesh.moved();
    attempt.expect_good_cut();
  }
}

}  // namespace

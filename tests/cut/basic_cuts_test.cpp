// The simplest cuts there are, with known results: through cut, slit, cut-out, along edges, through nodes.
#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "cut/cutter.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/pieces.hpp"
#include "cut/validate.hpp"
#include "cut_and_check.hpp"
#include "scenes/cloths.hpp"
#include "scenes/cutters.hpp"

namespace {

using cut::HybridMesh;
using Vector3 = Eigen::Vector3d;

const Vector3 up{0, 0, 1};

/// A vertical wall over the path, through the plane z = 0.
cut::TriangleMesh wall(const scenes::Path& path) { return scenes::ribbon(path, {0, 0, 2}); }

TEST_CASE("a cut through a sheet gives two pieces") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{-1, 1.3, 0}, {5, 2.6, 0}}));
  const auto pieces = cut::pieces(s.mesh).list;
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].rest_area + pieces[1].rest_area == doctest::Approx(16).epsilon(1e-12));
  for (const auto& p : pieces) CHECK(p.boundary_loops == 1);
  for (const auto& p : pieces) CHECK(p.euler_characteristic == 1);
}

TEST_CASE("a slit gives one piece with one hole") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{0.7, 1.3, 0}, {3.2, 2.6, 0}}));
  const auto pieces = cut::pieces(s.mesh).list;
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].boundary_loops == 2);
  CHECK(pieces[0].euler_characteristic == 0);
}

TEST_CASE("a cut-out gives an annulus and a disc") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{0.7, 0.8, 0}, {3.2, 0.9, 0}, {3.1, 3.2, 0}, {0.8, 3.3, 0}, {0.7, 0.8, 0}}));
  const auto pieces = cut::pieces(s.mesh).list;
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].boundary_loops + pieces[1].boundary_loops == 3);
}

TEST_CASE("a cut through nodes and along edges makes no new nodes on edges") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{-1, 2, 0}, {5, 2, 0}}));
  CHECK(cut::pieces(s.mesh).list.size() == 2);
  CHECK(s.mesh.buffers.triangles.size() == 32);
  CHECK(s.mesh.buffers.nodes.size() == 25 + 5);
}

TEST_CASE("the same cut twice changes nothing") {
  Session s(scenes::grid(4, 4));
  s.cut(wall({{-1, 1.3, 0}, {5, 2.6, 0}}));
  CHECK(s.cut(wall({{-1, 1.3, 0}, {5, 2.6, 0}})).empty());
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The nodes of all springs in use, sorted; a spring that is there twice is there twice.
Pairs springs(const HybridMesh& mesh) {
  Pairs result;
  for (const cut::Spring& s : mesh.buffers.springs)
    if (s.nodes[0].valid()) result.push_back(std::minmax(s.nodes[0].value, s.nodes[1].value));
  std::sort(result.begin(), result.end());
  return result;
}

TEST_CASE("a cut that crosses one triangle only leaves one spring per pair of nodes") {
  // Nodes 0 1 below and 2 3 above; the diagonal from 0 to 3.
  Session s(scenes::grid(1, 1));
  CHECK(springs(s.mesh) == Pairs{{0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}});
  // The upper triangle in two: both parts hang on the lower one, so they share 0 and 3 and the spring between
  // these. The part that has lost the corner 2 has a copy of it, 4.
  s.cut(wall({{-1, 0.5, 0}, {0.5, 0.5, 0}}));
  CHECK(springs(s.mesh) == Pairs{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 3}, {2, 3}, {3, 4}});
  // The lower triangle in two, as far as that cut: the corner 0 comes off. What remains has a copy of 0, 5;
  // the corner has 4 and copies of 1 and 3, 6 and 7.
  s.cut(wall({{0.5, -1, 0}, {0.5, 0.5, 0}}));
  CHECK(springs(s.mesh) ==
        Pairs{{0, 4}, {0, 6}, {0, 7}, {1, 3}, {1, 5}, {2, 3}, {2, 5}, {3, 5}, {4, 7}, {6, 7}});
  CHECK(cut::pieces(s.mesh).list.size() == 2);
}

}  // namespace

// The broad phase against all pairs of boxes: on a mesh just seen, one that stands still, and one that moves.
#include "cutting/broad_phase.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scenes/cutters.hpp"
#include "scenes/random.hpp"
#include "scenes/surfaces.hpp"

namespace {

using Pairs = std::vector<std::pair<std::size_t, std::uint32_t>>;
using Vector3 = Eigen::Vector3d;

Pairs sorted(const std::vector<cut::CandidatePair>& candidates) {
  Pairs result;
  for (const auto& c : candidates) result.emplace_back(c.triangle.index(), c.cutter_triangle);
  std::sort(result.begin(), result.end());
  return result;
}

Pairs all_pairs(const cut::HybridMesh& mesh, const cut::TriangleMesh& cutter, double slack) {
  Pairs result;
  for (std::size_t t = 0; t < mesh.buffers.triangles.size(); ++t) {
    if (!mesh.buffers.triangles[t].ancestor.valid()) continue;
    for (std::uint32_t i = 0; i < cutter.triangles.size(); ++i) {
      bool apart = false;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
        for (std::size_t k = 0; k < 3; ++k) {
          const double p[2] = {mesh.positions[mesh.buffers.triangles[t].nodes[k].index()][axis],
                               cutter.positions[cutter.triangles[i][k]][axis]};
          for (std::size_t side = 0; side < 2; ++side) {
            low[side] = std::min(low[side], p[side]);
            high[side] = std::max(high[side], p[side]);
          }
        }
        apart = apart || low[0] > high[1] + slack || high[0] < low[1] - slack;
      }
      if (!apart) result.emplace_back(t, i);
    }
  }
  return result;
}

TEST_CASE("candidates are all pairs whose boxes meet, whether the mesh moves or stands still") {
  cut::HybridMesh mesh = cut::HybridMesh::build(scenes::curved_sheet(12, 2, 0.4)).value();
  cut::BroadPhase broad_phase;
  cut::Error error{};
  scenes::Random random(7);
  std::size_t found = 0;
  for (int call = 0; call < 40; ++call) {
    if (random.below(2) == 0) {
      for (Vector3& p : mesh.positions) p += Vector3(random.between(-0.1, 0.1), 0, random.between(-0.1, 0.1));
      mesh.moved();
    }
    const Vector3 from(random.between(0, 2), random.between(0, 2), 0), to(random.between(0, 2), 1, 0);
    const cut::TriangleMesh cutter =
        scenes::ribbon(scenes::wave_path(from, to, {0.1, 0.2, 0}, 1, 5), {0.1, 0.2, random.between(0, 2)});
    REQUIRE(broad_phase.update(mesh, error));
    const Pairs pairs = sorted(broad_phase.candidates(mesh, cutter, 0.01));
    CHECK(pairs == all_pairs(mesh, cutter, 0.01));
    found += pairs.size();
    if (call % 4 == 3) {  // as a cut does: one triangle more
      const std::size_t source = random.below(mesh.buffers.triangles.size());
      const cut::TriangleId copy{mesh.buffers.triangles.size()};
      mesh.buffers.triangles.push_back(cut::PhysicsTriangle{mesh.buffers.triangles[source]});
      broad_phase.add(mesh, {{copy, cut::TriangleId{source}}});
    }
    if (call % 10 == 9)  // as a cut does that leaves nothing of a triangle
      mesh.buffers.triangles[random.below(mesh.buffers.triangles.size())].ancestor = cut::AncestorId{};
  }
  CHECK(found > 1000);
  CHECK(sorted(broad_phase.candidates(mesh, {}, 0.01)).empty());
}

TEST_CASE("a position that is not finite is found when the mesh has moved") {
  cut::HybridMesh mesh = cut::HybridMesh::build(scenes::curved_sheet(3)).value();
  cut::BroadPhase broad_phase;
  cut::Error error{};
  REQUIRE(broad_phase.update(mesh, error));
  mesh.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
  mesh.moved();
  REQUIRE_FALSE(broad_phase.update(mesh, error));
  CHECK(error.kind == cut::Error::Kind::not_finite);
  CHECK(error.element == 5);
  mesh.positions[5].y() = 0;
  CHECK(broad_phase.update(mesh, error));
  CHECK(broad_phase.update(mesh, error));
}

}  // namespace

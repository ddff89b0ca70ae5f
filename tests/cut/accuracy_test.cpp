// Where a cut lies and what it costs: every point of it within the merge distances of the cutter (design rule
// 9), nothing moves at the instant of a cut, and what is touched depends on the cut and not on the size of
// the mesh (design rule 12).
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <limits>

#include "cut_and_check.hpp"
#include "random_cuts.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

double distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

double distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a, w = p - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  if (det > 0) {
    const double s = (vv * w.dot(u) - uv * w.dot(v)) / det, t = (uu * w.dot(v) - uv * w.dot(u)) / det;
    if (s >= 0 && t >= 0 && s + t <= 1) return (w - s * u - t * v).norm();
  }
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double distance(const Vector3& p, const cut::TriangleMesh& cutter) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : cutter.triangles)
    best = std::min(best, distance_to_triangle(p, cutter.positions[t[0]], cutter.positions[t[1]],
                                               cutter.positions[t[2]]));
  return best;
}

Vector3 rest_position(const cut::HybridMesh& mesh, cut::AncestorId t, cut::LatticePoint point) {
  Vector3 p = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    p += mesh.ancestors.rest_positions[mesh.ancestors.triangles[t.index()].nodes[k].index()] *
         (static_cast<double>(point[k]) / cut::lattice_size);
  return p;
}

TEST_CASE("every node of a cut lies within the merge distances of the cutter") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& data) {
    random_cuts::Bytes bytes(data.data(), data.size());
    const random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    Session s(cloth.mesh);
    const cut::TriangleMesh cutter = random_cuts::cutter(bytes, cloth);
    s.cut(cutter);
    const cut::MergeDistances& d = s.cutter.distances();
    const double limit = d.node + 2 * d.edge;  // an end merged to a node, and a chain drawn aside (§4.3)
    for (std::size_t t = 0; t < s.mesh.arrangement_of.size(); ++t) {
      const cut::Arrangement* a = s.mesh.arrangement(cut::AncestorId{t});
      if (a == nullptr) continue;
      for (const cut::CutEdge& e : a->edges)
        for (const std::uint32_t node : {e.from, e.to})
          RC_ASSERT(distance(rest_position(s.mesh, cut::AncestorId{t}, a->nodes[node].point), cutter) <=
                    limit * 1.001);
    }
  }));
}

TEST_CASE("copies of nodes lie where their source lies") {
  Session s(scenes::grid(4, 4));
  const auto changes = s.cut(scenes::ribbon({{-1, 1.3, 0}, {5, 2.6, 0}}, {0, 0, 2}));
  REQUIRE(!changes.node_copies.empty());
  for (const cut::NodeCopy& c : changes.node_copies)
    CHECK(s.mesh.positions[c.node.index()] == s.mesh.positions[c.source.index()]);
}

TEST_CASE("what a cut touches does not depend on the size of the mesh") {
  const auto touched = [](std::size_t cells) {
    Session s(scenes::grid(cells, cells));
    const auto c = s.cut(scenes::ribbon({{3.2, 4.3, 0}, {6.7, 5.6, 0}}, {0, 0, 2}));
    return c.triangles.entries.size() + c.nodes.entries.size() + c.springs.entries.size() +
           c.render_vertices.entries.size() + c.render_triangles.entries.size();
  };
  const std::size_t small = touched(10);
  CHECK(small > 0);
  CHECK(touched(40) == small);
  CHECK(touched(160) == small);
}

}  // namespace

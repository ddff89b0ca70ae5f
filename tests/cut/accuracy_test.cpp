// Where a cut lies and what it costs: every point of it within the merge distances of where the cutter met
// the cloth, nothing moves at the instant of a cut, and what is touched depends on the cut and not on the
// size of the mesh (docs/cutting.md).
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "cut_and_check.hpp"
#include "cutting/broad_phase.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "lattice/check_many.hpp"
#include "places.hpp"
#include "random_cuts.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

double distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

double distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - a);
  const auto inside = [&](const Vector3& from, const Vector3& to) {
    return normal.dot((to - from).cross(p - from)) >= 0;
  };
  if (normal.norm() > 0 && inside(a, b) && inside(b, c) && inside(c, a))
    return std::abs(normal.dot(p - a)) / normal.norm();
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double distance(const Vector3& p, const cut::TriangleMesh& cutter) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : cutter.triangles)
    best = std::min(best, distance_to_triangle(p, cutter.positions[t[0]], cutter.positions[t[1]],
                                               cutter.positions[t[2]]));
  return best;
}

/// A segment, or a point twice.
using Segment = std::pair<Vector3, Vector3>;

double distance(const Vector3& p, const std::vector<Segment>& segments) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : segments) best = std::min(best, distance_to_segment(p, a, b));
  return best;
}

/// Where the cutter meets the cloth, on the tension-free cloth: nothing merged yet. @return what is wrong
/// when a line does not lie on the cutter, where the cloth is now, to within δe / 64
std::string met(const cut::HybridMesh& mesh, const cut::TriangleMesh& cutter,
                const cut::MergeDistances& distances, std::vector<Segment>& lines) {
  const double slack = cut::contact_slack(distances, cutter);
  cut::BroadPhase broad_phase;
  cut::Error error{};
  if (!broad_phase.update(mesh, error)) return error.message;
  const cut::Detection found = cut::detect_cutting_lines(
      mesh, cutter, broad_phase.candidates(mesh, cutter, slack), slack, distances, {});
  for (const cut::DetectedLine& line : found.lines) {
    const auto rest = rest_corners(mesh, line.ancestor);
    lines.emplace_back(interpolated(rest, line.a), interpolated(rest, line.b));
    for (const cut::LatticePoint p : {line.a, line.b}) {
      double nearest = std::numeric_limits<double>::infinity();
      double longest = 0;
      for (std::size_t f = 0; f < mesh.fragment_count(line.ancestor); ++f) {
        std::array<Vector3, 3> now;
        for (std::size_t k = 0; k < 3; ++k)
          now[k] = mesh.positions
                       [mesh.buffers.triangles[mesh.fragment(line.ancestor, f).index()].nodes[k].index()];
        for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (now[k] - now[(k + 1) % 3]).norm());
        nearest = std::min(nearest, distance(interpolated(now, p), cutter));
      }
      if (!(nearest <= 64 * slack + 2 * longest / cut::lattice_size))
        return "a line was detected " + std::to_string(nearest) + " off the cutter";
    }
  }
  return {};
}

/// How far what the last cut has made lies off its lines, on the tension-free cloth.
struct Offsets {
  double node = 0;  ///< nodes that were not there before, and the ends of new edges
  double edge = 0;  ///< middles of new edges
};

/// @param before  the mesh before that cut
/// @param dropped  how far an old edge may move when one of its nodes is dropped: that is no new one (§4.7)
Offsets offsets(const cut::HybridMesh& mesh, const cut::HybridMesh& before, const std::vector<Segment>& lines,
                double dropped) {
  Offsets result;
  for (std::size_t i = 0; i < mesh.arrangement_of.size(); ++i) {
    const cut::AncestorId t{i};
    const cut::Arrangement* a = mesh.arrangement(t);
    if (a == nullptr) continue;
    const auto rest = rest_corners(mesh, t);
    std::vector<cut::LatticePoint> old_points;
    for (std::size_t k = 0; k < 3; ++k) old_points.push_back(cut::lattice_corner(k));
    std::vector<Segment> old_edges;
    if (const cut::Arrangement* old = before.arrangement(t)) {
      for (const cut::ArrangementNode& n : old->nodes) old_points.push_back(n.point);
      for (const cut::CutEdge& e : old->edges)
        old_edges.emplace_back(interpolated(rest, old->nodes[e.from].point),
                               interpolated(rest, old->nodes[e.to].point));
    }
    const auto place = [&](std::uint32_t node) { return interpolated(rest, a->nodes[node].point); };
    for (std::uint32_t n = 0; n < a->nodes.size(); ++n)
      if (std::find(old_points.begin(), old_points.end(), a->nodes[n].point) == old_points.end())
        result.node = std::max(result.node, distance(place(n), lines));
    for (const cut::CutEdge& e : a->edges) {
      const Vector3 middle = (place(e.from) + place(e.to)) / 2;
      if (a->nodes[e.from].stamp != mesh.cut_count || a->nodes[e.to].stamp != mesh.cut_count ||
          distance(middle, old_edges) <= dropped)
        continue;
      for (const std::uint32_t n : {e.from, e.to})
        result.node = std::max(result.node, distance(place(n), lines));
      result.edge = std::max(result.edge, distance(middle, lines));
    }
  }
  return result;
}

/// Where each render vertex is: its triangle of the uncut mesh, its lattice point, its position in space.
struct Place {
  cut::AncestorId ancestor;
  cut::LatticePoint point;
  Vector3 position;
};

std::vector<Place> places(const cut::HybridMesh& mesh) {
  std::vector<Place> result;
  for (const cut::RenderVertex& v : mesh.buffers.render_vertices)
    result.push_back(v.triangle.valid() ? Place{mesh.buffers.triangles[v.triangle.index()].ancestor, v.point,
                                                mesh.position(v)}
                                        : Place{});
  return result;
}

/// What has moved by a cut that was not to move, empty when nothing has.
std::string moved(const std::vector<Place>& before, const std::vector<Place>& after) {
  std::vector<std::array<double, 3>> now;
  for (const Place& p : after)
    if (p.ancestor.valid()) now.push_back({p.position.x(), p.position.y(), p.position.z()});
  std::sort(now.begin(), now.end());
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Place& old = before[v];
    if (!old.ancestor.valid()) continue;
    const std::string vertex = "render vertex " + std::to_string(v);
    if (after[v].ancestor == old.ancestor && after[v].point == old.point && after[v].position != old.position)
      return vertex + " has moved";
    // Seen from the other triangle at its edge, a vertex may be somewhere else in the last bits.
    const double rounding = 1e-14 * (1 + old.position.cwiseAbs().maxCoeff());
    bool found = false;
    for (auto at =
             std::lower_bound(now.begin(), now.end(), std::array{old.position.x() - rounding, -1e300, 0.0});
         !found && at != now.end() && (*at)[0] <= old.position.x() + rounding; ++at)
      found = std::abs((*at)[1] - old.position.y()) <= rounding &&
              std::abs((*at)[2] - old.position.z()) <= rounding;
    if (!found) return "no vertex is where " + vertex + " was";
  }
  return {};
}

TEST_CASE("a cut lies where the cutter met the cloth and moves nothing, cut after cut on moving cloth") {
  const auto property = [](const std::vector<std::uint8_t>& data) {
    random_cuts::Bytes bytes(data.data(), data.size());
    const random_cuts::Cloth cloth = random_cuts::cloth(bytes);
    cut::HybridMesh mesh = *cut::HybridMesh::build(cloth.mesh);
    cut::Cutter knife(random_cuts::distances(bytes, mesh));
    const cut::MergeDistances& d = knife.distances();
    double unit = 0;  // of the lattice
    for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
      unit = std::max(unit, mesh.ancestors.rest_length(cut::AncestorEdgeId{e}) / cut::lattice_size);
    for (int i = 0; i < 30 && !bytes.empty(); ++i) {
      if (bytes.choice(3) == 0) {
        const double stretch = bytes.number(0.5, 2);
        for (Vector3& p : mesh.positions) {
          p.x() *= stretch;
          for (Eigen::Index axis = 0; axis < 3; ++axis) p[axis] += bytes.number(-0.2, 0.2);
        }
        mesh.moved();
      }
      const cut::TriangleMesh cutter = random_cuts::cutter(bytes, cloth);
      const cut::HybridMesh before = mesh;
      std::vector<Segment> lines;
      RC_ASSERT(met(mesh, cutter, d, lines) == "");
      RC_ASSERT(knife.cut(mesh, cutter).has_value());
      RC_ASSERT(moved(places(before), places(mesh)) == "");
      // An end merged to a node (δc), a chain led aside (2 δe), and rounding; in the middle of an edge one
      // dropped node more (δe).
      const Offsets off = offsets(mesh, before, lines, d.edge);
      RC_ASSERT(off.node <= d.cut + 2 * d.edge + 4 * unit);
      RC_ASSERT(off.edge <= d.cut + 3 * d.edge + 4 * unit);
    }
  };
  check_many(2000, "accuracy", property, 1500);
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

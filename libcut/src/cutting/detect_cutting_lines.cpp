#include "cutting/detect_cutting_lines.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "cutting/clip_to_polygon.hpp"
#include "cutting/intersect_triangles.hpp"
#include "cutting/join_collinear_lines.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

/// The polygons of one ancestor by their fragments.
class PolygonsByFragment {
 public:
  void reset(const Arrangement* arrangement) {
    sorted_.clear();
    if (arrangement == nullptr) return;
    for (std::uint32_t p = 0; p < arrangement->polygons.size(); ++p)
      sorted_.emplace_back(arrangement->polygons[p].triangle, p);
    std::sort(sorted_.begin(), sorted_.end());
  }
  [[nodiscard]] std::uint32_t of(TriangleId triangle) const {
    if (sorted_.empty()) return 0;
    return std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(triangle, 0u))->second;
  }

 private:
  std::vector<std::pair<TriangleId, std::uint32_t>> sorted_;
};

PhysicsFace physics_face(const HybridMesh& mesh, const PhysicsTriangle& triangle) {
  PhysicsFace face;
  for (std::size_t k = 0; k < 3; ++k) {
    face.corners[k] = mesh.positions[triangle.nodes[k].index()];
    face.reversed[k] = mesh.ancestors.reversed(triangle.ancestor, k);
  }
  return face;
}

}  // namespace

double contact_slack(const MergeDistances& distances, const TriangleMesh& cutter) {
  double largest = 0;
  for (const auto& t : cutter.triangles)
    for (const std::uint32_t node : t)
      largest = std::max(largest, cutter.positions[node].cwiseAbs().maxCoeff());
  return std::max(distances.edge * 0x1p-12, largest * 0x1p-46);
}

double farthest_corner(const MergeDistances& distances) { return distances.edge * 0x1p-6 / 0x1p-46; }

Detection detect_cutting_lines(const HybridMesh& mesh, const TriangleMesh& cutter,
                               std::vector<CandidatePair> candidates, double slack,
                               const MergeDistances& distances) {
  std::vector<CutterFace> faces(cutter.triangles.size());
  std::vector<std::uint8_t> has_area(cutter.triangles.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto& t = cutter.triangles[i];
    has_area[i] =
        faces[i].prepare({cutter.positions[t[0]], cutter.positions[t[1]], cutter.positions[t[2]]}) ? 1 : 0;
  }
  // Boxes of slanting triangles are wide: most candidates lie on one side of the cutter's plane.
  std::erase_if(candidates, [&](const CandidatePair& c) {
    if (has_area[c.cutter_triangle] == 0) return true;
    const auto& n = mesh.buffers.triangles[c.triangle.index()].nodes;
    return faces[c.cutter_triangle].misses(
        {mesh.positions[n[0].index()], mesh.positions[n[1].index()], mesh.positions[n[2].index()]}, slack);
  });
  std::sort(candidates.begin(), candidates.end(), [&](const CandidatePair& a, const CandidatePair& b) {
    const AncestorId ancestor_a = mesh.buffers.triangles[a.triangle.index()].ancestor;
    const AncestorId ancestor_b = mesh.buffers.triangles[b.triangle.index()].ancestor;
    return std::tie(ancestor_a, a.triangle, a.cutter_triangle) <
           std::tie(ancestor_b, b.triangle, b.cutter_triangle);
  });

  Detection detection;
  std::vector<LatticePoint> points;
  std::vector<CuttingLine> lines;
  PolygonsByFragment polygons;
  for (std::size_t i = 0; i < candidates.size();) {
    const AncestorId ancestor = mesh.buffers.triangles[candidates[i].triangle.index()].ancestor;
    const Arrangement* arrangement = mesh.arrangement(ancestor);
    lines.clear();
    polygons.reset(arrangement);
    for (; i < candidates.size(); ++i) {
      const PhysicsTriangle& triangle = mesh.buffers.triangles[candidates[i].triangle.index()];
      if (triangle.ancestor != ancestor) break;
      intersect(physics_face(mesh, triangle), faces[candidates[i].cutter_triangle], slack, points);
      if (points.size() < 2) continue;
      const std::uint32_t polygon = polygons.of(candidates[i].triangle);
      for (std::size_t k = 0; k + 1 < points.size(); ++k)
        lines.push_back({polygon, {points[k]}, {points[k + 1]}});
    }
    if (lines.empty()) continue;
    join_collinear_lines(lines);
    for (const CuttingLine& l : lines) detection.lines.push_back({ancestor, l.a.point, l.b.point});
    TriangleWork work = make_work(mesh, ancestor, distances);
    if (arrangement != nullptr && arrangement->polygons.size() > 1) {
      for (const CuttingLine& l : lines)
        clip_to_polygon(work.before, l.polygon, l.a.point, l.b.point, work.lines);
    } else {
      work.lines = lines;
    }
    if (!work.lines.empty()) detection.works.push_back(std::move(work));
  }
  auto& found = detection.lines;
  lattice::sort_unique(found);
  return detection;
}

}  // namespace cut

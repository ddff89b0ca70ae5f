#include "cutting/detect_cutting_lines.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

#include "cutting/clip_to_polygon.hpp"
#include "cutting/in_parts.hpp"
#include "cutting/intersect_triangles.hpp"
#include "cutting/join_collinear_lines.hpp"

namespace cut {
namespace {

/// The polygons of one ancestor by their fragments.
class PolygonsByFragment {
 public:
  explicit PolygonsByFragment(const Arrangement* arrangement) {
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

/// @param candidates those of one ancestor, sorted
/// @param work stays without lines when none of them cuts
/// @param all gets the lines before they are clipped
void detect_on_ancestor(const HybridMesh& mesh, const std::vector<CutterFace>& faces,
                        std::span<const CandidatePair> candidates, double slack,
                        const MergeDistances& distances, TriangleWork& work, std::vector<DetectedLine>& all) {
  const AncestorId ancestor = candidates[0].ancestor;
  const Arrangement* arrangement = mesh.arrangement(ancestor);
  PolygonsByFragment polygons(arrangement);
  std::vector<LatticePoint> points;
  std::vector<CuttingLine> lines;
  for (const CandidatePair& c : candidates) {
    intersect(physics_face(mesh, mesh.buffers.triangles[c.triangle.index()]), faces[c.cutter_triangle], slack,
              points);
    if (points.size() < 2) continue;
    const std::uint32_t polygon = polygons.of(c.triangle);
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      lines.push_back({polygon, {points[k]}, {points[k + 1]}});
  }
  if (lines.empty()) return;
  join_collinear_lines(lines);
  for (const CuttingLine& l : lines) all.push_back({ancestor, l.a.point, l.b.point});
  work = make_work(mesh, ancestor, distances);
  if (arrangement != nullptr && arrangement->polygons.size() > 1) {
    for (const CuttingLine& l : lines)
      clip_to_polygon(work.before, l.polygon, l.a.point, l.b.point, work.lines);
  } else {
    work.lines = std::move(lines);
  }
}

}  // namespace

PhysicsFace physics_face(const HybridMesh& mesh, const PhysicsTriangle& triangle) {
  PhysicsFace face;
  for (std::size_t k = 0; k < 3; ++k) {
    face.corners[k] = mesh.positions[triangle.nodes[k].index()];
    face.reversed[k] = mesh.ancestors.reversed(triangle.ancestor, k);
  }
  return face;
}

double contact_slack(const MergeDistances& distances, const TriangleMesh& cutter) {
  double largest = 0;
  for (const auto& t : cutter.triangles)
    for (const std::uint32_t node : t)
      largest = std::max(largest, cutter.positions[node].cwiseAbs().maxCoeff());
  return std::max(distances.edge * 0x1p-12, largest * 0x1p-46);
}

double farthest_corner(const MergeDistances& distances) { return distances.edge * 0x1p-6 / 0x1p-46; }

Detection detect_cutting_lines(const HybridMesh& mesh, const TriangleMesh& cutter,
                               std::span<const CandidatePair> candidates, double slack,
                               const MergeDistances& distances, const Executor& executor) {
  std::vector<CutterFace> faces(cutter.triangles.size());
  std::vector<std::uint8_t> has_area(cutter.triangles.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto& t = cutter.triangles[i];
    has_area[i] =
        faces[i].prepare({cutter.positions[t[0]], cutter.positions[t[1]], cutter.positions[t[2]]}) ? 1 : 0;
  }
  // Boxes of slanting triangles are wide: most candidates lie on one side of the cutter's plane.
  const auto may_meet = [&](const CandidatePair& c) {
    const auto& n = mesh.buffers.triangles[c.triangle.index()].nodes;
    return has_area[c.cutter_triangle] != 0 &&
           !faces[c.cutter_triangle].misses(
               {mesh.positions[n[0].index()], mesh.positions[n[1].index()], mesh.positions[n[2].index()]},
               slack);
  };
  std::vector<CandidatePair> pairs;
  for (const auto& part : in_parts<std::vector<CandidatePair>>(
           executor, candidates.size(), [&](std::size_t i, std::vector<CandidatePair>& meet) {
             if (may_meet(candidates[i])) meet.push_back(candidates[i]);
           }))
    append(pairs, part);
  if (!std::ranges::is_sorted(pairs)) std::ranges::sort(pairs);

  std::vector<std::size_t> first;  // where each ancestor's candidates begin
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (i == 0 || pairs[i].ancestor != pairs[i - 1].ancestor) first.push_back(i);
  std::vector<TriangleWork> works(first.size());
  Detection detection;
  for (const auto& part : in_parts<std::vector<DetectedLine>>(
           executor, first.size(),
           [&](std::size_t k, std::vector<DetectedLine>& lines) {
             const std::size_t end = k + 1 < first.size() ? first[k + 1] : pairs.size();
             detect_on_ancestor(mesh, faces, {pairs.data() + first[k], end - first[k]}, slack, distances,
                                works[k], lines);
           },
           1))
    append(detection.lines, part);
  detection.works = std::move(works);
  std::erase_if(detection.works, [](const TriangleWork& work) { return work.lines.empty(); });
  if (!std::ranges::is_sorted(detection.lines)) std::ranges::sort(detection.lines);
  const auto repeated = std::ranges::unique(detection.lines);
  detection.lines.erase(repeated.begin(), repeated.end());
  return detection;
}

}  // namespace cut

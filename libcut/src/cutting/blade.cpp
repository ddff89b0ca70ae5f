// The sweep of a Blade (docs/cutting.md, "A blade in moving cloth"). In: the blade's old and new place, and
// the points of the material that it pierced. Out: triangles for the Cutter, and the points that it pierces
// now.
#include "cut/blade.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "cutting/cutter_memory.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "cutting/intersect_triangles.hpp"
#include "lattice/orientation.hpp"

namespace cut {
namespace {

using Path = std::vector<Eigen::Vector3d>;
using Tip = Blade::Tip;

Eigen::Vector3d position(const HybridMesh& mesh, const Tip& tip) {
  return mesh.position(
      RenderVertex{tip.triangle, mesh.buffers.triangles[tip.triangle.index()].nodes, tip.point});
}

/// Where the tip's point of the material was; nothing when a node of its triangle is younger.
std::optional<Eigen::Vector3d> position_in(const Path& positions, const HybridMesh& mesh, const Tip& tip) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto& nodes = mesh.buffers.triangles[tip.triangle.index()].nodes;
  for (std::size_t i = 0; i < 3; ++i) {
    if (nodes[i].index() >= positions.size()) return std::nullopt;
    sum += positions[nodes[i].index()] * (static_cast<double>(tip.point[i]) / lattice_size);
  }
  return sum;
}

Eigen::Vector3d place_on(const Path& path, const Tip& tip) {
  const Eigen::Vector3d& from = path[tip.segment];
  return from + tip.parameter * (path[tip.segment + 1] - from);
}

/// The point, or its nearest lattice point, lies in the closed render area of this triangle.
bool renders(const HybridMesh& mesh, TriangleId triangle, LatticePoint point) {
  const AncestorId ancestor = mesh.buffers.triangles[triangle.index()].ancestor;
  if (!ancestor.valid()) return false;
  const Arrangement* arrangement = mesh.arrangement(ancestor);
  if (arrangement == nullptr) return true;
  const auto polygon = std::find_if(arrangement->polygons.begin(), arrangement->polygons.end(),
                                    [&](const RenderPolygon& p) { return p.triangle == triangle; });
  bool inside = false;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : polygon->loop_ends) {
    for (std::uint32_t i = begin, j = end - 1; i < end; j = i++) {
      LatticePoint a = arrangement->nodes[polygon->corners[j].node].point;
      LatticePoint b = arrangement->nodes[polygon->corners[i].node].point;
      if (lattice::on_segment(a, b, point)) return true;
      if ((a.y > point.y) == (b.y > point.y)) continue;
      if (a.y > b.y) std::swap(a, b);
      if (lattice::orientation(a, b, point) > 0) inside = !inside;
    }
    begin = end;
  }
  return inside;
}

/// Another cut may have divided the triangle of a tip: the part that the tip is on.
void follow_cuts(const HybridMesh& mesh, Tip& tip) {
  const AncestorId ancestor = mesh.buffers.triangles[tip.triangle.index()].ancestor;
  if (!ancestor.valid() || renders(mesh, tip.triangle, tip.point)) return;
  for (std::size_t p = 0; p < mesh.fragment_count(ancestor); ++p)
    if (const TriangleId part = mesh.fragment(ancestor, p); renders(mesh, part, tip.point)) {
      tip.triangle = part;
      return;
    }
}

/// One point of the blade before and after its way.
struct Way {
  double along;  ///< point number, tips in between
  Eigen::Vector3d from, to;
};

/// Where the cloth is known to have moved by `drift` since the blade was at its old place.
struct Drift {
  double along;
  Eigen::Vector3d drift;
};

/// Between two places that are known the drift changes evenly, beyond them it is that of the last one.
Eigen::Vector3d drift_at(const std::vector<Drift>& known, double along) {
  if (known.empty()) return Eigen::Vector3d::Zero();
  const auto next =
      std::find_if(known.begin(), known.end(), [&](const Drift& d) { return d.along >= along; });
  if (next == known.end()) return known.back().drift;
  if (next == known.begin()) return next->drift;
  const Drift& last = *(next - 1);
  return last.drift + (next->drift - last.drift) * ((along - last.along) / (next->along - last.along));
}

double along(const Tip& tip) { return tip.segment + tip.parameter; }

/// The new places where the blade pierces the cloth without having been there before: each old tip takes the
/// nearest one away.
std::vector<Tip> fresh(const HybridMesh& mesh, const std::vector<Tip>& old_tips, std::vector<Tip> new_tips) {
  for (const Tip& old : old_tips) {
    const Eigen::Vector3d p = position(mesh, old);
    const auto nearest = std::min_element(new_tips.begin(), new_tips.end(), [&](const Tip& a, const Tip& b) {
      return (position(mesh, a) - p).squaredNorm() < (position(mesh, b) - p).squaredNorm();
    });
    if (nearest != new_tips.end()) new_tips.erase(nearest);
  }
  return new_tips;
}

/// The points of the blade and its tips, along it. The old place of each is moved by as much as the cloth has
/// moved there.
std::vector<Way> ways(const HybridMesh& mesh, const std::vector<Tip>& tips, const std::vector<Drift>& known,
                      const Path& before, const Path& after) {
  std::vector<Way> all;
  for (const Tip& tip : tips) all.push_back({along(tip), position(mesh, tip), place_on(after, tip)});
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto at = static_cast<double>(i);
    all.push_back({at, before[i] + drift_at(known, at), after[i]});
  }
  std::stable_sort(all.begin(), all.end(), [](const Way& a, const Way& b) { return a.along < b.along; });
  // A tip at a point of the blade stands for it.
  all.erase(
      std::unique(all.begin(), all.end(), [](const Way& a, const Way& b) { return a.along == b.along; }),
      all.end());
  return all;
}

TriangleMesh sweep(const std::vector<Way>& ways) {
  TriangleMesh cutter;
  for (const Way& way : ways) {
    cutter.positions.push_back(way.from);
    cutter.positions.push_back(way.to);
  }
  for (std::uint32_t i = 0; i + 3 < cutter.positions.size(); i += 2) {
    cutter.triangles.push_back({i, i + 2, i + 3});
    cutter.triangles.push_back({i, i + 3, i + 1});
  }
  return cutter;
}

std::vector<Tip> find_tips(const HybridMesh& mesh, const BroadPhase& broad_phase, const Path& edge,
                           const MergeDistances& distances) {
  TriangleMesh segments{edge, {}};
  for (std::uint32_t i = 0; i + 1 < edge.size(); ++i) segments.triangles.push_back({i, i + 1, i + 1});
  const double slack = contact_slack(distances, segments);
  std::vector<Tip> tips;
  for (const CandidatePair& pair : broad_phase.candidates(mesh, segments, slack)) {
    const std::uint32_t i = pair.cutter_triangle;
    const auto hit = pierce(physics_face(mesh, mesh.buffers.triangles[pair.triangle.index()]), edge[i],
                            edge[i + 1], slack);
    if (hit && renders(mesh, pair.triangle, hit->point))
      tips.push_back({i, hit->parameter, pair.triangle, hit->point});
  }
  std::sort(tips.begin(), tips.end(), [](const Tip& a, const Tip& b) {
    return std::tie(a.segment, a.parameter, a.triangle) < std::tie(b.segment, b.parameter, b.triangle);
  });
  // On an edge or a node several triangles are pierced in one place: the first stands for all.
  tips.erase(std::unique(tips.begin(), tips.end(),
                         [&](const Tip& a, const Tip& b) {
                           return (place_on(edge, a) - place_on(edge, b)).norm() <= slack;
                         }),
             tips.end());
  return tips;
}

}  // namespace

void Blade::lift() {
  edge_.clear();
  tips_.clear();
}

Result<Changes> Blade::cut_to(HybridMesh& mesh, const std::vector<Eigen::Vector3d>& edge) {
  if (edge.size() < 2 || (!edge_.empty() && edge_.size() != edge.size()))
    return Error{Error::Kind::bad_parameter, "a blade has at least two points, and always as many as before",
                 0};
  const BroadPhase& broad_phase = cutter_.memory_->broad_phase;
  TriangleMesh cutter{edge, {}};
  if (!edge_.empty()) {
    std::vector<Tip> tips = tips_;
    // The Cutter names a node that is nowhere.
    std::erase_if(tips, [&](const Tip& tip) { return !position(mesh, tip).allFinite(); });
    std::vector<Drift> known;
    for (Tip& tip : tips) {
      follow_cuts(mesh, tip);
      known.push_back({along(tip), position(mesh, tip) - place_on(edge_, tip)});
    }
    for (const Tip& tip : fresh(mesh, tips, find_tips(mesh, broad_phase, edge, cutter_.distances())))
      if (const auto was = position_in(positions_, mesh, tip))
        known.push_back({along(tip), position(mesh, tip) - *was});
    std::sort(known.begin(), known.end(), [](const Drift& a, const Drift& b) { return a.along < b.along; });
    cutter = sweep(ways(mesh, tips, known, edge_, edge));
  }
  auto changes = cutter_.cut(mesh, cutter);
  if (!changes) return changes;
  edge_ = edge;
  tips_ = find_tips(mesh, broad_phase, edge, cutter_.distances());
  positions_ = mesh.positions;
  return changes;
}

}  // namespace cut

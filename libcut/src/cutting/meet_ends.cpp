#include "cutting/meet_ends.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "cutting/merge_across_edges.hpp"
#include "lattice/components.hpp"
#include "lattice/plane.hpp"
#include "mesh/sections.hpp"
#include "spatial/point_cluster_dictionary.hpp"

namespace cut {
namespace {

using On = LineEnd::On;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a SeenEnd is an end of.
struct Whose {
  std::size_t work;
  std::uint32_t line;  ///< counted over all works
  LineEnd* end;
  LineEnd* other;  ///< of the same line
};

struct Ends {
  std::vector<SeenEnd> seen;  ///< by ancestor
  std::vector<Whose> whose;
  std::size_t lines = 0;
};

/// All ends that were detected inside of their triangles.
Ends ends_inside(std::vector<TriangleWork>& works) {
  Ends ends;
  for (std::size_t w = 0; w < works.size(); ++w)
    for (CuttingLine& line : works[w].lines) {
      for (LineEnd* end : {&line.a, &line.b})
        if (end->inside) {
          ends.seen.push_back({works[w].ancestor, line.polygon, end->detected, *end});
          ends.whose.push_back(
              {w, static_cast<std::uint32_t>(ends.lines), end, end == &line.a ? &line.b : &line.a});
        }
      ++ends.lines;
    }
  return ends;
}

/// Where lines of neighbouring triangles have the same end.
struct Place {
  enum class In : std::uint8_t { triangle, edge, node };
  In in;
  std::uint32_t index;
  LatticePoint point;
  auto operator<=>(const Place&) const = default;
};

Place place(const HybridMesh& mesh, AncestorId t, LatticePoint p) {
  const Ancestor& ancestor = mesh.ancestors.triangles[t.index()];
  if (const std::size_t corner = corner_of(p); corner < 3)
    return {Place::In::node, ancestor.nodes[corner].value, {}};
  const std::size_t side = edge_of(p);
  if (side == 3) return {Place::In::triangle, t.value, p};
  return {Place::In::edge, ancestor.edges[side].value, {along_edge(mesh.ancestors, t, side, p), 0}};
}

/// Which ends are tips, and which of them are ends of the same chain of lines.
void find_tips(const HybridMesh& mesh, const std::vector<TriangleWork>& works, Ends& ends) {
  std::vector<std::pair<Place, std::uint32_t>> places;
  places.reserve(2 * ends.lines);
  std::uint32_t number = 0;
  for (const TriangleWork& work : works)
    for (const CuttingLine& line : work.lines) {
      places.emplace_back(place(mesh, work.ancestor, line.a.detected), number);
      places.emplace_back(place(mesh, work.ancestor, line.b.detected), number++);
    }
  std::sort(places.begin(), places.end());
  lattice::Components chains(ends.lines);
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].first == places[i - 1].first) chains.join(places[i].second, places[i - 1].second);
  for (std::size_t i = 0; i < ends.seen.size(); ++i) {
    SeenEnd& end = ends.seen[i];
    const Place here = place(mesh, end.ancestor, end.detected);
    end.tip = std::ranges::equal_range(places, here, {}, &std::pair<Place, std::uint32_t>::first).size() == 1;
    end.chain = chains.root(ends.whose[i].line);
  }
}

/// Less: stays rather than follows. A line that is led to a node across an edge is as good as at it.
int rank(const LineEnd& end) {
  if (end.on == On::node || end.passes) return 0;
  return end.on == On::nothing ? 2 : 1;
}

class Meeting {
 public:
  Meeting(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context)
      : mesh_(mesh), works_(works), context_(context), ends_(ends_inside(works)) {}

  void run() {
    if (std::ranges::any_of(ends_.seen, [](const SeenEnd& end) { return end.target.on != On::nothing; }))
      find_tips(mesh_, works_, ends_);
    std::vector<std::size_t> order(ends_.seen.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(rank(ends_.seen[a].target), a) < std::pair(rank(ends_.seen[b].target), b);
    });
    bool alone = true;
    for (const std::size_t i : order) {
      SeenEnd& seen = ends_.seen[i];
      if (!seen.tip && seen.target.on != On::nothing) continue;
      if (!alone && !seen.target.passes) follow(i);
      seen.target = *ends_.whose[i].end;
      settle(i);
      alone = false;
    }
  }

 private:
  /// Shows an end to others. Of many in one place a few will do, and make no square of their number.
  void settle(std::size_t i) {
    const SeenEnd& seen = ends_.seen[i];
    const TriangleWork& work = works_[ends_.whose[i].work];
    const lattice::PlanePoint at = in_plane(lattice::laid_out(work.metric), seen.detected);
    Shown& shown =
        shown_.try_emplace({ends_.whose[i].work, seen.polygon}, work.distances.node / 32).first->second;
    if (shown.insert_or_merge({at.x, at.y}, true).inserted) settled_[seen.ancestor].push_back(seen);
  }

  void follow(std::size_t i) {
    const SeenEnd& seen = ends_.seen[i];
    const Whose& whose = ends_.whose[i];
    TriangleWork& work = works_[whose.work];
    const Target own = nearest_target(i);
    Neighbourhood& neighbourhood =
        neighbourhoods_.try_emplace(whose.work, mesh_, work, context_).first->second;
    auto across = neighbourhood.nearest_end(seen, whose.other->detected, settled_);
    // Nothing would be left of the line.
    if (across && across->way.empty() && across->exit.point == whose.other->point) across.reset();
    if (across && across->distance < own.distance && across->distance < distance_to_free_end(i)) {
      lead_across(std::move(*across), *whose.end, work);
    } else if (own.distance < infinity) {
      *whose.end = own.end;
      whose.end->detected = seen.detected;
      whose.end->inside = true;
    }
  }

  struct Target {
    LineEnd end;
    double distance = infinity;
  };

  /// Where the nearest other tip of the same polygon goes.
  [[nodiscard]] Target nearest_target(std::size_t i) const {
    const SeenEnd& seen = ends_.seen[i];
    const TriangleWork& work = works_[ends_.whose[i].work];
    Target best;
    const auto ends = settled_.find(seen.ancestor);
    if (!seen.tip || ends == settled_.end()) return best;
    for (const SeenEnd& other : ends->second) {
      if (other.target.on == On::nothing || !sees(seen, other) || other.polygon != seen.polygon ||
          other.target.point == ends_.whose[i].other->point)
        continue;
      const double distance = work.metric.length(seen.detected, other.detected);
      if (distance > work.distances.node || best.distance <= distance ||
          work.metric.length(seen.detected, other.target.point) > work.distances.cut ||
          !visible(seen.detected, other.target.point, work.before.edges,
                   [&](std::uint32_t n) { return work.before.nodes[n].point; }))
        continue;
      best = {other.target, distance};
    }
    return best;
  }

  /// From a free end to the nearest other one of the same polygon.
  [[nodiscard]] double distance_to_free_end(std::size_t i) const {
    const SeenEnd& seen = ends_.seen[i];
    double nearest = infinity;
    if (seen.target.on != On::nothing) return nearest;
    for (const SeenEnd& other : std::ranges::equal_range(ends_.seen, seen.ancestor, {}, &SeenEnd::ancestor))
      if (other.polygon == seen.polygon && other.target.on == On::nothing &&
          other.target.point != seen.target.point)
        nearest = std::min(nearest,
                           works_[ends_.whose[i].work].metric.length(other.target.point, seen.target.point));
    return nearest;
  }

  const HybridMesh& mesh_;
  std::vector<TriangleWork>& works_;
  const CutContext& context_;
  Ends ends_;
  std::map<std::size_t, Neighbourhood> neighbourhoods_;  ///< of works
  using Shown = spatial::PointClusterDictionary<double, 2, bool>;
  std::map<std::pair<std::size_t, std::uint32_t>, Shown> shown_;  ///< of works and their polygons
  SettledEnds settled_;
};

}  // namespace

void meet_ends(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context) {
  Meeting(mesh, works, context).run();
}

}  // namespace cut

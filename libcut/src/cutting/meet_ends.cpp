#include "cutting/meet_ends.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "cutting/merge_across_edges.hpp"
#include "lattice/plane.hpp"

namespace cut {
namespace {

using On = LineEnd::On;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a SeenEnd is an end of.
struct Whose {
  std::size_t work;
  LineEnd* end;
  LineEnd* other;  ///< of the same line
};

struct Ends {
  std::vector<SeenEnd> seen;  ///< by ancestor
  std::vector<Whose> whose;
};

/// All ends that were detected inside of their triangles.
Ends ends_inside(std::vector<TriangleWork>& works) {
  Ends ends;
  std::vector<std::tuple<std::uint32_t, LatticePoint>> places;
  for (std::size_t w = 0; w < works.size(); ++w) {
    const std::size_t first = ends.seen.size();
    for (CuttingLine& line : works[w].lines)
      for (LineEnd* end : {&line.a, &line.b})
        if (end->inside) {
          ends.seen.push_back({works[w].ancestor, line.polygon, end->detected, *end, false});
          ends.whose.push_back({w, end, end == &line.a ? &line.b : &line.a});
        }
    places.clear();
    for (std::size_t i = first; i < ends.seen.size(); ++i)
      places.emplace_back(ends.seen[i].polygon, ends.seen[i].detected);
    std::sort(places.begin(), places.end());
    for (std::size_t i = first; i < ends.seen.size(); ++i) {
      const auto same =
          std::ranges::equal_range(places, std::tuple(ends.seen[i].polygon, ends.seen[i].detected));
      ends.seen[i].tip = same.size() == 1;
    }
  }
  return ends;
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
    std::vector<std::size_t> order(ends_.seen.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return rank(ends_.seen[a].target) < rank(ends_.seen[b].target);
    });
    bool alone = true;
    for (const std::size_t i : order) {
      SeenEnd& seen = ends_.seen[i];
      if (!seen.tip && seen.target.on != On::nothing) continue;
      if (!alone && !seen.target.passes) follow(i);
      seen.target = *ends_.whose[i].end;
      seen.settled = true;
      alone = false;
    }
  }

 private:
  void follow(std::size_t i) {
    const SeenEnd& seen = ends_.seen[i];
    const Whose& whose = ends_.whose[i];
    TriangleWork& work = works_[whose.work];
    const Target own = nearest_target(i);
    Neighbourhood& neighbourhood =
        neighbourhoods_.try_emplace(whose.work, mesh_, work, context_).first->second;
    auto across =
        neighbourhood.nearest_end(seen.detected, whose.other->detected, seen.polygon, seen.tip, ends_.seen);
    // Nothing would be left of the line.
    if (across && across->way.empty() && across->exit.point == whose.other->point) across.reset();
    if (across && across->distance < std::min(own.distance, distance_to_free_end(i))) {
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
    if (!seen.tip) return best;
    for (const SeenEnd& other : of_work(i)) {
      if (!other.settled || !other.tip || other.target.on == On::nothing || other.polygon != seen.polygon ||
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
    for (const SeenEnd& other : of_work(i))
      if (other.polygon == seen.polygon && other.target.on == On::nothing &&
          other.target.point != seen.target.point)
        nearest = std::min(nearest,
                           works_[ends_.whose[i].work].metric.length(other.target.point, seen.target.point));
    return nearest;
  }

  [[nodiscard]] std::ranges::subrange<std::vector<SeenEnd>::const_iterator> of_work(std::size_t i) const {
    return std::ranges::equal_range(ends_.seen, ends_.seen[i].ancestor, {}, &SeenEnd::ancestor);
  }

  const HybridMesh& mesh_;
  std::vector<TriangleWork>& works_;
  const CutContext& context_;
  Ends ends_;
  std::map<std::size_t, Neighbourhood> neighbourhoods_;  ///< of works
};

}  // namespace

void meet_ends(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context) {
  Meeting(mesh, works, context).run();
}

}  // namespace cut

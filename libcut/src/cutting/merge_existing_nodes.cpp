#include "cutting/merge_existing_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace cut {
namespace {

constexpr double drift_limit = 2;  // in δe

struct Chain {
  const TriangleWork& work;
  std::span<const std::uint32_t> candidates;
  LatticePoint line_from;
  LatticePoint line_to;
  double reach;
  std::vector<std::uint32_t> nodes;

  [[nodiscard]] LatticePoint point(std::uint32_t n) const { return work.graph.points[n]; }

  [[nodiscard]] bool within_reach(std::uint32_t n, LatticePoint a, LatticePoint b, double& parameter) const {
    const auto d = work.metric.distance_to_segment(point(n), a, b);
    parameter = d.parameter;
    if (!(d.squared <= reach * reach) || d.parameter <= 0 || d.parameter >= 1) return false;
    const double limit = drift_limit * reach;
    if (work.metric.distance_to_segment(point(n), line_from, line_to).squared > limit * limit) return false;
    const LatticePoint foot{static_cast<std::int32_t>(std::floor(a.x + d.parameter * (b.x - a.x) + 0.5)),
                            static_cast<std::int32_t>(std::floor(a.y + d.parameter * (b.y - a.y) + 0.5))};
    return visible(foot, point(n), work.graph.edges, [&](std::uint32_t i) { return point(i); });
  }

  /// Inserts nodes between nodes[at] and nodes[at + 1].
  void refine(std::size_t at) {
    const LatticePoint a = point(nodes[at]);
    const LatticePoint b = point(nodes[at + 1]);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (const std::uint32_t n : candidates) {
      double parameter = 0;
      if (std::find(nodes.begin(), nodes.end(), n) != nodes.end() || !within_reach(n, a, b, parameter))
        continue;
      found.emplace_back(parameter, n);
    }
    if (found.empty()) return;
    std::sort(found.begin(), found.end(), [&](const auto& l, const auto& r) {
      return std::pair(l.first, point(l.second)) < std::pair(r.first, point(r.second));
    });
    const auto before = static_cast<std::ptrdiff_t>(at) + 1;
    for (std::size_t i = found.size(); i-- > 0;) nodes.insert(nodes.begin() + before, found[i].second);
    for (std::size_t i = found.size() + 1; i-- > 0;) refine(at + i);
  }
};

}  // namespace

std::vector<std::uint32_t> merge_existing_nodes(const TriangleWork& work, const PolygonNodes& nodes,
                                                std::uint32_t polygon, std::uint32_t a, std::uint32_t b) {
  Chain chain{work,  nodes.of(polygon), work.graph.points[a], work.graph.points[b], work.distances.edge,
              {a, b}};
  chain.refine(0);
  return std::move(chain.nodes);
}

}  // namespace cut

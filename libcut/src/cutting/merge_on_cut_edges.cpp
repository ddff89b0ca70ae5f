#include "cutting/merge_on_cut_edges.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lattice/orientation.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using lattice::GraphEdge;
using lattice::operator-;
using Index = std::uint32_t;

/// A line end on a cut edge, and how far along it.
struct CutPoint {
  Index edge;
  std::int64_t along;
  LatticePoint point;

  auto operator<=>(const CutPoint&) const = default;
};

/// The new nodes of one edge, in its direction: for each group within δn the point nearest to the group's
/// middle.
std::vector<LatticePoint> group(const CutPoint* begin, const CutPoint* end, const TriangleWork& work) {
  std::vector<LatticePoint> centres;
  for (const CutPoint* p = begin; p != end;) {
    const CutPoint* last = p;
    while (last + 1 != end && work.metric.length(p->point, (last + 1)->point) <= work.distances.node) ++last;
    const std::int64_t middle = p->along + (last->along - p->along) / 2;
    const auto off = [&](const CutPoint& c) {
      return c.along < middle ? middle - c.along : c.along - middle;
    };
    const CutPoint* centre =
        std::min_element(p, last + 1, [&](const CutPoint& a, const CutPoint& b) { return off(a) < off(b); });
    centres.push_back(centre->point);
    p = last + 1;
  }
  return centres;
}

}  // namespace

void merge_on_cut_edges(TriangleWork& work) {
  std::vector<CutPoint> points;
  for (const CuttingLine& line : work.lines)
    for (const LineEnd& end : {line.a, line.b}) {
      if (end.on != LineEnd::On::cut_edge) continue;
      const LatticePoint from = work.graph.points[work.graph.edges[end.index].from];
      const LatticePoint to = work.graph.points[work.graph.edges[end.index].to];
      points.push_back({end.index, lattice::dot(end.point - from, to - from), end.point});
    }
  if (points.empty()) return;
  lattice::sort_unique(points);

  std::vector<std::pair<Index, std::vector<LatticePoint>>> divided;  // by edge
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    while (end < points.size() && points[end].edge == points[i].edge) ++end;
    divided.emplace_back(points[i].edge, group(points.data() + i, points.data() + end, work));
    i = end;
  }
  for (CuttingLine& line : work.lines)
    for (LineEnd* end : {&line.a, &line.b}) {
      if (end->on != LineEnd::On::cut_edge) continue;
      const auto& centres =
          std::lower_bound(divided.begin(), divided.end(), end->index, [](const auto& entry, Index edge) {
            return entry.first < edge;
          })->second;
      const LatticePoint p = end->point;
      end->point = *std::min_element(centres.begin(), centres.end(), [&](LatticePoint a, LatticePoint b) {
        return std::pair(work.metric.squared_length(a - p), a) <
               std::pair(work.metric.squared_length(b - p), b);
      });
    }

  // From the last edge to the first, so that removing one leaves the others where they are. All go before any
  // node comes: a node leads the edges through its cell that are in the graph, and numbers them anew.
  std::vector<GraphEdge> whole;
  for (auto entry = divided.rbegin(); entry != divided.rend(); ++entry) {
    whole.push_back(work.graph.edges[entry->first]);
    work.graph.edges.erase(work.graph.edges.begin() + entry->first);
  }
  std::vector<GraphEdge> parts;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    GraphEdge part = whole[i];
    for (const LatticePoint p : divided[whole.size() - 1 - i].second) {
      part.to = lattice::insert_node(work.graph, p);
      parts.push_back(part);
      part.from = part.to;
    }
    part.to = whole[i].to;
    parts.push_back(part);
  }
  lattice::insert_edges(work.graph, std::move(parts));
}

}  // namespace cut

#include "cutting/merge_adjacent_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cutting/work_graph.hpp"
#include "lattice/orientation.hpp"
#include "lattice/scratch.hpp"

namespace cut {
namespace {

using lattice::GraphEdge;
using Index = std::uint32_t;

class Merger {
 public:
  explicit Merger(TriangleWork& work) : work_(work) {}

  void run() {
    lattice::Scratch scratch;
    lattice::ScratchList<Index> degree(work_.graph.points.size(), 0, &scratch);
    for (const GraphEdge& e : work_.graph.edges)
      for (const Index n : {e.from, e.to}) ++degree[n];
    // In the order of their positions, so that the numbering of nodes does not matter.
    lattice::ScratchList<Index> order(&scratch);
    for (Index n = first_inner_node(work_); n < work_.graph.points.size(); ++n)
      if (work_.rendered[n] == 0 && degree[n] == 2) order.push_back(n);
    if (order.empty()) return;
    lattice::ScratchList<lattice::ScratchList<Index>> edges_at(work_.graph.points.size(), &scratch);
    for (Index i = 0; i < work_.graph.edges.size(); ++i) {
      edges_at[work_.graph.edges[i].from].push_back(i);
      edges_at[work_.graph.edges[i].to].push_back(i);
    }
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return work_.graph.points[a] < work_.graph.points[b]; });
    lattice::ScratchList<std::uint8_t> dropped(work_.graph.edges.size(), 0, &scratch);
    for (const Index n : order) {
      const Index kept = edges_at[n][0];
      const Index gone = edges_at[n][1];
      GraphEdge merged;
      if (!mergeable(n, work_.graph.edges[kept], work_.graph.edges[gone], merged)) continue;
      const bool twice =
          std::any_of(edges_at[merged.from].begin(), edges_at[merged.from].end(), [&](Index e) {
            const GraphEdge& other = work_.graph.edges[e];
            return other.from == merged.to || other.to == merged.to;
          });
      if (twice) continue;
      work_.graph.edges[kept] = merged;
      dropped[gone] = 1;
      edges_at[n].clear();
      for (Index& e : edges_at[merged.to])
        if (e == gone) e = kept;
    }
    Index kept = 0;
    for (Index i = 0; i < dropped.size(); ++i)
      if (dropped[i] == 0) work_.graph.edges[kept++] = work_.graph.edges[i];
    work_.graph.edges.resize(kept);
  }

 private:
  /// Fills `merged` with the edge that replaces first and second, which meet in node n, when all criteria
  /// hold.
  bool mergeable(Index n, GraphEdge first, GraphEdge second, GraphEdge& merged) const {
    if (first.to != n) reverse(first);
    if (second.from != n) reverse(second);
    if (first.left != second.left || first.right != second.right || first.from == second.to) return false;
    const LatticePoint a = work_.graph.points[first.from];
    const LatticePoint b = work_.graph.points[second.to];
    const LatticePoint p = work_.graph.points[n];
    if (common_side(a, b) < 3) return false;
    const auto d = work_.metric.distance_to_segment(p, a, b);
    const double deviation = std::sqrt(d.squared) + std::max(first.deviation, second.deviation);
    if (deviation > work_.distances.edge || d.parameter <= 0 || d.parameter >= 1) return false;
    const double reach = work_.distances.edge * work_.distances.edge;
    for (Index other = 0; other < work_.graph.points.size(); ++other) {
      if (other == n || other == first.from || other == second.to) continue;
      const auto gap = work_.metric.distance_to_segment(work_.graph.points[other], a, b);
      if (gap.squared <= reach && gap.parameter > 0 && gap.parameter < 1) return false;
    }
    for (const GraphEdge& e : work_.graph.edges)
      if (lattice::cross_properly(a, b, work_.graph.points[e.from], work_.graph.points[e.to])) return false;
    merged = first;
    merged.to = second.to;
    merged.deviation = deviation;
    merged.is_new = first.is_new && second.is_new;
    return true;
  }

  static void reverse(GraphEdge& e) {
    std::swap(e.from, e.to);
    std::swap(e.left, e.right);
  }

  TriangleWork& work_;
};

}  // namespace

void merge_adjacent_edges(TriangleWork& work) { Merger(work).run(); }

}  // namespace cut

#include "lattice/planar_graph.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lattice/intersection.hpp"
#include "lattice/orientation.hpp"

namespace cut::lattice {
namespace {

using Index = std::uint32_t;
constexpr Index no_index = 0xffffffffu;

bool boxes_apart(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  return std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
         std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y);
}

/// An edge along a side of the triangle is exact: it is led only through nodes on that side.
bool snaps_to(const PlanarGraph& graph, const GraphEdge& e, Index node) {
  const LatticePoint a = graph.points[e.from];
  const LatticePoint b = graph.points[e.to];
  const LatticePoint p = graph.points[node];
  const unsigned side = sides_of(a) & sides_of(b);
  if (side != 0 && (side & sides_of(p)) == 0) return false;
  return passes_through_cell(a, b, p);
}

std::pair<GraphEdge, GraphEdge> split(const GraphEdge& e, Index node) {
  GraphEdge first = e;
  GraphEdge second = e;
  first.to = node;
  second.from = node;
  return {first, second};
}

class Rounder {
 public:
  explicit Rounder(PlanarGraph& graph) : graph_(graph) {}

  /// Takes the edges that pass through the cell of `node` out again, split at it.
  void lead_edges_through(Index node) {
    const LatticePoint p = graph_.points[node];
    for (std::size_t i = 0; i < graph_.edges.size();) {
      const GraphEdge e = graph_.edges[i];
      const LatticePoint a = graph_.points[e.from];
      const LatticePoint b = graph_.points[e.to];
      const bool near = p.x >= std::min(a.x, b.x) - 1 && p.x <= std::max(a.x, b.x) + 1 &&
                        p.y >= std::min(a.y, b.y) - 1 && p.y <= std::max(a.y, b.y) + 1;
      if (near && e.from != node && e.to != node && snaps_to(graph_, e, node)) {
        remove(i);
        push_split(e, node);
      } else {
        ++i;
      }
    }
  }

  void push(const GraphEdge& e) {
    if (e.from != e.to) todo_.push_back(e);
  }

  /// Each round settles an edge, or splits one or two. Snap rounding ends since a split brings the parts
  /// nearer to their nodes and there are only so many nodes near an edge; the budget is for what that
  /// argument leaves out
  /// (`join`, where a crossing rounds to a point behind an end).
  void run() {
    const std::size_t n = graph_.points.size() + graph_.edges.size() + todo_.size() + 64;
    std::size_t budget = 8 * n * n;
    while (!todo_.empty()) {
      if (budget-- == 0) {
        graph_.complete = false;
        return;
      }
      const GraphEdge e = todo_.back();
      todo_.pop_back();
      if (merged_with_equal(e)) continue;
      if (const Index node = node_on(e); node != no_index) {
        push_split(e, node);
      } else if (const Index other = crossed_by(e); other != no_index) {
        join(e, other);
      } else {
        graph_.edges.push_back(e);
      }
    }
  }

 private:
  void remove(std::size_t i) {
    graph_.edges[i] = graph_.edges.back();
    graph_.edges.pop_back();
  }

  void push_split(const GraphEdge& e, Index node) {
    const auto [first, second] = split(e, node);
    push(first);
    push(second);
  }

  /// When the same two nodes are already joined, lets e vanish in that edge.
  bool merged_with_equal(const GraphEdge& e) {
    for (GraphEdge& old : graph_.edges) {
      const bool same = old.from == e.from && old.to == e.to;
      const bool opposite = old.from == e.to && old.to == e.from;
      if (!same && !opposite) continue;
      if (e.is_new) return true;
      if (old.is_new) {  // what was a cut before stays the older edge
        old = e;
        return true;
      }
      // Two old edges fall together: the polygon between them has vanished.
      const Index left = same ? e.left : e.right;
      const Index right = same ? e.right : e.left;
      if (old.right == left)
        old.right = right;
      else if (old.left == right)
        old.left = left;
      return true;
    }
    return false;
  }

  /// The node whose cell e passes first, seen from e.from.
  [[nodiscard]] Index node_on(const GraphEdge& e) const {
    const LatticePoint a = graph_.points[e.from];
    const LatticePoint b = graph_.points[e.to];
    const std::int32_t min_x = std::min(a.x, b.x) - 1;
    const std::int32_t max_x = std::max(a.x, b.x) + 1;
    const std::int32_t min_y = std::min(a.y, b.y) - 1;
    const std::int32_t max_y = std::max(a.y, b.y) + 1;
    Index best = no_index;
    std::int64_t best_along = 0;
    for (Index n = 0; n < graph_.points.size(); ++n) {
      const LatticePoint p = graph_.points[n];
      if (p.x < min_x || p.x > max_x || p.y < min_y || p.y > max_y || n == e.from || n == e.to) continue;
      if (!snaps_to(graph_, e, n)) continue;
      const std::int64_t along = dot(p - a, b - a);
      if (best != no_index && along >= best_along) continue;
      best = n;
      best_along = along;
    }
    return best;
  }

  [[nodiscard]] Index crossed_by(const GraphEdge& e) const {
    const LatticePoint a = graph_.points[e.from];
    const LatticePoint b = graph_.points[e.to];
    for (Index i = 0; i < graph_.edges.size(); ++i) {
      const LatticePoint c = graph_.points[graph_.edges[i].from];
      const LatticePoint d = graph_.points[graph_.edges[i].to];
      if (!boxes_apart(a, b, c, d) && cross_properly(a, b, c, d)) return i;
    }
    return no_index;
  }

  /// Leads e and the edge that it crosses through their common point.
  void join(const GraphEdge& e, Index other_index) {
    const GraphEdge other = graph_.edges[other_index];
    const LatticePoint p = crossing(graph_.points[e.from], graph_.points[e.to], graph_.points[other.from],
                                    graph_.points[other.to]);
    const auto nodes = static_cast<Index>(graph_.points.size());
    const Index node = find_or_add_node(graph_, p);
    remove(other_index);
    const bool end_of_e = node == e.from || node == e.to;
    const bool end_of_other = node == other.from || node == other.to;
    if (end_of_other && !end_of_e && !passes_through_cell(graph_.points[e.from], graph_.points[e.to], p)) {
      // The crossing rounds to an end of `other` that lies behind an end of e. Leading e through it would
      // lead it back through its own end, again and again: lead `other` through that end of e instead.
      push(e);
      push_split(other, nearer_end(e, p));
    } else if (end_of_e && !end_of_other &&
               !passes_through_cell(graph_.points[other.from], graph_.points[other.to], p)) {
      push_split(e, nearer_end(other, p));
      push(other);
    } else {
      push_split(e, node);
      push_split(other, node);
    }
    if (node == nodes) lead_edges_through(node);
  }

  [[nodiscard]] Index nearer_end(const GraphEdge& e, LatticePoint p) const {
    const Vector from = p - graph_.points[e.from];
    const Vector to = p - graph_.points[e.to];
    return dot(from, from) <= dot(to, to) ? e.from : e.to;
  }

  PlanarGraph& graph_;
  std::vector<GraphEdge> todo_;
};

}  // namespace

std::uint32_t find_or_add_node(PlanarGraph& graph, LatticePoint p) {
  const auto found = std::find(graph.points.begin(), graph.points.end(), p);
  if (found == graph.points.end()) {
    graph.points.push_back(p);
    return static_cast<Index>(graph.points.size() - 1);
  }
  return static_cast<Index>(found - graph.points.begin());
}

std::uint32_t insert_node(PlanarGraph& graph, LatticePoint p) {
  const auto nodes = static_cast<Index>(graph.points.size());
  const Index node = find_or_add_node(graph, p);
  if (node != nodes) return node;
  Rounder rounder(graph);
  rounder.lead_edges_through(node);
  rounder.run();
  return node;
}

void insert_edges(PlanarGraph& graph, std::vector<GraphEdge> new_edges) {
  Rounder rounder(graph);
  for (auto e = new_edges.rbegin(); e != new_edges.rend(); ++e) rounder.push(*e);
  rounder.run();
}

}  // namespace cut::lattice

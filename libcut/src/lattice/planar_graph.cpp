#include "lattice/planar_graph.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lattice/graph_index.hpp"
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
  explicit Rounder(PlanarGraph& graph) : graph_(graph), alive_(graph.edges.size(), 1) {}

  /// Takes the edges that pass through the cell of `node` out again, split at it.
  void lead_edges_through(Index node) {
    const LatticePoint p = graph_.points[node];
    found_.clear();
    for_edges_near(p, p, [&](Index i) {
      const GraphEdge& e = graph_.edges[i];
      const LatticePoint a = graph_.points[e.from];
      const LatticePoint b = graph_.points[e.to];
      const bool near = p.x >= std::min(a.x, b.x) - 1 && p.x <= std::max(a.x, b.x) + 1 &&
                        p.y >= std::min(a.y, b.y) - 1 && p.y <= std::max(a.y, b.y) + 1;
      if (near && e.from != node && e.to != node && snaps_to(graph_, e, node)) found_.push_back(i);
    });
    std::sort(found_.begin(), found_.end());
    for (const Index i : found_) {
      const GraphEdge e = graph_.edges[i];
      remove(i);
      push_split(e, node);
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
    const std::size_t budget = 8 * n * n;
    for (std::size_t round = 0; !todo_.empty(); ++round) {
      if (round == budget) {
        graph_.complete = false;
        return;
      }
      // Many rounds on many edges: from here on the index pays.
      if (round >= 64 && !index_ && graph_.edges.size() + graph_.points.size() > 256) make_index();
      const GraphEdge e = todo_.back();
      todo_.pop_back();
      if (merged_with_equal(e)) continue;
      if (const Index node = node_on(e); node != no_index) {
        push_split(e, node);
      } else if (const Index other = crossed_by(e); other != no_index) {
        join(e, other);
      } else {
        add(e);
      }
    }
    Index kept = 0;
    for (Index i = 0; i < graph_.edges.size(); ++i)
      if (alive_[i] != 0) graph_.edges[kept++] = graph_.edges[i];
    graph_.edges.resize(kept);
    alive_.assign(kept, 1);
    index_.reset();
  }

 private:
  void make_index() {
    index_.emplace();
    for (Index n = 0; n < graph_.points.size(); ++n) index_->add_node(n, graph_.points[n]);
    for (Index i = 0; i < graph_.edges.size(); ++i)
      if (alive_[i] != 0) enter(i);
  }

  void enter(Index i) {
    const GraphEdge& e = graph_.edges[i];
    index_->add_edge(i, e.from, e.to, graph_.points[e.from], graph_.points[e.to]);
  }

  /// Removed edges keep their number until the end of `run`.
  void add(const GraphEdge& e) {
    graph_.edges.push_back(e);
    alive_.push_back(1);
    if (index_) enter(static_cast<Index>(graph_.edges.size() - 1));
  }

  void remove(Index i) {
    alive_[i] = 0;
    if (index_) index_->remove_edge(i, graph_.edges[i].from, graph_.edges[i].to);
  }

  template <class Visit>
  void for_edges_near(LatticePoint a, LatticePoint b, const Visit& visit) const {
    if (index_) return index_->edges_near(a, b, visit);
    for (Index i = 0; i < graph_.edges.size(); ++i)
      if (alive_[i] != 0) visit(i);
  }

  template <class Visit>
  void for_nodes_near(LatticePoint a, LatticePoint b, const Visit& visit) const {
    if (index_) return index_->nodes_near(a, b, visit);
    for (Index n = 0; n < graph_.points.size(); ++n) visit(n);
  }

  void push_split(const GraphEdge& e, Index node) {
    const auto [first, second] = split(e, node);
    push(first);
    push(second);
  }

  [[nodiscard]] Index edge_between(Index from, Index to) const {
    if (index_) return index_->edge_between(from, to).value_or(no_index);
    for (Index i = 0; i < graph_.edges.size(); ++i) {
      const GraphEdge& e = graph_.edges[i];
      if (alive_[i] != 0 && ((e.from == from && e.to == to) || (e.from == to && e.to == from))) return i;
    }
    return no_index;
  }

  /// When the same two nodes are already joined, lets e vanish in that edge.
  bool merged_with_equal(const GraphEdge& e) {
    const Index i = edge_between(e.from, e.to);
    if (i == no_index) return false;
    GraphEdge& old = graph_.edges[i];
    if (e.is_new) return true;
    if (old.is_new) {  // what was a cut before stays the older edge
      old = e;
      return true;
    }
    // Two old edges fall together: the polygon between them has vanished.
    const bool same = old.from == e.from;
    const Index left = same ? e.left : e.right;
    const Index right = same ? e.right : e.left;
    if (old.right == left)
      old.right = right;
    else if (old.left == right)
      old.left = left;
    return true;
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
    for_nodes_near(a, b, [&](Index n) {
      const LatticePoint p = graph_.points[n];
      if (p.x < min_x || p.x > max_x || p.y < min_y || p.y > max_y || n == e.from || n == e.to) return;
      if (!snaps_to(graph_, e, n)) return;
      const std::int64_t along = dot(p - a, b - a);
      if (best != no_index && std::pair(along, n) >= std::pair(best_along, best)) return;
      best = n;
      best_along = along;
    });
    return best;
  }

  /// The first edge, by number, that e crosses.
  [[nodiscard]] Index crossed_by(const GraphEdge& e) const {
    const LatticePoint a = graph_.points[e.from];
    const LatticePoint b = graph_.points[e.to];
    Index first = no_index;
    for_edges_near(a, b, [&](Index i) {
      if (i >= first) return;
      const LatticePoint c = graph_.points[graph_.edges[i].from];
      const LatticePoint d = graph_.points[graph_.edges[i].to];
      if (!boxes_apart(a, b, c, d) && cross_properly(a, b, c, d)) first = i;
    });
    return first;
  }

  /// Leads e and the edge that it crosses through their common point.
  void join(const GraphEdge& e, Index other_index) {
    const GraphEdge other = graph_.edges[other_index];
    const LatticePoint p = crossing(graph_.points[e.from], graph_.points[e.to], graph_.points[other.from],
                                    graph_.points[other.to]);
    const auto nodes = static_cast<Index>(graph_.points.size());
    const Index node = node_at(p);
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

  Index node_at(LatticePoint p) {
    if (!index_) return find_or_add_node(graph_, p);
    if (const auto node = index_->node_at(p)) return *node;
    const auto node = static_cast<Index>(graph_.points.size());
    graph_.points.push_back(p);
    index_->add_node(node, p);
    return node;
  }

  [[nodiscard]] Index nearer_end(const GraphEdge& e, LatticePoint p) const {
    const Vector from = p - graph_.points[e.from];
    const Vector to = p - graph_.points[e.to];
    return dot(from, from) <= dot(to, to) ? e.from : e.to;
  }

  PlanarGraph& graph_;
  std::vector<std::uint8_t> alive_;  ///< per edge
  std::vector<GraphEdge> todo_;
  std::optional<GraphIndex> index_;
  std::vector<Index> found_;  ///< of lead_edges_through
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

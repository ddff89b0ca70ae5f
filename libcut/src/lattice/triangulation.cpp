// Ear clipping in exact arithmetic. Steps: link the corners into rings so that corners at one position have
// disjoint wedges, join each hole to what lies left of it, clip ears, flip edges.
//
// Why it cannot fail: a ring bounds an open disc (its interior is connected and has no hole left). It has a
// triangulation by diagonals, straight corners included, and the leaves of the dual tree are ears: corners
// whose triangle is strictly positive and whose diagonal runs in the open interior. Clipping one leaves a
// smaller ring of the same kind. A corner that is no ear becomes one only if one of its neighbours is
// clipped, so each corner is tested once and after each change beside it.
#include "lattice/triangulation.hpp"

#include <algorithm>

#include "lattice/flips.hpp"

namespace cut::lattice {
namespace {

/// The loops divide the points, and no coordinate is so large that a predicate could overflow.
bool readable(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends) {
  const auto in_range = [](LatticePoint p) {
    return p.x >= 0 && p.x <= lattice_size && p.y >= 0 && p.y <= lattice_size;
  };
  return !loop_ends.empty() && loop_ends.back() == points.size() &&
         std::is_sorted(loop_ends.begin(), loop_ends.end()) &&
         std::all_of(points.begin(), points.end(), in_range);
}

class EarClipper {
 public:
  EarClipper(TriangulationScratch& scratch, std::vector<std::array<std::uint32_t, 3>>& triangles)
      : scratch_(scratch), nodes_(scratch.nodes), triangles_(triangles) {}

  bool run(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends);

 private:
  using Node = TriangulationScratch::Node;
  using Spoke = TriangulationScratch::Spoke;

  bool link_loops(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends);
  void separate_wedges();
  void separate_wedges_at(std::span<const std::uint32_t> group);
  void sort_rings();
  bool join_hole(std::uint32_t hole);
  std::uint32_t edge_left_of(LatticePoint q) const;
  std::uint32_t visible_node(LatticePoint q, std::uint32_t edge) const;
  bool clip_ears();
  bool is_ear(std::uint32_t v) const;
  void clip(std::uint32_t v);
  void consume_edge(std::uint32_t node, std::uint32_t half_edge);
  void enqueue(std::uint32_t node);
  void drop_if_convex(std::uint32_t node);

  [[nodiscard]] LatticePoint at(std::uint32_t node) const { return nodes_[node].at; }
  [[nodiscard]] LatticePoint next_at(std::uint32_t node) const { return at(nodes_[node].next); }
  [[nodiscard]] LatticePoint previous_at(std::uint32_t node) const { return at(nodes_[node].previous); }
  /// True when p lies strictly inside the wedge of the node.
  [[nodiscard]] bool looks_at(std::uint32_t node, LatticePoint p) const {
    return strictly_between(next_at(node) - at(node), p - at(node), previous_at(node) - at(node));
  }
  [[nodiscard]] bool strictly_convex(std::uint32_t node) const {
    return orientation(previous_at(node), at(node), next_at(node)) > 0;
  }
  void connect(std::uint32_t from, std::uint32_t to) {
    nodes_[from].next = to;
    nodes_[to].previous = from;
  }
  std::uint32_t add_node(LatticePoint point, std::uint32_t corner) {
    nodes_.push_back({point, corner, no_index, no_index, no_index, no_index, no_index, no_index});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  TriangulationScratch& scratch_;
  std::vector<Node>& nodes_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
};

bool EarClipper::run(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends) {
  if (!readable(points, loop_ends)) return false;
  bool complete = link_loops(points, loop_ends);
  separate_wedges();
  sort_rings();
  for (const std::uint32_t hole : scratch_.holes) complete &= join_hole(hole);
  return clip_ears() && complete;
}

/// An edge without length has no direction: its start is left out, and the answer is false.
bool EarClipper::link_loops(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends) {
  std::uint32_t begin = 0;
  for (const std::uint32_t end : loop_ends) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    for (std::uint32_t i = begin; i < end; ++i)
      if (points[i] != points[i + 1 == end ? begin : i + 1]) add_node(points[i], i);
    const auto last = static_cast<std::uint32_t>(nodes_.size());
    for (std::uint32_t node = first; node < last; ++node) connect(node, node + 1 == last ? first : node + 1);
    begin = end;
  }
  return nodes_.size() == points.size();
}

void EarClipper::separate_wedges() {
  auto& order = scratch_.order;
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) order.push_back(node);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && at(order[end]) == at(order[i])) ++end;
    if (end - i > 1) separate_wedges_at(std::span(order).subspan(i, end - i));
    i = end;
  }
}

/// Several nodes at one position: walks around the position and lets each edge that leaves follow the edge
/// that arrives next, counterclockwise. Then the wedges are disjoint, and loops that touch are one.
void EarClipper::separate_wedges_at(std::span<const std::uint32_t> group) {
  auto& spokes = scratch_.spokes;
  spokes.clear();
  for (const std::uint32_t node : group) {
    spokes.push_back({next_at(node) - at(node), false, node});
    spokes.push_back({previous_at(node) - at(node), true, nodes_[node].previous});
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    if (angle_less(a.direction, b.direction)) return true;
    if (angle_less(b.direction, a.direction)) return false;
    return a.incoming != b.incoming ? a.incoming : a.node < b.node;
  });
  const auto follower = [&](std::size_t i) -> const Spoke& {
    return spokes[i + 1 == spokes.size() ? 0 : i + 1];
  };
  for (std::size_t i = 0; i < spokes.size(); ++i)
    if (spokes[i].incoming == follower(i).incoming) return;  // loops that cross: keep them as they are
  for (std::size_t i = 0; i < spokes.size(); ++i)
    if (!spokes[i].incoming) connect(follower(i).node, spokes[i].node);
}

/// Finds the rings. A hole is represented by its lexicographically smallest node; holes are sorted by it.
void EarClipper::sort_rings() {
  constexpr std::uint32_t visited = 0;
  for (std::uint32_t start = 0; start < nodes_.size(); ++start) {
    if (nodes_[start].ticket == visited) continue;
    std::uint64_t doubled_area = 0;  // unsigned: partial sums may wrap, the result fits
    std::uint32_t smallest = start, node = start;
    do {
      nodes_[node].ticket = visited;
      doubled_area += static_cast<std::uint64_t>(orientation(at(start), at(node), next_at(node)));
      if (at(node) < at(smallest)) smallest = node;
      node = nodes_[node].next;
    } while (node != start);
    if (static_cast<std::int64_t>(doubled_area) > 0)
      scratch_.hulls.push_back(start);
    else
      scratch_.holes.push_back(smallest);
  }
  std::sort(scratch_.holes.begin(), scratch_.holes.end(),
            [&](std::uint32_t a, std::uint32_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
}

/// Joins a hole by a double edge to a node left of it. All that is left of its smallest point q belongs to
/// the hull or to a hole that has been joined before, because holes are joined from left to right.
bool EarClipper::join_hole(std::uint32_t hole) {
  const LatticePoint q = at(hole);
  const std::uint32_t edge = edge_left_of(q);
  if (edge == no_index) return false;
  const std::uint32_t target = visible_node(q, edge);
  if (target == no_index) return false;
  std::uint32_t own = hole;
  while (at(own) != q || !looks_at(own, at(target))) {
    own = nodes_[own].next;
    if (own == hole) return false;
  }
  const std::uint32_t target_twin = add_node(at(target), nodes_[target].corner);
  const std::uint32_t own_twin = add_node(q, nodes_[own].corner);
  connect(target_twin, nodes_[target].next);
  connect(nodes_[own].previous, own_twin);
  connect(target, own);
  connect(own_twin, target_twin);
  nodes_[target_twin].beyond = nodes_[target].beyond;
  nodes_[target_twin].joint = nodes_[target].joint;
  if (nodes_[target].joint != no_index) nodes_[nodes_[target].joint].joint = target_twin;
  nodes_[target].joint = own_twin;
  nodes_[own_twin].joint = target;
  return true;
}

/// The first edge that a ray meets which runs from q in direction -x, an infinitesimal distance above q so
/// that it meets no corner. Only edges that run downwards have the polygon on their right side in the
/// picture.
std::uint32_t EarClipper::edge_left_of(LatticePoint q) const {
  // Both edges cross the ray and each other nowhere: compare them at the height of one of their ends.
  const auto right_of = [&](std::uint32_t e, std::uint32_t f) {
    const LatticePoint a = at(e), b = next_at(e), c = at(f), d = next_at(f);
    const std::int64_t upper = a.y <= c.y ? orientation(c, d, a) : -orientation(a, b, c);
    if (upper != 0) return upper > 0;
    return (b.y >= d.y ? orientation(c, d, b) : -orientation(a, b, d)) > 0;
  };
  std::uint32_t best = no_index;
  for (std::uint32_t e = 0; e < nodes_.size(); ++e) {
    const LatticePoint a = at(e), b = next_at(e);
    if (a.y > q.y && b.y <= q.y && orientation(a, b, q) > 0 && (best == no_index || right_of(e, best)))
      best = e;
  }
  return best;
}

/// A node that q sees, given the edge that `edge_left_of` found. Among the corners in the triangle of q, the
/// ray's end and an end of the edge that is left of q, the one closest in angle to the ray has nothing before
/// it.
std::uint32_t EarClipper::visible_node(LatticePoint q, std::uint32_t edge) const {
  const LatticePoint a = at(edge), b = next_at(edge);
  const bool above = a.x < q.x;
  const std::int64_t side = above ? 1 : -1;
  const LatticePoint end = above ? a : b;
  std::uint32_t best = no_index;
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    const LatticePoint z = at(node);
    if (z.x >= q.x || (z.y > q.y) != above) continue;
    if (orientation(a, b, z) < 0 || side * orientation(q, end, z) < 0) continue;
    if (best != no_index) {
      const std::int64_t closer = side * orientation(q, at(best), z);
      if (closer < 0 || (closer == 0 && z.x <= at(best).x)) continue;
    }
    if (looks_at(node, q)) best = node;
  }
  return best;
}

bool EarClipper::clip_ears() {
  std::size_t expected = 0;
  for (const std::uint32_t hull : scratch_.hulls) {
    std::size_t size = 0;
    std::uint32_t node = hull;
    do {
      ++size;
      enqueue(node);
      node = nodes_[node].next;
    } while (node != hull);
    expected += size - 2;
  }
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (strictly_convex(node)) continue;
    nodes_[node].reflex_at = static_cast<std::uint32_t>(scratch_.reflex.size());
    scratch_.reflex.push_back(node);
  }
  for (std::uint32_t i = 0; i < scratch_.queue.size(); ++i) {
    const std::uint32_t node = scratch_.queue[i];
    if (nodes_[node].ticket == i && is_ear(node)) clip(node);
  }
  return expected > 0 && triangles_.size() == expected;
}

/// An edge can enter the triangle (a, b, c) of v only across the diagonal ca or out of a or c. The wedges at
/// a and c exclude the latter; an edge across the diagonal ends at a corner inside, and of the corners
/// inside, the one farthest from the diagonal is not strictly convex.
bool EarClipper::is_ear(std::uint32_t v) const {
  const std::uint32_t before = nodes_[v].previous, after = nodes_[v].next;
  const LatticePoint a = at(before), b = at(v), c = at(after);
  if (orientation(a, b, c) <= 0) return false;
  if (nodes_[after].next == before) return true;
  if (!looks_at(before, c) || !looks_at(after, a)) return false;
  const auto [min_x, max_x] = std::minmax({a.x, b.x, c.x});
  const auto [min_y, max_y] = std::minmax({a.y, b.y, c.y});
  for (const std::uint32_t node : scratch_.reflex) {
    const LatticePoint z = at(node);
    if (z.x < min_x || z.x > max_x || z.y < min_y || z.y > max_y) continue;
    if (z == a || z == b || z == c) continue;
    if (orientation(a, b, z) >= 0 && orientation(b, c, z) >= 0 && orientation(c, a, z) >= 0) return false;
  }
  return true;
}

void EarClipper::clip(std::uint32_t v) {
  const std::uint32_t before = nodes_[v].previous, after = nodes_[v].next;
  const auto half_edge = static_cast<std::uint32_t>(3 * triangles_.size());
  triangles_.push_back({nodes_[before].corner, nodes_[v].corner, nodes_[after].corner});
  scratch_.twins.insert(scratch_.twins.end(), 3, no_index);
  const bool last = nodes_[after].next == before;
  consume_edge(before, half_edge);
  consume_edge(v, half_edge + 1);
  nodes_[v].ticket = no_index;
  if (last) {
    consume_edge(after, half_edge + 2);
    nodes_[before].ticket = nodes_[after].ticket = no_index;
    return;
  }
  connect(before, after);
  nodes_[before].beyond = half_edge + 2;
  nodes_[before].joint = no_index;
  drop_if_convex(before);
  drop_if_convex(after);
  // At the end of the queue: clipping every second corner first avoids fans.
  enqueue(before);
  enqueue(after);
}

/// The edge from `node` to the next one becomes a half-edge of a triangle.
void EarClipper::consume_edge(std::uint32_t node, std::uint32_t half_edge) {
  const Node& start = nodes_[node];
  if (start.beyond != no_index) {
    scratch_.twins[half_edge] = start.beyond;
    scratch_.twins[start.beyond] = half_edge;
  } else if (start.joint != no_index) {
    nodes_[start.joint].beyond = half_edge;
  }
}

void EarClipper::enqueue(std::uint32_t node) {
  nodes_[node].ticket = static_cast<std::uint32_t>(scratch_.queue.size());
  scratch_.queue.push_back(node);
}

/// Wedges only become narrower, so a node that has left the list never returns.
void EarClipper::drop_if_convex(std::uint32_t node) {
  auto& reflex = scratch_.reflex;
  std::uint32_t& slot = nodes_[node].reflex_at;
  if (slot == no_index || !strictly_convex(node)) return;
  reflex[slot] = reflex.back();
  nodes_[reflex[slot]].reflex_at = slot;
  reflex.pop_back();
  slot = no_index;
}

}  // namespace

bool triangulate(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends,
                 const Metric& metric, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 TriangulationScratch& scratch) {
  triangles.clear();
  scratch.nodes.clear();
  for (auto* list :
       {&scratch.order, &scratch.queue, &scratch.reflex, &scratch.hulls, &scratch.holes, &scratch.twins})
    list->clear();
  const bool complete = EarClipper(scratch, triangles).run(points, loop_ends);
  flip_edges(points, metric, triangles, scratch.twins);
  return complete;
}

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const LatticePoint> points,
                                                      std::span<const std::uint32_t> loop_ends,
                                                      const Metric& metric) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  TriangulationScratch scratch;
  triangulate(points, loop_ends, metric, triangles, scratch);
  return triangles;
}

}  // namespace cut::lattice

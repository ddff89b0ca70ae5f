// Snap rounding: whatever is drawn, and in whatever steps, the graph stays planar and the edges stay where
// they were drawn (§4.4).
#include "lattice/planar_graph.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "check_many.hpp"
#include "drawings.hpp"
#include "lattice/components.hpp"
#include "lattice/intersection.hpp"
#include "lattice/orientation.hpp"

namespace cut::lattice {

/// For CHECK to find.
static bool operator==(const GraphEdge& a, const GraphEdge& b) {
  return std::tie(a.from, a.to, a.left, a.right, a.deviation, a.is_new) ==
         std::tie(b.from, b.to, b.left, b.right, b.deviation, b.is_new);
}

}  // namespace cut::lattice

using namespace cut;
using namespace cut::lattice;

namespace {

/// Whether the closed unit square around p has a point of the line ab, and p projects onto the inside of ab:
/// by the corners of the square in doubled coordinates.
bool in_cell(LatticePoint a, LatticePoint b, LatticePoint p) {
  const Vector ab = b - a, ap = p - a;
  if (dot(ab, ap) <= 0 || dot(ab, p - b) >= 0) return false;
  bool left = false, right = false;
  for (const std::int64_t dx : {-1, 1})
    for (const std::int64_t dy : {-1, 1}) {
      const std::int64_t side = cross(ab, {2 * ap.x + dx, 2 * ap.y + dy});
      left = left || side >= 0;
      right = right || side <= 0;
    }
  return left && right;
}

bool along_a_side(LatticePoint a, LatticePoint b) { return (sides_of(a) & sides_of(b)) != 0; }

std::string name(LatticePoint p) { return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; }
std::string name(LatticePoint a, LatticePoint b) { return name(a) + "-" + name(b); }

/// What is wrong with the graph, empty when nothing is.
std::string fault(const PlanarGraph& graph) {
  if (!graph.complete) return "rounding did not come to an end";
  const auto& points = graph.points;
  if (std::set<LatticePoint>(points.begin(), points.end()).size() != points.size())
    return "two nodes at one point";
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (const GraphEdge& e : graph.edges) {
    const LatticePoint a = points.at(e.from), b = points.at(e.to);
    if (e.from == e.to) return "an edge without length at " + name(a);
    if (!seen.insert(std::minmax(e.from, e.to)).second) return "an edge twice: " + name(a, b);
    for (const LatticePoint p : points) {
      if (p == a || p == b) continue;
      if (on_segment(a, b, p)) return "node " + name(p) + " lies on " + name(a, b);
      // An edge along a side is exact, and is led only through nodes on that side.
      if (!along_a_side(a, b) && in_cell(a, b, p))
        return "node " + name(p) + " lies in the cell of " + name(a, b);
    }
    for (const GraphEdge& f : graph.edges)
      if (cross_properly(a, b, points[f.from], points[f.to]))
        return name(a, b) + " crosses " + name(points[f.from], points[f.to]);
  }
  return {};
}

double distance(LatticePoint p, const Segment& s) {
  const Vector d = s.second - s.first, w = p - s.first;
  const double t = std::clamp(static_cast<double>(dot(d, w)) / static_cast<double>(dot(d, d)), 0.0, 1.0);
  return std::hypot(static_cast<double>(w.x) - t * static_cast<double>(d.x),
                    static_cast<double>(w.y) - t * static_cast<double>(d.y));
}

/// The edge between two nodes, seen from `from` to `to`.
GraphEdge edge_between(const PlanarGraph& graph, std::uint32_t from, std::uint32_t to) {
  for (const GraphEdge& e : graph.edges) {
    if (e.from == from && e.to == to) return e;
    if (e.from == to && e.to == from) return {from, to, e.right, e.left, e.deviation, e.is_new};
  }
  FAIL("no edge between the nodes " << from << " and " << to);
  return {};
}

/// The chain of edges that leads from one end of a segment to the other and strays least.
struct Chain {
  double drift = 0;             ///< how far it leads away from the segment; infinite when there is no chain
  std::size_t inner_nodes = 0;  ///< of the shortest such chain
};

/// As the chain goes from one end to the other, each point of the segment has a point of the chain beside it
/// within `drift`.
Chain chain_along(const PlanarGraph& graph, const Segment& s) {
  std::vector<double> off;
  for (const LatticePoint p : graph.points) off.push_back(distance(p, s));
  const auto node = [&](LatticePoint p) {
    return static_cast<std::uint32_t>(std::find(graph.points.begin(), graph.points.end(), p) -
                                      graph.points.begin());
  };
  const std::uint32_t a = node(s.first), b = node(s.second);
  std::vector<std::pair<double, std::uint32_t>> order;  // edges by the distance of their further end
  for (std::uint32_t i = 0; i < graph.edges.size(); ++i)
    order.emplace_back(std::max(off[graph.edges[i].from], off[graph.edges[i].to]), i);
  std::sort(order.begin(), order.end());
  Components joined(graph.points.size());
  auto furthest = order.begin();
  for (; furthest != order.end(); ++furthest) {
    joined.join(graph.edges[furthest->second].from, graph.edges[furthest->second].to);
    if (joined.root(a) == joined.root(b)) break;
  }
  if (furthest == order.end()) return {HUGE_VAL, 0};
  std::vector<std::size_t> steps(graph.points.size(), graph.points.size());
  steps[a] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (auto e = order.begin(); e <= furthest; ++e) {
      const GraphEdge& edge = graph.edges[e->second];
      for (const auto& [from, to] : {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)})
        if (steps[from] + 1 < steps[to]) {
          steps[to] = steps[from] + 1;
          changed = true;
        }
    }
  }
  return {furthest->first, steps[b] - 1};
}

}  // namespace

TEST_CASE("a graph stays planar and its edges in place, whatever is drawn into it") {
  check_many(20000, "planar_graph", [&] {
    PlanarGraph graph = empty_graph();
    const PointSource source = random_source();
    std::vector<Segment> drawn;
    std::string log;  // what a failure shows
    const int steps = *rc::gen::inRange(1, 7);
    for (int step = 0; step < steps; ++step) {
      for (GraphEdge& e : graph.edges) e.is_new = false;
      if (*rc::gen::inRange(0, 4) == 0) {
        const LatticePoint p = source.draw();
        log += "node " + name(p) + "\n";
        RC_ASSERT(graph.points.at(insert_node(graph, p)) == p);
      } else {
        const std::vector<Segment> segments = random_segments(source, 8);
        for (const auto& [a, b] : segments) log += "edge " + name(a, b) + "\n";
        log += "together\n";
        draw(graph, segments);
        drawn.insert(drawn.end(), segments.begin(), segments.end());
      }
      if (const std::string f = fault(graph); !f.empty()) RC_FAIL(log + f);
      for (const Segment& s : drawn) {
        const auto [drift, inner_nodes] = chain_along(graph, s);
        const std::string words = log + name(s.first, s.second) + " has come off by " + std::to_string(drift);
        // Half a cell's diagonal for each node, and two more for nodes that the edge was led through and that
        // a shorter chain leaves out.
        const double limit = inner_nodes == 0 ? 0 : 0.7072 * static_cast<double>(inner_nodes + 2);
        if (drift > limit) RC_FAIL(words);
        // Along a side; a point beside it is off by more than the distance is wrong.
        if (along_a_side(s.first, s.second) && drift > 0.1) RC_FAIL(words);
      }
    }
  });
}

TEST_CASE("a large graph, in which edges are found by an index, stays planar as well") {
  std::size_t largest = 0;
  check_many(60, "large graphs", [&] {
    PlanarGraph graph = empty_graph();
    const PointSource source = random_source();
    for (int step = 0; step < 3; ++step) {
      for (GraphEdge& e : graph.edges) e.is_new = false;
      std::vector<Segment> segments;
      for (int i = 0; i < 12; ++i)
        for (const Segment& s : random_segments(source, 10)) segments.push_back(s);
      draw(graph, segments);
      RC_ASSERT(fault(graph) == "");
      for (const Segment& s : segments)
        RC_ASSERT((chain_along(graph, s).drift < (along_a_side(s.first, s.second) ? 0.1 : 12)));
    }
    largest = std::max(largest, graph.edges.size());
  });
  CHECK(largest > 1000);
}

TEST_CASE("the crossing of two edges is their rounded common point, and both keep what they carry") {
  PlanarGraph graph;
  graph.points = {{100, 100}, {107, 105}, {100, 104}, {106, 100}};
  graph.edges = {{0, 1, 7, 8, 0.5, false}};
  insert_edges(graph, {{2, 3, 9, 9, 0, true}});
  CHECK(fault(graph) == "");
  REQUIRE(graph.points.size() == 5);
  CHECK(graph.points[4] == LatticePoint{103, 102});  // from (2.9, 2.07)
  CHECK(graph.edges.size() == 4);
  CHECK(edge_between(graph, 0, 4) == GraphEdge{0, 4, 7, 8, 0.5, false});
  CHECK(edge_between(graph, 4, 1) == GraphEdge{4, 1, 7, 8, 0.5, false});
  CHECK(edge_between(graph, 2, 4) == GraphEdge{2, 4, 9, 9, 0, true});
  CHECK(edge_between(graph, 4, 3) == GraphEdge{4, 3, 9, 9, 0, true});
}

TEST_CASE("a new edge and an old one at the same place are the old one") {
  PlanarGraph graph;
  graph.points = {{100, 100}, {110, 100}, {105, 100}};
  const GraphEdge old_edge{0, 1, 1, 2, 0.5, false};
  const std::vector<GraphEdge> ahead{{0, 2, 3, 3, 0, true}, {0, 1, 3, 3, 0, true}};
  const std::vector<GraphEdge> back{{1, 0, 3, 3, 0, true}, {2, 0, 3, 3, 0, true}};
  for (const auto& new_edges : {ahead, back})
    for (const bool old_first : {true, false}) {
      graph.edges.clear();
      if (old_first) insert_edges(graph, {old_edge});
      insert_edges(graph, new_edges);
      if (!old_first) insert_edges(graph, {old_edge});
      CHECK(fault(graph) == "");
      CHECK(graph.edges.size() == 2);
      CHECK(edge_between(graph, 0, 2) == GraphEdge{0, 2, 1, 2, 0.5, false});
      CHECK(edge_between(graph, 2, 1) == GraphEdge{2, 1, 1, 2, 0.5, false});
    }
}

TEST_CASE("two old edges that rounding lays onto each other lose the polygon between them") {
  // Both leave node 0 to the right, polygon 0 above, 1 between and 2 below them.
  for (const bool upper_reversed : {false, true})
    for (const bool lower_reversed : {false, true}) {
      PlanarGraph graph;
      graph.points = {{100, 100}, {120, 101}, {120, 100}};
      const GraphEdge upper = upper_reversed ? GraphEdge{1, 0, 1, 0} : GraphEdge{0, 1, 0, 1};
      const GraphEdge lower = lower_reversed ? GraphEdge{2, 0, 2, 1} : GraphEdge{0, 2, 1, 2};
      graph.edges = {upper, lower};
      REQUIRE(fault(graph) == "");
      const std::uint32_t node = insert_node(graph, {110, 100});  // in the cell of one, on the other
      CHECK(fault(graph) == "");
      CHECK(graph.edges.size() == 3);
      CHECK(edge_between(graph, 0, node) == GraphEdge{0, node, 0, 2});
      CHECK(edge_between(graph, node, 1) == GraphEdge{node, 1, 0, 1});
      CHECK(edge_between(graph, node, 2) == GraphEdge{node, 2, 1, 2});
    }
}

TEST_CASE("an edge along a side is led through nodes of the side only") {
  constexpr std::int32_t n = lattice_size;
  const Segment side{{n - 5, 5}, {n - 900, 900}};
  PlanarGraph graph = empty_graph();
  draw(graph, {side});
  // A node beside it, in its cell, and an edge that hugs it.
  draw(graph, {{{n - 101, 100}, {n - 300, 200}}, {{n - 4, 2}, {n - 950, 949}}});
  CHECK(fault(graph) == "");
  CHECK(chain_along(graph, side).inner_nodes == 0);
  insert_node(graph, {n - 300, 300});
  CHECK(fault(graph) == "");
  CHECK(chain_along(graph, side).inner_nodes == 1);
}

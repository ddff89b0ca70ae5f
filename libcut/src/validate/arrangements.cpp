/// @file
/// Rules on each arrangement by itself: nodes_in_place, arrangement_planar, edge_sides_agree, polygon_simple,
/// polygons_partition_ancestor. The faces are walked anew here and compared with the polygons that the mesh
/// names. In: one arrangement after the other. Out: violations.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "lattice/orientation.hpp"
#include "validate/area.hpp"
#include "validate/planar_graph.hpp"
#include "validate/rules.hpp"
#include "validate/sweep.hpp"

namespace cut::validation {
namespace {

class Checker {
 public:
  Checker(const Arrangement& arrangement, std::size_t index, Report& report)
      : a_(arrangement), name_(name("arrangement", index)), report_(report) {}

  void run() {
    if (!nodes_in_place()) return;
    areas();
    edges_ = graph_of(a_);
    sweep_ = sweep(a_, edges_);
    if (!sweep_.conflict.empty()) return fail("arrangement_planar", sweep_.conflict);
    inner_nodes_used();
    faces();
    loops();
  }

 private:
  void fail(const char* rule, const std::string& what) { report_.add(rule, name_ + ": " + what); }

  /// Each node lies where its index says: at its corner, on its edge, or strictly inside.
  bool nodes_in_place() {
    const std::size_t found = report_.size();
    const auto check = [&](std::size_t n, bool ok) {
      if (!ok) fail("nodes_in_place", name("node", n) + " lies where it does not belong");
    };
    const auto in_range = [](std::int32_t c) { return c >= 0 && c <= lattice_size; };
    for (std::size_t n = 0; n < a_.nodes.size(); ++n) {
      const LatticePoint p = a_.nodes[n].point;
      const bool sound = in_range(p.x) && in_range(p.y) && p.inside();
      if (n < 3)
        check(n, p == lattice_corner(n));
      else if (n >= a_.first_inner_node())
        check(n, sound && p[0] > 0 && p[1] > 0 && p[2] > 0);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t previous = 0;
      for (std::uint32_t k = 1; k <= a_.boundary_counts[i]; ++k) {
        const std::uint32_t n = a_.edge_node(i, k);
        const LatticePoint p = a_.nodes[n].point;
        const bool sound = in_range(p.x) && in_range(p.y) && p.inside();
        const std::int32_t t = sound ? p[next_corner(i)] : 0;
        check(n, t > previous && t < lattice_size && p == lattice_point_on_edge(i, t));
        previous = t;
      }
    }
    return report_.size() == found && !report_.full();
  }

  /// Twice the areas of all polygons add up to twice that of the triangle, N².
  void areas() {
    std::int64_t sum = 0;
    for (std::size_t p = 0; p < a_.polygons.size(); ++p) {
      const std::int64_t area = twice_area(a_, a_.polygons[p]);
      if (area <= 0) fail("polygons_partition_ancestor", name("polygon", p) + " has no area");
      sum = wrapping_sum(sum, area);
    }
    if (sum != std::int64_t{lattice_size} * lattice_size)
      fail("polygons_partition_ancestor", "the polygons do not add up to the triangle");
  }

  void inner_nodes_used() {
    std::vector<std::uint8_t> used(a_.nodes.size(), 0);
    for (const CutEdge& e : a_.edges) used[e.from] = used[e.to] = 1;
    for (std::size_t n = a_.first_inner_node(); n < used.size(); ++n)
      if (used[n] == 0) fail("nodes_in_place", "no cut passes inner " + name("node", n));
    for (std::size_t e = 0; e < a_.edges.size(); ++e) {
      const auto ends = [&](std::size_t i) { return std::pair(a_.edges[i].from, a_.edges[i].to); };
      if (a_.edges[e].from >= a_.edges[e].to || (e > 0 && ends(e - 1) >= ends(e)))
        fail("nodes_in_place", name("edge", e) + " is out of order");
    }
  }

  /// One polygon on the left all along a walk, one outer walk for each polygon, and each part of the
  /// arrangement that floats in a face has that face's polygon round it.
  void faces() {
    const std::vector<std::uint32_t> next = face_walk(a_, edges_);
    std::vector<std::uint32_t> outer_walks(a_.polygons.size(), 0);
    std::vector<std::uint8_t> seen(next.size(), 0);
    for (std::uint32_t first = 0; first < next.size(); ++first) {
      if (seen[first] != 0) continue;
      AreaSum area;
      std::uint32_t half = first;
      do {
        seen[half] = 1;
        if (left_of(edges_, half) != left_of(edges_, first))
          fail("edge_sides_agree", "the sides of " + describe(half) + " and " + describe(first) +
                                       " bound one face and name two polygons");
        area.add(a_.nodes[origin(edges_, half)].point, a_.nodes[origin(edges_, half ^ 1u)].point);
        half = next[half];
      } while (half != first);
      const std::uint32_t polygon = left_of(edges_, first);
      if (area.value() > 0 && polygon != outside) ++outer_walks[polygon];
    }
    for (std::size_t p = 0; p < outer_walks.size(); ++p)
      if (outer_walks[p] != 1)
        fail("polygons_partition_ancestor",
             name("polygon", p) + " is " + std::to_string(outer_walks[p]) + " faces");
    floating_parts();
  }

  void floating_parts() {
    std::vector<std::uint32_t> parent(a_.nodes.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](std::uint32_t n) {
      while (parent[n] != n) n = parent[n] = parent[parent[n]];
      return n;
    };
    for (const GraphEdge& e : edges_) {  // the root of a part is its smallest point
      const std::uint32_t from = find(e.from);
      const std::uint32_t to = find(e.to);
      if (a_.nodes[from].point < a_.nodes[to].point)
        parent[to] = from;
      else
        parent[from] = to;
    }
    std::vector<std::uint32_t> top(a_.nodes.size(), outside);  // steepest half-edge that leaves a root
    using lattice::operator-;
    for (std::uint32_t half = 0; half < 2 * edges_.size(); ++half) {
      const std::uint32_t from = origin(edges_, half);
      if (find(from) != from) continue;
      const auto direction = [&](std::uint32_t h) {
        return a_.nodes[origin(edges_, h ^ 1u)].point - a_.nodes[from].point;
      };
      if (top[from] == outside || lattice::cross(direction(top[from]), direction(half)) > 0) top[from] = half;
    }
    for (std::uint32_t n = 0; n < a_.nodes.size(); ++n) {
      const std::uint32_t below = sweep_.below[n];
      if (top[n] == outside || below == outside) continue;  // no root, or the border of the triangle itself
      const bool forward = a_.nodes[edges_[below].from].point < a_.nodes[edges_[below].to].point;
      if (left_of(edges_, top[n]) != left_of(edges_, 2 * below + (forward ? 0 : 1)))
        fail("polygons_partition_ancestor",
             "what hangs together with " + name("node", n) + " lies in another polygon than it says");
    }
  }

  /// The polygons' loops are the walks along those edges that have different polygons at their sides.
  void loops() {
    std::vector<GraphEdge> contour;
    for (const GraphEdge& e : edges_)
      if (e.left != e.right) contour.push_back(e);
    const std::vector<std::uint32_t> next = face_walk(a_, contour);
    const auto key = [&](std::uint32_t half) {
      return std::pair(origin(contour, half), origin(contour, half ^ 1u));
    };
    std::vector<std::uint32_t> order(next.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

    std::vector<std::uint8_t> walked(next.size(), 0);
    for (std::uint32_t p = 0; p < a_.polygons.size(); ++p) {
      const RenderPolygon& polygon = a_.polygons[p];
      std::size_t begin = 0;
      for (const std::uint32_t end : polygon.loop_ends) {
        const auto corner = [&](std::size_t i) {
          return polygon.corners[i < end ? i : begin + (i - end) % (end - begin)].node;
        };
        AreaSum area;
        for (std::size_t i = begin; i < end; ++i) {
          const auto ends = std::pair(corner(i), corner(i + 1));
          area.add(a_.nodes[ends.first].point, a_.nodes[ends.second].point);
          const auto at = std::lower_bound(order.begin(), order.end(), ends,
                                           [&](std::uint32_t h, auto wanted) { return key(h) < wanted; });
          if (at == order.end() || key(*at) != ends || left_of(contour, *at) != p || walked[*at] != 0) {
            fail("edge_sides_agree", name("polygon", p) + " has a side " + std::to_string(ends.first) + "-" +
                                         std::to_string(ends.second) + " that is not there for it");
            continue;
          }
          walked[*at] = 1;
          if (key(next[*at]).second != corner(i + 2))
            fail("polygon_simple",
                 name("polygon", p) + " takes a wrong turn at " + name("node", ends.second));
        }
        if ((area.value() > 0) != (begin == 0))
          fail("polygon_simple", name("polygon", p) + ": a hull must be counterclockwise, a hole clockwise");
        begin = end;
      }
    }
    for (std::uint32_t half = 0; half < walked.size(); ++half)
      if (walked[half] == 0 && left_of(contour, half) != outside)
        fail("edge_sides_agree", name("polygon", left_of(contour, half)) + " lacks its side " +
                                     std::to_string(key(half).first) + "-" +
                                     std::to_string(key(half).second));
  }

  [[nodiscard]] std::string describe(std::uint32_t half) const {
    return std::to_string(origin(edges_, half)) + "-" + std::to_string(origin(edges_, half ^ 1u));
  }

  const Arrangement& a_;
  std::string name_;
  Report& report_;
  std::vector<GraphEdge> edges_;
  Sweep sweep_;
};

}  // namespace

void check_arrangements(const HybridMesh& mesh, Report& report) {
  for (std::size_t i = 0; i < mesh.arrangements.size() && !report.full(); ++i)
    Checker(mesh.arrangements[i], i, report).run();
}

}  // namespace cut::validation

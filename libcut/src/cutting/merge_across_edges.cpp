#include "cutting/merge_across_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "cutting/edge_state.hpp"
#include "lattice/plane.hpp"
#include "lattice/sort_unique.hpp"
#include "mesh/vector3.hpp"

namespace cut {
namespace {

using lattice::PlanePoint;
using lattice::PlaneTriangle;

double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint along = b - a;
  const double squared = dot(along, along);
  const double s = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  const PlanePoint d = p - (a + s * along);
  return std::sqrt(dot(d, d));
}

/// The corner at these distances from the ends of an edge, on the side of it where `away` is not.
PlanePoint third_corner(PlanePoint start, PlanePoint end, double squared_to_start, double squared_to_end,
                        PlanePoint away) {
  const PlanePoint along = end - start;
  const double squared = dot(along, along);
  const double s = 0.5 * ((squared_to_start - squared_to_end) / squared + 1);
  const double h = std::sqrt(std::max(squared_to_start / squared - s * s, 0.0));
  const PlanePoint normal{-along.y, along.x};
  return start + s * along + (cross(along, away - start) > 0 ? -h : h) * normal;
}

bool on_side(LatticePoint p, std::size_t side) { return p[last_corner(side)] == 0; }

LineEnd end_on_side(LatticePoint p) {
  if (const std::size_t corner = corner_of(p); corner < 3)
    return {p, LineEnd::On::node, static_cast<std::uint32_t>(corner), p};
  return {p, LineEnd::On::physics_edge, 0, p, true};
}

/// No way leads through more edges: an end sees at most the triangles around one node.
constexpr std::size_t most_edges = 8;

}  // namespace

struct Neighbourhood::Neighbour {
  TriangleWork work;
  PolygonNodes nodes;
};

/// Unfolds triangle after triangle, away from the end at `p`, as far as δc.
class Neighbourhood::Walk {
 public:
  /// Looks for nodes.
  Walk(Neighbourhood& neighbourhood, LatticePoint p, LatticePoint other, bool recent, double distance)
      : neighbourhood_(neighbourhood),
        mesh_(neighbourhood.mesh_),
        p_(p),
        other_(other),
        best_recent_(recent),
        best_distance_(distance) {}
  /// Looks for ends of this cut.
  Walk(Neighbourhood& neighbourhood, const SeenEnd& from, LatticePoint other, const SettledEnds& ends)
      : neighbourhood_(neighbourhood),
        mesh_(neighbourhood.mesh_),
        p_(from.detected),
        other_(other),
        looks_from_(&from),
        ends_(&ends) {}

  std::optional<TargetAcross> run(std::uint32_t polygon) {
    const TriangleWork& work = neighbourhood_.work_;
    const PlaneTriangle corners = lattice::laid_out(work.metric);
    from_ = in_plane(corners, p_);
    leave(work, corners, polygon, 3, work.distances);
    return std::move(best_);
  }

 private:
  /// A section of an edge that the way goes through.
  struct Gate {
    const TriangleWork* inner;
    const TriangleWork* outer;
    AncestorEdgeId edge;
    std::int32_t first;  ///< the section, in units from the start of the edge
    std::int32_t last;
    PlanePoint first_at;
    PlanePoint last_at;
    PlanePoint low;  ///< all directions from the end that lead through this gate and those before it
    PlanePoint high;
    std::uint32_t outer_polygon;
  };

  [[nodiscard]] double squared_distance(AncestorNodeId a, AncestorNodeId b) const {
    return squared_length(mesh_.ancestors.rest_positions[b.index()] -
                          mesh_.ancestors.rest_positions[a.index()]);
  }

  /// Through all sections of a polygon's sides that are within reach, but for the side where it was entered.
  void leave(const TriangleWork& work, const PlaneTriangle& corners, std::uint32_t polygon,
             std::size_t entered, const MergeDistances& distances) {
    if (gates_.size() == most_edges) return;
    const AncestorMesh& ancestors = mesh_.ancestors;
    for (std::size_t i = 0; i < 3; ++i) {
      const AncestorId beyond = ancestors.neighbour(work.ancestor, i);
      if (i == entered || !beyond.valid()) continue;
      const bool reversed = ancestors.reversed(work.ancestor, i);
      const PlanePoint start = corners[reversed ? next_corner(i) : i];
      const PlanePoint end = corners[reversed ? i : next_corner(i)];
      if (distance_to_segment(from_, start, end) > distances.cut) continue;
      const AncestorEdgeId edge = ancestors.triangles[work.ancestor.index()].edges[i];
      const EdgeState* state = mesh_.edge_state(edge);
      for_each_section(mesh_, work.ancestor, i, [&](std::size_t section, std::uint32_t at) {
        if (at != polygon || is_cut(state, section)) return;
        const auto [first, last] = section_range(state, section);
        const auto point = [&](std::int32_t t) {
          return start + static_cast<double>(t) / lattice_size * (end - start);
        };
        if (distance_to_segment(from_, point(first), point(last)) > distances.cut) return;
        PlanePoint low = point(first) - from_;
        PlanePoint high = point(last) - from_;
        if (cross(low, high) < 0) std::swap(low, high);
        if (!gates_.empty()) {
          if (cross(gates_.back().low, low) < 0) low = gates_.back().low;
          if (cross(high, gates_.back().high) < 0) high = gates_.back().high;
        }
        if (!(cross(low, high) > 0)) return;
        const std::size_t side = ancestors.local_edge(beyond, edge);
        std::uint32_t polygon_beyond = 0;
        for_each_section(mesh_, beyond, side, [&](std::size_t other, std::uint32_t value) {
          if (other == section) polygon_beyond = value;
        });
        Neighbour& neighbour = neighbourhood_.neighbour(beyond);
        gates_.push_back({&work, &neighbour.work, edge, first, last, point(first), point(last), low, high,
                          polygon_beyond});
        enter(neighbour, side, start, end, corners[last_corner(i)], distances);
        gates_.pop_back();
      });
    }
  }

  void enter(Neighbour& neighbour, std::size_t side, PlanePoint start, PlanePoint end, PlanePoint behind,
             const MergeDistances& so_far) {
    const TriangleWork& work = neighbour.work;
    const auto& nodes = mesh_.ancestors.triangles[work.ancestor.index()].nodes;
    const bool reversed = mesh_.ancestors.reversed(work.ancestor, side);
    const std::size_t at_start = reversed ? next_corner(side) : side;
    const std::size_t at_end = reversed ? side : next_corner(side);
    const std::size_t third = last_corner(side);
    PlaneTriangle corners;
    corners[at_start] = start;
    corners[at_end] = end;
    corners[third] = third_corner(start, end, squared_distance(nodes[at_start], nodes[third]),
                                  squared_distance(nodes[at_end], nodes[third]), behind);
    const MergeDistances distances{std::min(so_far.cut, work.distances.cut),
                                   std::min(so_far.node, work.distances.node),
                                   std::min(so_far.edge, work.distances.edge)};
    const std::uint32_t polygon = gates_.back().outer_polygon;
    if (looks_from_ != nullptr) {
      if (const auto found = ends_->find(work.ancestor); found != ends_->end())
        for (const SeenEnd& seen : found->second)
          if (seen.polygon == polygon && sees(*looks_from_, seen))
            consider(work, corners, seen.detected, seen.target, false, distances);
    } else {
      for (const std::uint32_t n : neighbour.nodes.of(polygon)) {
        const ArrangementNode& node = work.before.nodes[n];
        if (!on_side(node.point, side))
          consider(work, corners, node.point, {node.point, LineEnd::On::node, n, node.point},
                   neighbourhood_.context_.recent(node.stamp), distances);
      }
    }
    leave(work, corners, polygon, side, distances);
  }

  /// @param seen_at where the target attracts from, which may be another place than the target itself
  void consider(const TriangleWork& work, const PlaneTriangle& corners, LatticePoint seen_at, LineEnd target,
                bool recent, const MergeDistances& distances) {
    const auto away = [&](LatticePoint point) {
      const PlanePoint d = in_plane(corners, point) - from_;
      return std::sqrt(dot(d, d));
    };
    const double distance = away(seen_at);
    if (distance > (recent ? distances.cut : distances.node)) return;
    if (seen_at != target.point && away(target.point) > distances.cut) return;
    if (best_recent_ > recent || (best_recent_ == recent && best_distance_ <= distance)) return;

    // A target on the side of a gate is reached from the triangle before it.
    const PlanePoint to = in_plane(corners, target.point);
    const TriangleWork* last = &work;
    std::size_t passed = gates_.size();
    for (; passed > 0; --passed) {
      const Gate& gate = gates_[passed - 1];
      const std::size_t side = mesh_.ancestors.local_edge(last->ancestor, gate.edge);
      if (!on_side(target.point, side)) break;
      const std::int32_t t = along_edge(mesh_.ancestors, last->ancestor, side, target.point);
      if (t < gate.first || gate.last < t) return;
      last = gate.inner;
      const bool passes = target.passes;
      target = end_on_side(on_edge(*last, gate.edge, t));
      target.passes = passes;
    }
    // Where the straight way passes each gate.
    std::vector<std::int32_t> passes;
    for (std::size_t k = 0; k < passed; ++k) {
      const Gate& gate = gates_[k];
      const double at_first = cross(to - from_, gate.first_at - from_);
      const double at_last = cross(to - from_, gate.last_at - from_);
      if ((at_first > 0 && at_last > 0) || (at_first < 0 && at_last < 0) || at_first == at_last) return;
      const double s = at_first / (at_first - at_last);
      passes.push_back(gate.first +
                       static_cast<std::int32_t>(std::floor(s * (gate.last - gate.first) + 0.5)));
    }
    // A line that comes from the edge itself would run along it: it goes from where it came instead.
    if (passed == 1) {
      const Gate& gate = gates_.front();
      const std::size_t side = mesh_.ancestors.local_edge(gate.inner->ancestor, gate.edge);
      const std::int32_t t = along_edge(mesh_.ancestors, gate.inner->ancestor, side, other_);
      if (on_side(other_, side) && gate.first <= t && t <= gate.last) passes.front() = t;
    }

    TargetAcross found{recent, distance, target, {}};
    LatticePoint inner = p_;
    for (std::size_t k = 0; k < passed; ++k) {
      const LatticePoint exit = on_edge(*gates_[k].inner, gates_[k].edge, passes[k]);
      if (hidden(*gates_[k].inner, inner, exit)) return;
      (k == 0 ? found.exit : found.way.back().line.b) = end_on_side(exit);
      inner = on_edge(*gates_[k].outer, gates_[k].edge, passes[k]);
      found.way.push_back({gates_[k].outer->ancestor, {gates_[k].outer_polygon, end_on_side(inner), target}});
    }
    if (hidden(*last, inner, target.point)) return;
    best_ = std::move(found);
    best_recent_ = recent;
    best_distance_ = distance;
  }

  [[nodiscard]] LatticePoint on_edge(const TriangleWork& work, AncestorEdgeId edge, std::int32_t t) const {
    const std::size_t side = mesh_.ancestors.local_edge(work.ancestor, edge);
    return point_along_edge(mesh_.ancestors, work.ancestor, side, t);
  }

  static bool hidden(const TriangleWork& work, LatticePoint a, LatticePoint b) {
    return !visible(a, b, work.before.edges, [&](std::uint32_t n) { return work.before.nodes[n].point; });
  }

  Neighbourhood& neighbourhood_;
  const HybridMesh& mesh_;
  LatticePoint p_;
  LatticePoint other_;
  const SeenEnd* looks_from_ = nullptr;
  const SettledEnds* ends_ = nullptr;
  bool best_recent_ = false;
  double best_distance_ = std::numeric_limits<double>::infinity();
  PlanePoint from_{};
  std::vector<Gate> gates_;
  std::optional<TargetAcross> best_;
};

Neighbourhood::Neighbourhood(const HybridMesh& mesh, const TriangleWork& work, const CutContext& context)
    : mesh_(mesh), work_(work), context_(context) {}
Neighbourhood::Neighbourhood(Neighbourhood&&) noexcept = default;
Neighbourhood::~Neighbourhood() = default;

Neighbourhood::Neighbour& Neighbourhood::neighbour(AncestorId ancestor) {
  for (const auto& n : neighbours_)
    if (n->work.ancestor == ancestor) return *n;
  TriangleWork work = make_work(mesh_, ancestor, context_.distances);
  PolygonNodes nodes = nodes_of_polygons(work.before);
  neighbours_.push_back(std::make_unique<Neighbour>(Neighbour{std::move(work), std::move(nodes)}));
  return *neighbours_.back();
}

std::optional<TargetAcross> Neighbourhood::nearest_node(LatticePoint p, LatticePoint other,
                                                        std::uint32_t polygon, bool recent, double distance) {
  return Walk(*this, p, other, recent, distance).run(polygon);
}

std::optional<TargetAcross> Neighbourhood::nearest_end(const SeenEnd& from, LatticePoint other,
                                                       const SettledEnds& ends) {
  return Walk(*this, from, other, ends).run(from.polygon);
}

void lead_across(TargetAcross&& across, LineEnd& end, TriangleWork& work) {
  across.exit.detected = end.detected;
  across.exit.inside = end.inside;
  end = across.exit;
  std::move(across.way.begin(), across.way.end(), std::back_inserter(work.continued));
}

void continue_lines(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context) {
  std::vector<ContinuedLine> lines;
  for (TriangleWork& work : works) {
    std::move(work.continued.begin(), work.continued.end(), std::back_inserter(lines));
    work.continued.clear();
  }
  if (lines.empty()) return;
  std::vector<AncestorId> entered;
  for (const ContinuedLine& l : lines) entered.push_back(l.ancestor);
  lattice::sort_unique(entered);
  add_works(mesh, works, entered, context.distances);
  for (ContinuedLine& l : lines)
    std::lower_bound(works.begin(), works.end(), l.ancestor, [](const TriangleWork& w, AncestorId a) {
      return w.ancestor < a;
    })->lines.push_back(l.line);
}

}  // namespace cut

#include "cutting/merge_cut_endpoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "cutting/merge_across_edges.hpp"
#include "cutting/polygon_nodes.hpp"
#include "lattice/plane.hpp"
#include "spatial/point_cluster_dictionary.hpp"

namespace cut {
namespace {

using lattice::operator-;

std::int32_t round_to_lattice(double v) { return static_cast<std::int32_t>(std::floor(v + 0.5)); }

class EndpointMerger {
 public:
  EndpointMerger(const HybridMesh& mesh, TriangleWork& work, const CutContext& context)
      : work_(work),
        context_(context),
        nodes_(nodes_of_polygons(work.before)),
        across_(mesh, work, context) {}

  void merge(CuttingLine& line) {
    const LineEnd a = line.a;
    const LineEnd b = line.b;
    decide(line.a, b.point, line.polygon);
    decide(line.b, a.point, line.polygon);
    remember(line.a, a);
    remember(line.b, b);
  }

 private:
  /// A node, or another place that attracts ends.
  struct Target {
    LineEnd end;
    bool recent = false;
    double distance = std::numeric_limits<double>::infinity();
  };

  static void remember(LineEnd& end, const LineEnd& detected) {
    end.detected = detected.point;
    end.inside = detected.on == LineEnd::On::nothing && edge_of(detected.point) == 3;
  }

  /// @param other the line's other end, as it was detected
  void decide(LineEnd& end, LatticePoint other, std::uint32_t polygon) {
    if (end.on == LineEnd::On::node) return;
    if (const std::size_t corner = corner_of(end.point); corner < 3) {
      end = {end.point, LineEnd::On::node, static_cast<std::uint32_t>(corner)};
    } else if (edge_of(end.point) < 3) {
      end = {end.point, LineEnd::On::physics_edge, 0};
    } else if (end.on == LineEnd::On::cut_edge) {
      merge_along_cut_edge(end);
    } else {
      merge_inside(end, other, polygon);
    }
  }

  void merge_inside(LineEnd& end, LatticePoint other, std::uint32_t polygon) {
    const Target here = nearest_node(end.point, polygon);
    auto across = across_.nearest_node(end.point, other, polygon, here.recent, here.distance);
    if (across) {
      lead_across(std::move(*across), end, work_);
    } else if (here.distance < std::numeric_limits<double>::infinity()) {
      end = here.end;
    } else {
      merge_to_edge(end, polygon);
    }
  }

  /// An end on a cut goes to the ends of that edge only: the line on the other side of the cut must decide
  /// the same.
  void merge_along_cut_edge(LineEnd& end) const {
    const CutEdge& e = work_.before.edges[end.index];
    const double to_from = work_.metric.length(end.point, point(e.from));
    const double to_to = work_.metric.length(end.point, point(e.to));
    const std::uint32_t nearer = to_from <= to_to ? e.from : e.to;
    if (std::min(to_from, to_to) <= reach(nearer)) end = {point(nearer), LineEnd::On::node, nearer};
  }

  [[nodiscard]] LatticePoint point(std::uint32_t node) const { return work_.before.nodes[node].point; }
  [[nodiscard]] double reach(std::uint32_t node) const {
    return context_.recent(work_.before.nodes[node].stamp) ? work_.distances.cut : work_.distances.node;
  }

  /// The nearest node, or place where a cut has begun, of the previous cut within δc; else the nearest node
  /// within δn.
  [[nodiscard]] Target nearest_node(LatticePoint p, std::uint32_t polygon) const {
    Target best;
    const auto consider = [&](const LineEnd& target, LatticePoint from, bool recent, double reach) {
      const double distance = work_.metric.length(p, from);
      if (distance > reach) return;
      if (best.recent > recent || (best.recent == recent && best.distance <= distance)) return;
      if (!visible(p, target.point, work_.before.edges, [&](std::uint32_t i) { return point(i); })) return;
      best = {target, recent, distance};
    };
    const auto at_node = [&](std::uint32_t n) { return LineEnd{point(n), LineEnd::On::node, n}; };
    for (const std::uint32_t n : nodes_.of(polygon))
      consider(at_node(n), point(n), context_.recent(work_.before.nodes[n].stamp), reach(n));
    for (const ClusterCentres::Begun& b : context_.centres.begun_in(work_.ancestor))
      consider({b.point, LineEnd::On::nothing, 0}, b.point, true, work_.distances.cut);
    for (const ClusterCentres::Inside& c : context_.centres.inside_of(work_.ancestor))
      for (const std::uint32_t n : nodes_.of(polygon))
        if (point(n) == c.node) consider(at_node(n), c.detected, true, same_place(work_.distances));
    return best;
  }

  void merge_to_edge(LineEnd& end, std::uint32_t polygon) const {
    const LatticePoint p = end.point;
    double best = work_.distances.edge * work_.distances.edge;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::uint32_t k = 0; k < work_.before.section_polygons[i].size(); ++k) {
        if (work_.before.section_polygons[i][k] != polygon) continue;
        const LatticePoint a = point(work_.before.edge_node(i, k));
        const LatticePoint b = point(work_.before.edge_node(i, k + 1));
        const auto d = work_.metric.distance_to_segment(p, a, b);
        if (d.squared > best) continue;
        best = d.squared;
        const std::int32_t from = a[next_corner(i)];
        const std::int32_t to =
            k + 1 == work_.before.section_polygons[i].size() ? lattice_size : b[next_corner(i)];
        end = {lattice_point_on_edge(i, round_to_lattice(from + d.parameter * (to - from))),
               LineEnd::On::physics_edge, 0};
      }
    for (std::uint32_t i = 0; i < work_.before.edges.size(); ++i) {
      const CutEdge& e = work_.before.edges[i];
      if (e.left != polygon && e.right != polygon) continue;
      const LatticePoint a = point(e.from);
      const LatticePoint b = point(e.to);
      const auto d = work_.metric.distance_to_segment(p, a, b);
      if (d.squared >= best) continue;
      best = d.squared;
      end = {{round_to_lattice(a.x + d.parameter * (b.x - a.x)),
              round_to_lattice(a.y + d.parameter * (b.y - a.y))},
             LineEnd::On::cut_edge,
             i};
    }
    if (end.on == LineEnd::On::cut_edge) merge_along_cut_edge(end);
    if (end.on != LineEnd::On::cut_edge) return;
    // A cut that leaves a side at a small angle may have rounded the end onto that side.
    if (const std::size_t corner = corner_of(end.point); corner < 3) {
      end = {end.point, LineEnd::On::node, static_cast<std::uint32_t>(corner)};
    } else if (edge_of(end.point) < 3) {
      end = {end.point, LineEnd::On::physics_edge, 0};
    }
  }

  TriangleWork& work_;
  const CutContext& context_;
  PolygonNodes nodes_;
  Neighbourhood across_;
};

}  // namespace

void merge_cut_endpoints(const HybridMesh& mesh, TriangleWork& work, const CutContext& context) {
  if (work.lines.empty()) return;
  EndpointMerger merger(mesh, work, context);
  for (CuttingLine& line : work.lines) merger.merge(line);
}

void merge_free_endpoints(TriangleWork& work, const std::vector<LatticePoint>& boundary_points,
                          const CutContext& context) {
  const auto is_open = [](const LineEnd& e) { return e.on == LineEnd::On::nothing; };
  std::vector<std::pair<std::uint32_t, LineEnd>> open;
  for (const CuttingLine& line : work.lines)
    for (const LineEnd& end : {line.a, line.b})
      if (is_open(end)) open.emplace_back(line.polygon, end);
  if (open.empty()) return;
  std::sort(open.begin(), open.end(), [](const auto& l, const auto& r) {
    return std::tie(l.first, l.second.point) < std::tie(r.first, r.second.point);
  });
  const lattice::PlaneTriangle plane = lattice::laid_out(work.metric);
  const auto flat = [&](LatticePoint p) {
    const lattice::PlanePoint at = in_plane(plane, p);
    return spatial::Point<double, 2>{at.x, at.y};
  };
  using Clusters = spatial::PointClusterDictionary<double, 2, LatticePoint>;
  const auto point_of = [&](std::uint32_t n) { return work.before.nodes[n].point; };
  const auto nearest_visible = [&](const Clusters& clusters, LatticePoint p) -> std::optional<LatticePoint> {
    const auto nearest = clusters.find_nearest(flat(p));
    if (!nearest.valid() || !visible(p, clusters.value(nearest), work.before.edges, point_of))
      return std::nullopt;
    return clusters.value(nearest);
  };
  const auto ends_at = [&](std::size_t a, std::size_t b) {
    return a < open.size() && open[a].first == open[b].first && open[a].second.point == open[b].second.point;
  };
  // Tips within δn of another end lead it to where they go themselves (§7, "additional cluster centers").
  const auto reaching_tips = [&](const Clusters& clusters, const std::vector<LatticePoint>& tips) {
    Clusters reach = clusters;
    const double close = work.distances.node / 32;  // more centres would make a dense place slow
    for (const LatticePoint tip : tips) {
      const spatial::ClusterId own = clusters.find_nearest(flat(tip));
      if (!own.valid() || !visible(tip, clusters.value(own), work.before.edges, point_of)) continue;
      bool needed = true;
      reach.for_each_within(flat(tip), [&](spatial::ClusterId c, double squared) {
        if (c == own && squared <= close * close) needed = false;
      });
      if (needed) reach.add_center(own, flat(tip));
    }
    return reach;
  };
  // The nearest but `other`, where the line's other end is: both ends there would leave nothing of the line.
  const auto nearest_but = [&](const Clusters& clusters, LatticePoint p, LatticePoint other) {
    LatticePoint best = other;
    double best_squared = std::numeric_limits<double>::infinity();
    clusters.for_each_within(flat(p), [&](spatial::ClusterId c, double squared) {
      const LatticePoint at = clusters.value(c);
      if (at == other || std::tie(squared, at) >= std::tie(best_squared, best) ||
          work.metric.length(p, at) > work.distances.cut || !visible(p, at, work.before.edges, point_of))
        return;
      best = at;
      best_squared = squared;
    });
    return best;
  };
  for (std::size_t i = 0; i < open.size();) {
    const std::uint32_t polygon = open[i].first;
    std::vector<LatticePoint> tips;  // where only one line ends
    Clusters clusters(work.distances.node);
    for (const LatticePoint p : boundary_points) clusters.insert_or_merge(flat(p), p);
    for (const CuttingLine& line : work.lines)
      for (const LineEnd& end : {line.a, line.b})
        if (line.polygon == polygon && end.on == LineEnd::On::cut_edge)
          clusters.insert_or_merge(flat(end.point), end.point);
    for (const ClusterCentres::Begun& b : context.centres.begun_in(work.ancestor))
      if (!nearest_visible(clusters, b.point)) clusters.insert_or_merge(flat(b.point), b.point);
    for (; i < open.size() && open[i].first == polygon; ++i) {
      const LatticePoint p = open[i].second.point;
      if (!nearest_visible(clusters, p)) clusters.insert_or_merge(flat(p), p);
      if (!ends_at(i - 1, i) && !ends_at(i + 1, i)) tips.push_back(p);
    }
    std::optional<Clusters> reach;
    // Now that all new nodes are known, each end goes to the nearest: the same cut, made again, finds the
    // same nodes.
    for (CuttingLine& line : work.lines)
      for (LineEnd* end : {&line.a, &line.b}) {
        if (line.polygon != polygon) continue;
        if (is_open(*end)) {
          const LatticePoint other = end == &line.a ? line.b.point : line.a.point;
          const LatticePoint nearest = nearest_visible(clusters, end->point).value_or(end->point);
          if (nearest == other && !reach) reach = reaching_tips(clusters, tips);
          end->point = nearest != other ? nearest : nearest_but(*reach, end->point, other);
        } else if (end->on == LineEnd::On::node && end->detected != end->point &&
                   !context.recent(work.before.nodes[end->index].stamp)) {
          const auto nearer = nearest_visible(clusters, end->detected);
          if (nearer &&
              work.metric.length(end->detected, *nearer) < work.metric.length(end->detected, end->point))
            *end = {*nearer, LineEnd::On::nothing, 0, end->detected};
        }
      }
  }
}

}  // namespace cut

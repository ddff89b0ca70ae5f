#include "cutting/merge_on_physics_edges.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "cutting/edge_state.hpp"
#include "cutting/in_parts.hpp"
#include "lattice/scratch.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

struct EdgePoint {
  AncestorEdgeId edge;
  std::int32_t t;
  bool passes;              ///< see LineEnd
  std::int32_t merged = 0;  ///< where it went
  bool is_node = false;     ///< makes a new node
};

/// A place from which a node of the edge attracts points.
struct Target {
  std::int32_t t;
  bool recent;
  std::int32_t node;  ///< where that node is
  double reach;
};

lattice::ScratchList<Target> targets_of(const HybridMesh& mesh, AncestorEdgeId edge,
                                        const MergeDistances& distances, const CutContext& context,
                                        lattice::Scratch& scratch) {
  const auto& ends = mesh.ancestors.edges[edge.index()].nodes;
  lattice::ScratchList<Target> targets(&scratch);
  const auto add_node = [&](std::int32_t t, std::uint32_t stamp) {
    const bool recent = context.recent(stamp);
    targets.push_back({t, recent, t, recent ? distances.cut : distances.node});
  };
  add_node(0, mesh.node_stamps[ends[0].index()]);
  add_node(lattice_size, mesh.node_stamps[ends[1].index()]);
  if (const EdgeState* state = mesh.edge_state(edge))
    for (const BoundaryNode& n : state->nodes) add_node(n.t, n.stamp);
  for (const ClusterCentres::OnEdge& c : context.centres.on_edge(edge))
    targets.push_back({c.detected, true, c.node, same_place(distances)});
  return targets;
}

/// Sends a point to the nearest recent node within δc, else to the nearest within δn. `unit` is the length of
/// a lattice unit, `passing_reach` what is left of δc where a line only passes.
bool merge_to_node(EdgePoint& point, std::span<const Target> targets, double unit, double passing_reach) {
  const Target* best = nullptr;
  for (const Target& target : targets) {
    const std::int32_t distance = std::abs(target.t - point.t);
    if (unit * distance > (point.passes ? std::min(target.reach, passing_reach) : target.reach)) continue;
    if (best != nullptr && std::tuple(!best->recent, std::abs(best->t - point.t), best->t) <=
                               std::tuple(!target.recent, distance, target.t))
      continue;
    best = &target;
  }
  if (best == nullptr) return false;
  point.merged = best->node;
  return true;
}

/// The points of one edge, by increasing t, and how many new nodes they make.
struct EdgePoints {
  std::span<EdgePoint> points;
  std::uint32_t new_nodes = 0;
};

/// Decides where the points of an edge go. Groups of new points within δn get one node at the point nearest
/// to their middle.
void settle(const HybridMesh& mesh, EdgePoints& on_edge, const CutContext& context) {
  const AncestorEdgeId edge = on_edge.points[0].edge;
  const double unit = mesh.ancestors.rest_length(edge) / lattice_size;
  const MergeDistances distances = local_distances(context.distances, unit * lattice_size, unit);
  lattice::Scratch scratch;
  lattice::ScratchList<Target> targets = targets_of(mesh, edge, distances, context, scratch);
  lattice::ScratchList<EdgePoint*> fresh(&scratch);
  for (EdgePoint& p : on_edge.points)
    if (!merge_to_node(p, targets, unit, distances.node)) fresh.push_back(&p);
  if (fresh.empty()) return;
  for (std::size_t i = 0; i < fresh.size();) {
    std::size_t last = i;
    while (last + 1 < fresh.size() && unit * (fresh[last + 1]->t - fresh[i]->t) <= distances.node) ++last;
    const std::int32_t middle = fresh[i]->t + (fresh[last]->t - fresh[i]->t) / 2;
    EdgePoint* centre = *std::min_element(fresh.begin() + static_cast<std::ptrdiff_t>(i),
                                          fresh.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                                          [&](const EdgePoint* a, const EdgePoint* b) {
                                            return std::abs(a->t - middle) < std::abs(b->t - middle);
                                          });
    i = last + 1;
    centre->is_node = true;
    ++on_edge.new_nodes;
    targets.push_back({centre->t, false, centre->t, distances.node});
  }
  for (EdgePoint& p : on_edge.points) merge_to_node(p, targets, unit, distances.node);
}

}  // namespace

void merge_on_physics_edges(HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context,
                            const Executor& executor, ClusterCentres& next_centres) {
  const AncestorMesh& ancestors = mesh.ancestors;
  const auto edge_point = [&](const TriangleWork& work, const LineEnd& end) {
    const std::size_t i = edge_of(end.point);
    return EdgePoint{ancestors.triangles[work.ancestor.index()].edges[i],
                     along_edge(ancestors, work.ancestor, i, end.point), end.passes};
  };
  std::vector<EdgePoint> points;
  for (const auto& part : in_parts<std::vector<EdgePoint>>(
           executor, works.size(), [&](std::size_t w, std::vector<EdgePoint>& on_edges) {
             for (const CuttingLine& line : works[w].lines)
               for (const LineEnd& end : {line.a, line.b})
                 if (end.on == LineEnd::On::physics_edge && edge_of(end.point) < 3 &&
                     corner_of(end.point) == 3)
                   on_edges.push_back(edge_point(works[w], end));
           }))
    append(points, part);
  // Where a line ends and another one passes, there is an end.
  std::ranges::sort(points, {}, [](const EdgePoint& p) { return std::tuple(p.edge, p.t, p.passes); });
  const auto place_of = [](const EdgePoint& p) { return std::pair(p.edge, p.t); };
  const auto repeated = std::ranges::unique(points, {}, place_of);
  points.erase(repeated.begin(), repeated.end());

  std::vector<EdgePoints> edges;
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    while (end < points.size() && points[end].edge == points[i].edge) ++end;
    edges.push_back({{points.data() + i, end - i}});
    i = end;
  }
  executor.for_each(edges.size(), [&](std::size_t i) { settle(mesh, edges[i], context); });
  std::erase_if(edges, [](const EdgePoints& e) { return e.new_nodes == 0; });
  number_edge_states(mesh, edges, [](const EdgePoints& e) { return e.points[0].edge; });
  executor.for_each(edges.size(), [&](std::size_t i) {
    EdgeState& state = edge_state_for_writing(mesh, edges[i].points[0].edge);
    state.nodes.reserve(state.nodes.size() + edges[i].new_nodes);
    state.cut.reserve(state.cut.size() + edges[i].new_nodes);
    for (const EdgePoint& p : edges[i].points)
      if (p.is_node) insert_boundary_node(state, p.t, context.this_cut);
  });
  // Only now: a stamp set earlier would hide from the next edge that their common node was part of the
  // previous cut.
  for (const EdgePoint& p : points) {
    stamp_edge_node(mesh, p.edge, p.merged, context.this_cut);
    if (p.t != p.merged) next_centres.on_edges.push_back({p.edge, p.t, p.merged});
  }

  executor.for_each(works.size(), [&](std::size_t w) {
    TriangleWork& work = works[w];
    for (CuttingLine& line : work.lines)
      for (LineEnd* end : {&line.a, &line.b}) {
        if (end->on != LineEnd::On::physics_edge || corner_of(end->point) < 3) continue;
        const std::size_t i = edge_of(end->point);
        const auto found = std::ranges::lower_bound(points, place_of(edge_point(work, *end)), {}, place_of);
        end->point = point_along_edge(ancestors, work.ancestor, i, found->merged);
      }
  });

  std::vector<AncestorId> beside;
  for (const auto& part : in_parts<std::vector<AncestorId>>(
           executor, edges.size(), [&](std::size_t i, std::vector<AncestorId>& triangles) {
             for (const AncestorId t : ancestors.edges[edges[i].points[0].edge.index()].triangles)
               if (t.valid()) triangles.push_back(t);
           }))
    append(beside, part);
  lattice::sort_unique(beside);
  add_works(mesh, works, beside, context.distances);
}

}  // namespace cut

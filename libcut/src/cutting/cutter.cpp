// The pipeline (§4): runs the steps in their order, with nothing in between but the state that flows through
// them.
#include "cut/cutter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "cutting/arrange_triangle.hpp"
#include "cutting/change_log.hpp"
#include "cutting/copy_boundary_nodes.hpp"
#include "cutting/copy_physics_nodes.hpp"
#include "cutting/copy_physics_triangles.hpp"
#include "cutting/cutter_memory.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "cutting/edge_state.hpp"
#include "cutting/in_parts.hpp"
#include "cutting/meet_ends.hpp"
#include "cutting/merge_across_edges.hpp"
#include "cutting/merge_cut_endpoints.hpp"
#include "cutting/merge_on_physics_edges.hpp"
#include "cutting/state.hpp"
#include "cutting/triangulate_polygons.hpp"
#include "cutting/weld_slivers.hpp"
#include "lattice/sort_unique.hpp"
#include "mesh/state.hpp"

namespace cut {

namespace {

class Stopwatch {
 public:
  /// Adds the milliseconds since the last call to `sum`.
  void lap(double& sum) {
    const auto now = std::chrono::steady_clock::now();
    sum += std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

bool check_cutter(const TriangleMesh& cutter, const MergeDistances& distances, Error& error) {
  for (std::size_t i = 0; i < cutter.triangles.size(); ++i)
    for (const std::uint32_t node : cutter.triangles[i]) {
      if (node >= cutter.positions.size()) {
        error = {Error::Kind::index_out_of_range,
                 "triangle " + std::to_string(i) + " of the cutter names point " + std::to_string(node) +
                     ", but there are only " + std::to_string(cutter.positions.size()),
                 i};
        return false;
      }
      const Eigen::Vector3d& p = cutter.positions[node];
      if (!p.allFinite() || !(p.cwiseAbs().maxCoeff() < largest_coordinate)) {
        error = {Error::Kind::not_finite,
                 "point " + std::to_string(node) +
                     " of the cutter has a coordinate that is NaN, infinite or beyond 1e50",
                 node};
        return false;
      }
      if (p.cwiseAbs().maxCoeff() > farthest_corner(distances)) {
        error = {
            Error::Kind::too_far,
            "point " + std::to_string(node) +
                " of the cutter is so far away that the cut would be off by more than the merge distances",
            node};
        return false;
      }
    }
  return true;
}

/// Writes the numbers of the cuts that nodes took part in back to where they are kept.
void keep_stamps(HybridMesh& mesh, const TriangleWork& work, const CutContext& context) {
  const Ancestor& ancestor = mesh.ancestors.triangles[work.ancestor.index()];
  for (std::size_t k = 0; k < 3; ++k)
    if (work.stamps[k] == context.this_cut) mesh.node_stamps[ancestor.nodes[k].index()] = context.this_cut;
  std::size_t n = 3;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < work.boundary_counts[i]; ++j, ++n) {
      if (work.stamps[n] != context.this_cut) continue;
      stamp_edge_node(mesh, ancestor.edges[i],
                      along_edge(mesh.ancestors, work.ancestor, i, work.graph.points[n]), context.this_cut);
    }
  const std::uint32_t index = mesh.arrangement_of[work.ancestor.index()];
  if (work.changed || index == HybridMesh::none) return;
  Arrangement& stored = mesh.arrangements[index];
  for (std::size_t k = stored.first_inner_node(); k < stored.nodes.size(); ++k)
    if (work.stamps[k] == context.this_cut) stored.nodes[k].stamp = context.this_cut;
}

bool has_end_inside(const CuttingLine& line) { return line.a.inside || line.b.inside; }

/// Steps 3, 4, 5, 7 and 9 on one triangle: reads what it shares with others, and writes to its own work only.
void arrange(const HybridMesh& mesh, TriangleWork& work, const CutContext& context) {
  std::array<std::vector<LatticePoint>, 3> boundary;
  for (std::size_t i = 0; i < 3; ++i) boundary[i] = boundary_points(mesh, work.ancestor, i);
  arrange_triangle(work, boundary, context);
  // A work whose only change is a cut along one of its sides needs its polygons, too.
  work.polygons = weld_slivers(mesh, work);
  if (keeps_all_fragments(work, work.polygons)) return;
  work.lines.clear();
  arrange_triangle(work, boundary, context);
  work.polygons = weld_slivers(mesh, work);
}

/// Whether a line's end that was not on a side has gone elsewhere.
bool moved_inside(const LineEnd& end) {
  return end.on != LineEnd::On::physics_edge && end.detected != end.point;
}

/// Whether arranging has to be told to others than the work itself: to the triangles around, or to the next
/// cut. Most works have nothing to tell.
bool concerns_others(const HybridMesh& mesh, const TriangleWork& work, const CutContext& context) {
  if (!work.changed) return true;
  const Ancestor& ancestor = mesh.ancestors.triangles[work.ancestor.index()];
  std::size_t n = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::ranges::find(work.cut_sections[i], 1) != work.cut_sections[i].end()) return true;
    if (work.stamps[i] == context.this_cut && mesh.node_stamps[ancestor.nodes[i].index()] != context.this_cut)
      return true;
    const std::uint32_t count = work.boundary_counts[i];
    const bool reversed = mesh.ancestors.reversed(work.ancestor, i);
    for (std::uint32_t j = 0; j < count; ++j, ++n)
      if (work.stamps[n] == context.this_cut &&
          mesh.edge_state(ancestor.edges[i])->nodes[reversed ? count - 1 - j : j].stamp != context.this_cut)
        return true;
  }
  return std::ranges::any_of(work.lines, [](const CuttingLine& line) {
    return line.a.point == line.b.point || moved_inside(line.a) || moved_inside(line.b);
  });
}

/// Gives back what only arranging needs: what is in the cache serves the next triangle then, and the heap
/// need not take back all of it at once, which it does in one thread.
void forget_graph(TriangleWork& work) {
  const auto free = [](auto&... lists) { (std::remove_reference_t<decltype(lists)>().swap(lists), ...); };
  free(work.graph.points, work.graph.edges, work.stamps, work.rendered, work.old_section_polygons,
       work.cut_sections, work.polygons.graph_edge, work.before.edges, work.before.section_polygons);
  for (RenderPolygon& polygon : work.before.polygons) free(polygon.loop_ends);
}

/// Frees what the entries hold, which is many small pieces, on all threads.
template <class T>
void give_back(std::vector<T>& list, const Executor& executor) {
  executor.for_each(list.size(), [&](std::size_t i) { const T done = std::move(list[i]); });
}

/// Notes where the ends of a work's lines that were not on a side were detected, and where they went; and
/// where lines have vanished without a node.
void remember_centres(const TriangleWork& work, ClusterCentres& centres) {
  const std::vector<ArrangementNode>& nodes = work.polygons.arrangement.nodes;
  for (const CuttingLine& line : work.lines) {
    for (const LineEnd& end : {line.a, line.b})
      if (moved_inside(end)) centres.inside.push_back({work.ancestor, end.detected, end.point});
    if (line.a.point == line.b.point &&
        std::none_of(nodes.begin(), nodes.end(),
                     [&](const ArrangementNode& n) { return n.point == line.a.point; }))
      centres.begun.push_back({work.ancestor, line.a.point});
  }
}

}  // namespace

Cutter::Cutter(const MergeDistances& distances) : memory_(std::make_unique<Memory>()) {
  memory_->distances = distances;
}
Cutter::Cutter(Cutter&&) noexcept = default;
Cutter& Cutter::operator=(Cutter&&) noexcept = default;
Cutter::~Cutter() = default;

const MergeDistances& Cutter::distances() const { return memory_->distances; }
const StepTimings& Cutter::timings() const { return memory_->timings; }

Result<Changes> Cutter::cut(HybridMesh& mesh, const TriangleMesh& cutter) {
  StepTimings& timings = memory_->timings;
  timings = {};
  Stopwatch watch;
  Error error{};
  if (!check_cutter(cutter, memory_->distances, error)) return error;
  const bool as_left = memory_->broad_phase.knows(mesh);
  if (!memory_->broad_phase.update(mesh, error)) return error;
  watch.lap(timings.broad_phase);

  const CutContext context{memory_->distances, memory_->centres, mesh.cut_count + 1, memory_->previous_cut};
  const double slack = contact_slack(context.distances, cutter);
  auto [works, lines] =
      detect_cutting_lines(mesh, cutter, memory_->broad_phase.candidates(mesh, cutter, slack, executor),
                           slack, context.distances, executor);
  watch.lap(timings.detect);

  Changes nothing;
  nothing.version_before = nothing.version_after = mesh.topology_version;
  // The same cut again does nothing. Left to the steps below, a line that merging has led aside would be
  // clipped by its own cut. That it was called is forgotten, so that the nodes of the cut stay recent.
  if (!lines.empty() && lines == memory_->lines && as_left) return nothing;
  memory_->lines = std::move(lines);
  // What the last cut left is still remembered: a blade that stands still for a while goes on with its cut.
  if (works.empty()) return nothing;
  ++mesh.cut_count;
  memory_->previous_cut = context.this_cut;

  std::vector<std::uint8_t> ends_inside(works.size());  // per work
  executor.for_each(works.size(), [&](std::size_t i) {
    merge_cut_endpoints(mesh, works[i], context);
    ends_inside[i] = std::ranges::any_of(works[i].lines, has_end_inside) ? 1 : 0;
  });
  if (std::ranges::count(ends_inside, 1) > 0) {
    meet_ends(mesh, works, context);
    continue_lines(mesh, works, context);
  }
  ClusterCentres next_centres;
  merge_on_physics_edges(mesh, works, context, executor, next_centres);
  watch.lap(timings.merge_endpoints);

  std::vector<std::uint8_t> tells(works.size());  // per work
  executor.for_each(works.size(), [&](std::size_t i) {
    arrange(mesh, works[i], context);
    tells[i] = concerns_others(mesh, works[i], context) ? 1 : 0;
    if (tells[i] == 0) forget_graph(works[i]);
  });
  std::vector<AncestorNodeId> touched;  // physics nodes whose copies may have come apart
  for (std::size_t i = 0; i < works.size(); ++i) {
    if (tells[i] == 0) continue;
    TriangleWork& work = works[i];
    remember_centres(work, next_centres);
    for (const AncestorEdgeId e : cut_edge_sections(mesh, work)) {
      work.changed = true;
      append(touched, mesh.ancestors.edges[e.index()].nodes);
    }
    keep_stamps(mesh, work, context);
    forget_graph(work);
  }
  std::sort(next_centres.on_edges.begin(), next_centres.on_edges.end());
  std::sort(next_centres.inside.begin(), next_centres.inside.end());
  lattice::sort_unique(next_centres.begun);
  memory_->centres = std::move(next_centres);
  std::erase_if(works, [](const TriangleWork& w) { return !w.changed; });
  ChangeLog log;
  append(touched, copy_physics_triangles(mesh, works, executor, log));
  watch.lap(timings.arrange);
  if (works.empty()) return nothing;

  lattice::sort_unique(touched);
  copy_physics_nodes(mesh, touched, executor, log);
  update_springs(mesh, touched, executor, log);
  const auto come_apart = copy_boundary_nodes(mesh, works, executor, log);
  watch.lap(timings.reconnect);

  triangulate_polygons(mesh, works, executor, log);
  triangulate_again(mesh, come_apart, log);
  update_vertex_nodes(mesh, executor, log);
  mesh.state = new_state();
  memory_->broad_phase.add(mesh, log.triangle_copies);
  Changes changes = publish(mesh, std::move(log), executor);
  changes.version_before = mesh.topology_version;
  changes.version_after = ++mesh.topology_version;
  give_back(works, executor);
  watch.lap(timings.publish);
  return changes;
}

}  // namespace cut

#include "cutting/state.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesh/vector3.hpp"

namespace cut {

Arrangement working_arrangement(const HybridMesh& mesh, AncestorId ancestor) {
  const Ancestor& triangle = mesh.ancestors.triangles[ancestor.index()];
  Arrangement result;
  if (const Arrangement* stored = mesh.arrangement(ancestor)) {
    result = *stored;
  } else {
    result.nodes.resize(3);
    RenderPolygon polygon;
    polygon.triangle = TriangleId{ancestor.index()};
    polygon.corners.reserve(3);
    for (std::uint32_t k = 0; k < 3; ++k) {
      result.nodes[k].point = lattice_corner(k);
      result.nodes[k].rendered = true;
      result.section_polygons[k] = {0};
      polygon.corners.push_back({k, mesh.buffers.render_triangles[ancestor.index()].vertices[k]});
    }
    polygon.loop_ends = {3};
    polygon.triangles = {RenderTriangleId{ancestor.index()}};
    result.polygons.push_back(std::move(polygon));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    result.nodes[k].stamp = mesh.node_stamps[triangle.nodes[k].index()];
    const EdgeState* edge = mesh.edge_state(triangle.edges[k]);
    if (edge == nullptr) continue;
    // The edge may have got nodes since that the arrangement does not know yet.
    const bool reversed = mesh.ancestors.reversed(ancestor, k);
    for (std::uint32_t i = 1; i <= result.boundary_counts[k]; ++i) {
      ArrangementNode& node = result.nodes[result.edge_node(k, i)];
      const std::int32_t along = node.point[next_corner(k)];
      const std::int32_t t = reversed ? lattice_size - along : along;
      for (const BoundaryNode& n : edge->nodes)
        if (n.t == t) node.stamp = n.stamp;
    }
  }
  return result;
}

MergeDistances local_distances(const MergeDistances& distances, double size, double unit) {
  const double factor = std::min(1.0, std::max(size / (4 * distances.cut), 2 * unit / distances.edge));
  return {distances.cut * factor, distances.node * factor, distances.edge * factor};
}

TriangleWork make_work(const HybridMesh& mesh, AncestorId ancestor, const MergeDistances& distances) {
  const lattice::Metric metric = rest_metric(mesh.ancestors, ancestor);
  return {ancestor, metric,
          local_distances(distances, metric.smallest_height(), metric.longest_edge() / lattice_size),
          working_arrangement(mesh, ancestor)};
}

void add_works(const HybridMesh& mesh, std::vector<TriangleWork>& works,
               const std::vector<AncestorId>& ancestors, const MergeDistances& distances) {
  if (std::ranges::includes(works, ancestors, {}, &TriangleWork::ancestor)) return;
  std::vector<TriangleWork> all;
  all.reserve(works.size() + ancestors.size());
  auto next = works.begin();
  for (const AncestorId t : ancestors) {
    for (; next != works.end() && next->ancestor < t; ++next) all.push_back(std::move(*next));
    if (next == works.end() || next->ancestor != t) all.push_back(make_work(mesh, t, distances));
  }
  std::move(next, works.end(), std::back_inserter(all));
  works = std::move(all);
}

lattice::Metric rest_metric(const AncestorMesh& ancestors, AncestorId ancestor) {
  std::array<double, 3> squared;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& ends = ancestors.edges[ancestors.triangles[ancestor.index()].edges[k].index()].nodes;
    squared[k] =
        squared_length(ancestors.rest_positions[ends[1].index()] - ancestors.rest_positions[ends[0].index()]);
  }
  return lattice::Metric(squared);
}

}  // namespace cut

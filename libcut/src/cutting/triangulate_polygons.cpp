#include "cutting/triangulate_polygons.hpp"

#include <algorithm>

#include "lattice/per_thread.hpp"
#include "lattice/sort_unique.hpp"
#include "lattice/triangulation.hpp"

namespace cut {

namespace {

/// Triangles of a polygon, as its corners.
using CornerTriangles = std::vector<std::array<std::uint32_t, 3>>;

class Triangulator {
 public:
  void triangulate(const Arrangement& arrangement, const RenderPolygon& polygon,
                   const lattice::Metric& metric, CornerTriangles& triangles) {
    points_.clear();
    for (const PolygonCorner& c : polygon.corners) points_.push_back(arrangement.nodes[c.node].point);
    lattice::triangulate(points_, polygon.loop_ends, metric, triangles, scratch_);
  }

 private:
  std::vector<LatticePoint> points_;
  lattice::TriangulationScratch scratch_;
};

/// Triangles of all polygons of one arrangement.
struct Triangulation {
  CornerTriangles triangles;
  std::vector<std::size_t> ends;      ///< per polygon: where its triangles end
  std::vector<RenderTriangleId> ids;  ///< per triangle
};

Triangulation triangulation_of(const Arrangement& arrangement, const lattice::Metric& metric) {
  Triangulation result;
  SNIP_PER_THREAD Triangulator triangulator;
  SNIP_PER_THREAD CornerTriangles triangles;
  for (const RenderPolygon& polygon : arrangement.polygons) {
    triangulator.triangulate(arrangement, polygon, metric, triangles);
    result.triangles.insert(result.triangles.end(), triangles.begin(), triangles.end());
    result.ends.push_back(result.triangles.size());
  }
  return result;
}

RenderTriangle render_triangle(const RenderPolygon& polygon, const std::array<std::uint32_t, 3>& corners) {
  return {{polygon.corners[corners[0]].vertex, polygon.corners[corners[1]].vertex,
           polygon.corners[corners[2]].vertex},
          polygon.triangle};
}

/// Entries for so many triangles: those that the ancestor had before, then free ones, then new ones.
std::vector<RenderTriangleId> allocate(HybridMesh& mesh, const Arrangement& before, std::size_t count,
                                       ChangeLog& log) {
  auto& entries = mesh.buffers.render_triangles;
  auto& free = mesh.free_render_triangles;
  std::vector<RenderTriangleId> ids;
  for (const RenderPolygon& polygon : before.polygons)
    ids.insert(ids.end(), polygon.triangles.begin(), polygon.triangles.end());
  std::sort(ids.begin(), ids.end());
  for (; ids.size() > count; ids.pop_back()) {
    entries[ids.back().index()] = RenderTriangle{};
    log.render_triangles.push_back(ids.back().value);
    free.push_back(ids.back());
  }
  for (; ids.size() < count && !free.empty(); free.pop_back()) ids.push_back(free.back());
  for (; ids.size() < count; entries.emplace_back()) ids.emplace_back(entries.size());
  for (const RenderTriangleId id : ids) log.render_triangles.push_back(id.value);
  return ids;
}

}  // namespace

void triangulate_polygons(HybridMesh& mesh, std::span<const TriangleWork> works, const Executor& executor,
                          ChangeLog& log) {
  std::vector<Triangulation> triangulations(works.size());
  executor.for_each(works.size(), [&](std::size_t i) {
    triangulations[i] = triangulation_of(*mesh.arrangement(works[i].ancestor), works[i].metric);
  });
  for (std::size_t i = 0; i < works.size(); ++i)
    triangulations[i].ids = allocate(mesh, works[i].before, triangulations[i].triangles.size(), log);
  executor.for_each(works.size(), [&](std::size_t i) {
    const Triangulation triangulation = std::move(triangulations[i]);
    std::size_t next = 0;
    Arrangement& arrangement = mesh.arrangements[mesh.arrangement_of[works[i].ancestor.index()]];
    for (std::size_t p = 0; p < arrangement.polygons.size(); ++p) {
      RenderPolygon& polygon = arrangement.polygons[p];
      polygon.triangles.assign(
          triangulation.ids.begin() + static_cast<std::ptrdiff_t>(next),
          triangulation.ids.begin() + static_cast<std::ptrdiff_t>(triangulation.ends[p]));
      for (; next < triangulation.ends[p]; ++next)
        mesh.buffers.render_triangles[triangulation.ids[next].index()] =
            render_triangle(polygon, triangulation.triangles[next]);
    }
  });
}

void triangulate_again(HybridMesh& mesh, std::span<const std::pair<AncestorId, std::uint32_t>> polygons,
                       ChangeLog& log) {
  Triangulator triangulator;
  CornerTriangles triangles;
  for (const auto& [ancestor, p] : polygons) {
    const Arrangement& arrangement = *mesh.arrangement(ancestor);
    const RenderPolygon& polygon = arrangement.polygons[p];
    triangulator.triangulate(arrangement, polygon, rest_metric(mesh.ancestors, ancestor), triangles);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      mesh.buffers.render_triangles[polygon.triangles[k].index()] = render_triangle(polygon, triangles[k]);
      log.render_triangles.push_back(polygon.triangles[k].value);
    }
  }
}

void update_vertex_nodes(HybridMesh& mesh, const Executor& executor, ChangeLog& log) {
  lattice::sort_unique(log.triangles);
  /// @return whether it had others  @pre no other thread looks at a vertex of this triangle
  const auto update = [&](RenderVertexId v, TriangleId triangle) {
    RenderVertex& vertex = mesh.buffers.render_vertices[v.index()];
    const auto& nodes = mesh.buffers.triangles[triangle.index()].nodes;
    if (vertex.triangle != triangle || vertex.nodes == nodes) return false;
    vertex.nodes = nodes;
    return true;
  };
  std::vector<AncestorId> cut_ancestors;
  for (const std::uint32_t index : log.triangles) {
    const AncestorId ancestor = mesh.buffers.triangles[index].ancestor;
    if (!ancestor.valid()) continue;
    if (mesh.arrangement(ancestor) != nullptr)
      cut_ancestors.push_back(ancestor);
    else
      for (const RenderVertexId v : mesh.buffers.render_triangles[index].vertices)
        if (update(v, TriangleId{index})) log.render_vertices.push_back(v.value);
  }
  lattice::sort_unique(cut_ancestors);
  std::vector<std::vector<std::uint32_t>> updated(cut_ancestors.size());
  executor.for_each(cut_ancestors.size(), [&](std::size_t i) {
    for (const RenderPolygon& polygon : mesh.arrangement(cut_ancestors[i])->polygons)
      if (std::binary_search(log.triangles.begin(), log.triangles.end(), polygon.triangle.value))
        for (const PolygonCorner& c : polygon.corners)
          if (update(c.vertex, polygon.triangle)) updated[i].push_back(c.vertex.value);
  });
  for (const auto& list : updated)
    log.render_vertices.insert(log.render_vertices.end(), list.begin(), list.end());
}

}  // namespace cut

#include "cutting/triangulate_polygons.hpp"

#include <algorithm>

#include "lattice/sort_unique.hpp"
#include "lattice/triangulation.hpp"

namespace cut {

namespace {

/// Triangles of all polygons of one arrangement, as corners of their polygon.
struct Triangulation {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::size_t> ends;  ///< per polygon: where its triangles end
};

Triangulation triangulation_of(const Arrangement& arrangement, const lattice::Metric& metric) {
  Triangulation result;
  lattice::TriangulationScratch scratch;
  std::vector<LatticePoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const RenderPolygon& polygon : arrangement.polygons) {
    points.clear();
    for (const PolygonCorner& c : polygon.corners) points.push_back(arrangement.nodes[c.node].point);
    lattice::triangulate(points, polygon.loop_ends, metric, triangles, scratch);
    result.triangles.insert(result.triangles.end(), triangles.begin(), triangles.end());
    result.ends.push_back(result.triangles.size());
  }
  return result;
}

}  // namespace

void triangulate_polygons(HybridMesh& mesh, std::span<const TriangleWork> works, const Executor& executor,
                          ChangeLog& log) {
  std::vector<Triangulation> triangulations(works.size());
  executor.for_each(works.size(), [&](std::size_t i) {
    triangulations[i] = triangulation_of(*mesh.arrangement(works[i].ancestor), works[i].metric);
  });
  std::vector<RenderTriangleId> idle;
  auto& render_triangles = mesh.buffers.render_triangles;
  for (std::size_t w = 0; w < works.size(); ++w) {
    const TriangleWork& work = works[w];
    const Triangulation& triangulation = triangulations[w];
    idle.clear();
    for (const RenderPolygon& polygon : work.before.polygons)
      idle.insert(idle.end(), polygon.triangles.begin(), polygon.triangles.end());
    std::sort(idle.begin(), idle.end(), std::greater<>());
    Arrangement& arrangement = mesh.arrangements[mesh.arrangement_of[work.ancestor.index()]];
    std::size_t next = 0;
    for (std::size_t p = 0; p < arrangement.polygons.size(); ++p) {
      RenderPolygon& polygon = arrangement.polygons[p];
      polygon.triangles.clear();
      for (; next < triangulation.ends[p]; ++next) {
        const auto& t = triangulation.triangles[next];
        RenderTriangleId id{render_triangles.size()};
        if (!idle.empty()) {
          id = idle.back();
          idle.pop_back();
        } else if (!mesh.free_render_triangles.empty()) {
          id = mesh.free_render_triangles.back();
          mesh.free_render_triangles.pop_back();
        } else {
          render_triangles.emplace_back();
        }
        render_triangles[id.index()] = {
            {polygon.corners[t[0]].vertex, polygon.corners[t[1]].vertex, polygon.corners[t[2]].vertex},
            polygon.triangle};
        log.render_triangles.push_back(id.value);
        polygon.triangles.push_back(id);
      }
    }
    for (const RenderTriangleId id : idle) {
      render_triangles[id.index()] = RenderTriangle{};
      log.render_triangles.push_back(id.value);
      mesh.free_render_triangles.push_back(id);
    }
  }
}

void triangulate_again(HybridMesh& mesh, std::span<const std::pair<AncestorId, std::uint32_t>> polygons,
                       ChangeLog& log) {
  for (const auto& [ancestor, p] : polygons) {
    const Arrangement& arrangement = *mesh.arrangement(ancestor);
    const RenderPolygon& polygon = arrangement.polygons[p];
    std::vector<LatticePoint> points;
    for (const PolygonCorner& c : polygon.corners) points.push_back(arrangement.nodes[c.node].point);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    lattice::TriangulationScratch scratch;
    lattice::triangulate(points, polygon.loop_ends, rest_metric(mesh.ancestors, ancestor), triangles,
                         scratch);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto& t = triangles[k];
      const RenderTriangleId id = polygon.triangles[k];
      mesh.buffers.render_triangles[id.index()].vertices = {
          polygon.corners[t[0]].vertex, polygon.corners[t[1]].vertex, polygon.corners[t[2]].vertex};
      log.render_triangles.push_back(id.value);
    }
  }
}

void update_vertex_nodes(HybridMesh& mesh, ChangeLog& log) {
  lattice::sort_unique(log.triangles);
  const auto update = [&](RenderVertexId v, TriangleId triangle) {
    RenderVertex& vertex = mesh.buffers.render_vertices[v.index()];
    const auto& nodes = mesh.buffers.triangles[triangle.index()].nodes;
    if (vertex.triangle != triangle || vertex.nodes == nodes) return;
    vertex.nodes = nodes;
    log.render_vertices.push_back(v.value);
  };
  std::vector<AncestorId> cut_ancestors;
  for (const std::uint32_t index : log.triangles) {
    const AncestorId ancestor = mesh.buffers.triangles[index].ancestor;
    if (!ancestor.valid()) continue;
    if (mesh.arrangement(ancestor) != nullptr)
      cut_ancestors.push_back(ancestor);
    else
      for (const RenderVertexId v : mesh.buffers.render_triangles[index].vertices)
        update(v, TriangleId{index});
  }
  lattice::sort_unique(cut_ancestors);
  for (const AncestorId ancestor : cut_ancestors)
    for (const RenderPolygon& polygon : mesh.arrangement(ancestor)->polygons)
      if (std::binary_search(log.triangles.begin(), log.triangles.end(), polygon.triangle.value))
        for (const PolygonCorner& c : polygon.corners) update(c.vertex, polygon.triangle);
}

}  // namespace cut

#include "cutting/triangulate_polygons.hpp"

#include <algorithm>

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
  std::vector<std::size_t> ends;  ///< per polygon: where its triangles end
};

Triangulation triangulation_of(const Arrangement& arrangement, const lattice::Metric& metric) {
  Triangulation result;
  Triangulator triangulator;
  CornerTriangles triangles;
  for (const RenderPolygon& polygon : arrangement.polygons) {
    triangulator.triangulate(arrangement, polygon, metric, triangles);
    result.triangles.insert(result.triangles.end(), triangles.begin(), triangles.end());
    result.ends.push_back(result.triangles.size());
  }
  return result;
}

void write(HybridMesh& mesh, RenderTriangleId id, const RenderPolygon& polygon,
           const std::array<std::uint32_t, 3>& corners, ChangeLog& log) {
  mesh.buffers.render_triangles[id.index()] = {
      {polygon.corners[corners[0]].vertex, polygon.corners[corners[1]].vertex,
       polygon.corners[corners[2]].vertex},
      polygon.triangle};
  log.render_triangles.push_back(id.value);
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
        write(mesh, id, polygon, triangulation.triangles[next], log);
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
  Triangulator triangulator;
  CornerTriangles triangles;
  for (const auto& [ancestor, p] : polygons) {
    const Arrangement& arrangement = *mesh.arrangement(ancestor);
    const RenderPolygon& polygon = arrangement.polygons[p];
    triangulator.triangulate(arrangement, polygon, rest_metric(mesh.ancestors, ancestor), triangles);
    for (std::size_t k = 0; k < triangles.size(); ++k)
      write(mesh, polygon.triangles[k], polygon, triangles[k], log);
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

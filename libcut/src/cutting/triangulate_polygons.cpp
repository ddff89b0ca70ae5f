#include "cutting/triangulate_polygons.hpp"

#include <algorithm>
#include <utility>

#include "cutting/in_parts.hpp"
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

/// Triangles of all polygons of some arrangements, one list after the other.
struct Triangulation {
  struct Work {
    std::size_t triangles_end;
    std::size_t kept;  ///< so many of its triangles take entries that the ancestor had before
    std::size_t freed_end;
  };
  std::vector<Work> works;
  CornerTriangles triangles;
  std::vector<std::size_t> ends;        ///< per polygon: where its triangles end
  std::vector<RenderTriangleId> ids;    ///< per triangle: its entry
  std::vector<RenderTriangleId> freed;  ///< entries that the ancestors had before and do not need any more
  std::vector<RenderTriangleId> old;    ///< working memory
  std::size_t next = 0;                 ///< triangle to be written, and ...
  std::size_t next_polygon = 0;         ///< ... its polygon
};

/// Appends those of one work.
void triangulate(const HybridMesh& mesh, const TriangleWork& work, Triangulation& all) {
  SNIP_PER_THREAD Triangulator triangulator;
  SNIP_PER_THREAD CornerTriangles triangles;
  const std::size_t first = all.triangles.size();
  const Arrangement& arrangement = *mesh.arrangement(work.ancestor);
  for (const RenderPolygon& polygon : arrangement.polygons) {
    triangulator.triangulate(arrangement, polygon, work.metric, triangles);
    append(all.triangles, triangles);
    all.ends.push_back(all.triangles.size());
  }
  all.old.clear();
  for (const RenderPolygon& polygon : work.before.polygons) append(all.old, polygon.triangles);
  std::sort(all.old.begin(), all.old.end());
  for (; all.old.size() > all.triangles.size() - first; all.old.pop_back())
    all.freed.push_back(all.old.back());
  append(all.ids, all.old);
  all.ids.resize(all.triangles.size());
  all.works.push_back({all.triangles.size(), all.old.size(), all.freed.size()});
}

RenderTriangle render_triangle(const RenderPolygon& polygon, const std::array<std::uint32_t, 3>& corners) {
  return {{polygon.corners[corners[0]].vertex, polygon.corners[corners[1]].vertex,
           polygon.corners[corners[2]].vertex},
          polygon.triangle};
}

/// Entries for all triangles that have none: free ones, then new ones.
void allocate(HybridMesh& mesh, std::vector<Triangulation>& parts, ChangeLog& log) {
  auto& entries = mesh.buffers.render_triangles;
  auto& free = mesh.free_render_triangles;
  std::size_t next = entries.size();
  for (Triangulation& part : parts) {
    std::size_t triangle = 0, freed = 0;
    for (const Triangulation::Work& work : part.works) {
      for (; freed < work.freed_end; ++freed) {
        const RenderTriangleId id = part.freed[freed];
        entries[id.index()] = RenderTriangle{};
        log.render_triangles.push_back(id.value);
        free.push_back(id);
      }
      for (triangle += work.kept; triangle < work.triangles_end; ++triangle) {
        if (free.empty()) {
          part.ids[triangle] = RenderTriangleId{next++};
        } else {
          part.ids[triangle] = free.back();
          free.pop_back();
        }
      }
    }
  }
  entries.resize(next);
}

/// Writes the triangles of the next arrangement.
void write_triangles(HybridMesh& mesh, Arrangement& arrangement, Triangulation& part) {
  for (RenderPolygon& polygon : arrangement.polygons) {
    const std::size_t end = part.ends[part.next_polygon++];
    const auto id = [&](std::size_t i) { return part.ids.begin() + static_cast<std::ptrdiff_t>(i); };
    polygon.triangles.assign(id(part.next), id(end));
    for (; part.next < end; ++part.next)
      mesh.buffers.render_triangles[part.ids[part.next].index()] =
          render_triangle(polygon, part.triangles[part.next]);
  }
}

}  // namespace

void triangulate_polygons(HybridMesh& mesh, std::span<const TriangleWork> works, const Executor& executor,
                          ChangeLog& log) {
  auto parts = in_parts<Triangulation>(
      executor, works.size(), [&](std::size_t i, Triangulation& part) { triangulate(mesh, works[i], part); },
      1);
  allocate(mesh, parts, log);
  for_parts(
      executor, works.size(), parts,
      [&](std::size_t i, Triangulation& part) {
        write_triangles(mesh, mesh.arrangements[mesh.arrangement_of[works[i].ancestor.index()]], part);
      },
      1);
  for (const Triangulation& part : parts)
    for (const RenderTriangleId id : part.ids) log.render_triangles.push_back(id.value);
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
  for (const auto& list : updated) append(log.render_vertices, list);
}

}  // namespace cut

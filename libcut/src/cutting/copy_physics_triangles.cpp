#include "cutting/copy_physics_triangles.hpp"

#include <algorithm>
#include <utility>

#include "cutting/edge_state.hpp"
#include "cutting/in_parts.hpp"

namespace cut {

namespace {

/// What some works add to the mesh.
struct Added {
  std::uint32_t triangles = 0;     ///< how many; then where the next one goes
  std::uint32_t arrangements = 0;  ///< the same
  std::vector<std::uint32_t> written;
  std::vector<AncestorEdgeId> edges;
  std::vector<AncestorNodeId> touched;
};

/// Calls copy(source, polygon) for each polygon that gets a triangle of its own, keep(source, polygon) for
/// that which keeps its triangle, and remove(source) where rounding has left nothing of a polygon.
template <class Copy, class Keep, class Remove>
void share_out(const TriangleWork& work, const Copy& copy, const Keep& keep, const Remove& remove) {
  const DisjointPolygons& polygons = work.polygons;
  for (std::uint32_t old = 0; old < work.before.polygons.size(); ++old) {
    const TriangleId source = work.before.polygons[old].triangle;
    std::uint32_t largest = HybridMesh::none;
    for (std::uint32_t p = 0; p < polygons.parent.size(); ++p)
      if (polygons.parent[p] == old &&
          (largest == HybridMesh::none || polygons.doubled_area[p] > polygons.doubled_area[largest]))
        largest = p;
    if (largest == HybridMesh::none) {
      remove(source);
      continue;
    }
    keep(source, largest);
    for (std::uint32_t p = 0; p < polygons.parent.size(); ++p)
      if (polygons.parent[p] == old && p != largest) copy(source, p);
  }
}

void count(const HybridMesh& mesh, const TriangleWork& work, Added& added) {
  const auto nothing = [](auto...) {};
  share_out(work, [&](TriangleId, std::uint32_t) { ++added.triangles; }, nothing, nothing);
  if (mesh.arrangement(work.ancestor) == nullptr) ++added.arrangements;
}

void copy_triangles(HybridMesh& mesh, TriangleWork& work, Added& added, std::span<TriangleCopy> copies) {
  Arrangement& arrangement = work.polygons.arrangement;
  auto& triangles = mesh.buffers.triangles;
  const std::size_t before = triangles.size() - copies.size();
  const std::size_t written = added.written.size();
  share_out(
      work,
      [&](TriangleId source, std::uint32_t polygon) {
        const TriangleId copy{added.triangles++};
        triangles[copy.index()] = triangles[source.index()];
        copies[copy.index() - before] = {copy, source};
        arrangement.polygons[polygon].triangle = copy;
        added.written.push_back(copy.value);
      },
      [&](TriangleId source, std::uint32_t polygon) { arrangement.polygons[polygon].triangle = source; },
      [&](TriangleId source) {
        triangles[source.index()].ancestor = AncestorId{};
        added.written.push_back(source.value);
      });
  std::uint32_t& index = mesh.arrangement_of[work.ancestor.index()];
  if (index == HybridMesh::none) index = added.arrangements++;
  mesh.arrangements[index] = std::move(arrangement);
  work.polygons = {};
  const Ancestor& ancestor = mesh.ancestors.triangles[work.ancestor.index()];
  append(added.edges, ancestor.edges);
  if (added.written.size() > written) append(added.touched, ancestor.nodes);
}

}  // namespace

std::vector<AncestorNodeId> copy_physics_triangles(HybridMesh& mesh, std::span<TriangleWork> works,
                                                   const Executor& executor, ChangeLog& log) {
  auto parts = in_parts<Added>(executor, works.size(),
                               [&](std::size_t i, Added& added) { count(mesh, works[i], added); });
  auto& triangles = mesh.buffers.triangles;
  const std::size_t before = triangles.size();
  std::size_t all = before, arrangements = mesh.arrangements.size();
  for (Added& added : parts) {
    all += std::exchange(added.triangles, static_cast<std::uint32_t>(all));
    arrangements += std::exchange(added.arrangements, static_cast<std::uint32_t>(arrangements));
  }
  triangles.resize(all);
  mesh.arrangements.resize(arrangements);
  log.triangle_copies.resize(all - before);
  for_parts(executor, works.size(), parts,
            [&](std::size_t i, Added& added) { copy_triangles(mesh, works[i], added, log.triangle_copies); });
  std::vector<AncestorNodeId> touched;
  for (const Added& added : parts) {
    append(log.triangles, added.written);
    append(log.edges, added.edges);
    append(touched, added.touched);
  }
  return touched;
}

std::vector<AncestorEdgeId> cut_edge_sections(HybridMesh& mesh, const TriangleWork& work) {
  std::vector<AncestorEdgeId> changed;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& cuts = work.cut_sections[i];
    if (std::find(cuts.begin(), cuts.end(), 1) == cuts.end()) continue;
    if (!mesh.ancestors.neighbour(work.ancestor, i).valid()) continue;
    const AncestorEdgeId edge = mesh.ancestors.triangles[work.ancestor.index()].edges[i];
    EdgeState& state = edge_state_for_writing(mesh, edge);
    const bool reversed = mesh.ancestors.reversed(work.ancestor, i);
    bool any = false;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      std::uint8_t& cut = state.cut[reversed ? cuts.size() - 1 - k : k];
      any = any || (cuts[k] != 0 && cut == 0);
      cut = cut | cuts[k];
    }
    if (any) changed.push_back(edge);
  }
  return changed;
}

}  // namespace cut

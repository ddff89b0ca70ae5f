#include "cutting/copy_physics_triangles.hpp"

#include <algorithm>
#include <utility>

#include "cutting/edge_state.hpp"

namespace cut {

bool copy_physics_triangles(HybridMesh& mesh, const TriangleWork& work, DisjointPolygons&& polygons,
                            ChangeLog& log) {
  Arrangement& arrangement = polygons.arrangement;
  auto& triangles = mesh.buffers.triangles;
  bool changed = false;
  for (std::uint32_t old = 0; old < work.before.polygons.size(); ++old) {
    const TriangleId source = work.before.polygons[old].triangle;
    std::uint32_t largest = HybridMesh::none;
    for (std::uint32_t p = 0; p < polygons.parent.size(); ++p)
      if (polygons.parent[p] == old &&
          (largest == HybridMesh::none || polygons.doubled_area[p] > polygons.doubled_area[largest]))
        largest = p;
    if (largest == HybridMesh::none) {  // rounding has left nothing of it
      triangles[source.index()].ancestor = AncestorId{};
      log.triangles.push_back(source.value);
      changed = true;
      continue;
    }
    arrangement.polygons[largest].triangle = source;
    for (std::uint32_t p = 0; p < polygons.parent.size(); ++p) {
      if (polygons.parent[p] != old || p == largest) continue;
      const TriangleId copy{triangles.size()};
      triangles.push_back(PhysicsTriangle{triangles[source.index()]});
      arrangement.polygons[p].triangle = copy;
      log.triangles.push_back(copy.value);
      log.triangle_copies.push_back({copy, source});
      changed = true;
    }
  }
  std::uint32_t& index = mesh.arrangement_of[work.ancestor.index()];
  if (index == HybridMesh::none) {
    index = static_cast<std::uint32_t>(mesh.arrangements.size());
    mesh.arrangements.push_back(std::move(arrangement));
  } else {
    mesh.arrangements[index] = std::move(arrangement);
  }
  return changed;
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

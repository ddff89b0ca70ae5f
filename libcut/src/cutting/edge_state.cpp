#include "cutting/edge_state.hpp"

#include <algorithm>
#include <array>

namespace cut {

EdgeState& edge_state_for_writing(HybridMesh& mesh, AncestorEdgeId edge) {
  if (mesh.edge_state_of[edge.index()] == HybridMesh::none)
    number_edge_states(mesh, std::array{edge}, [](AncestorEdgeId e) { return e; });
  EdgeState& state = mesh.edge_states[mesh.edge_state_of[edge.index()]];
  if (state.cut.empty()) state = {{}, {0}, {SpringId{edge.index()}}};
  return state;
}

void insert_boundary_node(EdgeState& state, std::int32_t t, std::uint32_t stamp) {
  const auto at = std::lower_bound(state.nodes.begin(), state.nodes.end(), t,
                                   [](const BoundaryNode& n, std::int32_t value) { return n.t < value; });
  const auto section = at - state.nodes.begin();
  state.cut.insert(state.cut.begin() + section, state.cut[static_cast<std::size_t>(section)]);
  state.nodes.insert(at, {t, stamp});
}

void stamp_edge_node(HybridMesh& mesh, AncestorEdgeId edge, std::int32_t t, std::uint32_t stamp) {
  const auto& ends = mesh.ancestors.edges[edge.index()].nodes;
  if (t == 0 || t == lattice_size) {
    mesh.node_stamps[ends[t == 0 ? 0 : 1].index()] = stamp;
    return;
  }
  for (BoundaryNode& n : edge_state_for_writing(mesh, edge).nodes)
    if (n.t == t) n.stamp = stamp;
}

std::vector<LatticePoint> boundary_points(const HybridMesh& mesh, AncestorId triangle, std::size_t i) {
  std::vector<LatticePoint> points;
  const EdgeState* state = mesh.edge_state(mesh.ancestors.triangles[triangle.index()].edges[i]);
  if (state == nullptr) return points;
  for (const BoundaryNode& n : state->nodes)
    points.push_back(point_along_edge(mesh.ancestors, triangle, i, n.t));
  if (mesh.ancestors.reversed(triangle, i)) std::reverse(points.begin(), points.end());
  return points;
}

}  // namespace cut

#include "simulation/meshes.hpp"

namespace testing {

cut::Changes cut_apart(cut::HybridMesh& mesh, const std::vector<std::vector<cut::LatticePoint>>& polygons,
                       const std::vector<std::size_t>& parents) {
  cut::Changes changes;
  cut::Buffers& buffers = mesh.buffers;
  changes.version_before = mesh.topology_version;
  changes.version_after = ++mesh.topology_version;
  if (mesh.arrangements.empty()) {
    mesh.arrangements.emplace_back();
    mesh.arrangement_of[0] = 0;
    mesh.edge_states.resize(3);
    for (std::uint32_t e = 0; e < 3; ++e) {
      mesh.edge_state_of[e] = e;
      mesh.edge_states[e].springs = {cut::SpringId{e}};
    }
  }
  cut::Arrangement& arrangement = mesh.arrangements[0];
  const std::size_t old_count = buffers.triangles.size();
  arrangement.nodes.clear();
  arrangement.polygons.clear();
  for (std::size_t i = 0; i < 3; ++i) arrangement.nodes.push_back({cut::lattice_corner(i)});
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    cut::RenderPolygon polygon;
    polygon.triangle = cut::TriangleId{p};
    for (const cut::LatticePoint point : polygons[p]) {
      std::uint32_t node = static_cast<std::uint32_t>(cut::corner_of(point));
      if (node == 3) {
        node = static_cast<std::uint32_t>(arrangement.nodes.size());
        arrangement.nodes.push_back({point});
      }
      polygon.corners.push_back({node, {}});
    }
    polygon.loop_ends = {static_cast<std::uint32_t>(polygon.corners.size())};
    arrangement.polygons.push_back(polygon);
    if (p < old_count) continue;

    const cut::PhysicsTriangle source = buffers.triangles[parents[p]];
    cut::PhysicsTriangle copy = source;
    for (std::size_t i = 0; i < 3; ++i) {
      copy.nodes[i] = cut::NodeId{buffers.nodes.size()};
      buffers.nodes.push_back(buffers.nodes[source.nodes[i].index()]);
      mesh.positions.push_back(mesh.positions[source.nodes[i].index()]);
      changes.node_copies.push_back({copy.nodes[i], source.nodes[i]});
      changes.nodes.entries.push_back({copy.nodes[i].value, buffers.nodes.back()});
    }
    changes.triangle_copies.push_back({cut::TriangleId{p}, cut::TriangleId{parents[p]}});
    changes.triangles.entries.push_back({static_cast<std::uint32_t>(p), copy});
    buffers.triangles.push_back(copy);
    for (std::size_t i = 0; i < 3; ++i) {
      const cut::AncestorEdgeId edge = mesh.ancestors.triangles[0].edges[i];
      cut::Spring spring{{copy.nodes[i], copy.nodes[cut::next_corner(i)]}, edge};
      if (mesh.ancestors.reversed(cut::AncestorId{0}, i)) std::swap(spring.nodes[0], spring.nodes[1]);
      mesh.edge_states[edge.index()].springs.emplace_back(buffers.springs.size());
      changes.springs.entries.push_back({static_cast<std::uint32_t>(buffers.springs.size()), spring});
      buffers.springs.push_back(spring);
    }
  }
  // A fragment that only became smaller shows in the render buffers of a real cut.
  changes.triangles.entries.insert(changes.triangles.entries.begin(), {0, buffers.triangles[0]});
  changes.nodes.size_after = buffers.nodes.size();
  changes.triangles.size_after = buffers.triangles.size();
  changes.springs.size_after = buffers.springs.size();
  return changes;
}

}  // namespace testing

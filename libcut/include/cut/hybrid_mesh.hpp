/// @file
/// The hybrid mesh (§3.2): the physics mesh that is simulated, and in each physics triangle a render polygon
/// that follows the cuts. docs/data_model.md explains it with pictures.
///
/// What a cut cannot change (the triangles, nodes and edges of the uncut mesh, called ancestors) is kept
/// apart from what it does change. The state of all cuts is: an Arrangement for each ancestor that was cut,
/// and for each ancestor edge its boundary nodes and which sections between them are cut. Everything in
/// `buffers` follows from that.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cut/arrangement.hpp"
#include "cut/buffers.hpp"
#include "cut/error.hpp"
#include "cut/ids.hpp"
#include "cut/triangle_mesh.hpp"

namespace cut {

/// A triangle of the uncut mesh. Edge i joins corners i and i + 1. Corner 0 is the one with the smallest rest
/// position (by x, then y, then z), so that results do not depend on how the input numbers its nodes.
struct Ancestor {
  std::array<AncestorNodeId, 3> nodes;
  std::array<AncestorEdgeId, 3> edges;
};

/// An edge of the uncut mesh, directed from the smaller rest position to the larger. A border edge has one
/// triangle.
struct AncestorEdge {
  std::array<AncestorNodeId, 2> nodes;
  std::array<AncestorId, 2> triangles;
};

/// A boundary node: t lattice units from the start of its edge, 0 < t < N.
struct BoundaryNode {
  std::int32_t t = 0;
  std::uint32_t stamp = 0;  ///< number of the last call to cut that this node was part of
  bool operator==(const BoundaryNode&) const = default;
};

/// What cuts made of one ancestor edge.
struct EdgeState {
  std::vector<BoundaryNode> nodes;  ///< by increasing t
  std::vector<std::uint8_t> cut{
      0};                         ///< per section: 1 where the two sides are no longer joined (contour edges)
  std::vector<SpringId> springs;  ///< the springs between copies of the edge's two nodes
  bool operator==(const EdgeState&) const = default;
};

/// The uncut mesh: never changes after `build`.
struct AncestorMesh {
  std::vector<Eigen::Vector3d> rest_positions;  ///< per node, tension-free
  std::vector<Ancestor> triangles;
  std::vector<AncestorEdge> edges;
  std::vector<std::uint32_t> first_incidence;  ///< per node (+1): where its triangles start in `incidences`
  std::vector<AncestorId> incidences;          ///< triangles around each node
  std::vector<std::uint32_t> input_node;  ///< per node: its index in the input (a node where the surface only
                                          ///< touches itself in a point becomes one node for each fan)
  std::vector<std::uint8_t> input_corner;  ///< per triangle: which corner of the input triangle is corner 0

  [[nodiscard]] std::span<const AncestorId> triangles_around(AncestorNodeId node) const {
    return {incidences.data() + first_incidence[node.index()],
            incidences.data() + first_incidence[node.index() + 1]};
  }
  /// The index that `edge` has in triangle `t`. @pre it is one of its edges
  [[nodiscard]] std::size_t local_edge(AncestorId t, AncestorEdgeId edge) const {
    const auto& edges_of_t = triangles[t.index()].edges;
    return edges_of_t[0] == edge ? 0 : (edges_of_t[1] == edge ? 1 : 2);
  }
  /// The index that `node` has in triangle `t`. @pre it is one of its nodes
  [[nodiscard]] std::size_t local_node(AncestorId t, AncestorNodeId node) const {
    const auto& nodes_of_t = triangles[t.index()].nodes;
    return nodes_of_t[0] == node ? 0 : (nodes_of_t[1] == node ? 1 : 2);
  }
  /// True when edge i of triangle t runs against the direction of its ancestor edge.
  [[nodiscard]] bool reversed(AncestorId t, std::size_t i) const {
    return edges[triangles[t.index()].edges[i].index()].nodes[0] != triangles[t.index()].nodes[i];
  }
  /// The triangle on the other side of edge i of t; invalid at the border.
  [[nodiscard]] AncestorId neighbour(AncestorId t, std::size_t i) const {
    const auto& sides = edges[triangles[t.index()].edges[i].index()].triangles;
    return sides[0] == t ? sides[1] : sides[0];
  }
  /// Tension-free length of an edge.
  [[nodiscard]] double rest_length(AncestorEdgeId edge) const {
    const auto& ends = edges[edge.index()].nodes;
    const Eigen::Vector3d d = rest_positions[ends[1].index()] - rest_positions[ends[0].index()];
    return std::sqrt((d.x() * d.x() + d.y() * d.y()) + d.z() * d.z());  // this order, for every compiler
  }
};

struct HybridMesh {
  AncestorMesh ancestors;
  Buffers buffers;
  /// Per physics node: where it is now. Write to it freely, then call `moved()`.
  std::vector<Eigen::Vector3d> positions;

  // State of the cuts. Only Cutter changes it.
  std::vector<Arrangement> arrangements;
  std::vector<EdgeState> edge_states;
  std::vector<std::uint32_t> arrangement_of;  ///< per ancestor: index into `arrangements`, or `none`
  std::vector<std::uint32_t> edge_state_of;   ///< per ancestor edge: index into `edge_states`, or `none`
  std::vector<std::uint32_t> node_stamps;     ///< per ancestor node: last call to cut that it was part of
  std::vector<RenderVertexId> free_render_vertices;
  std::vector<RenderTriangleId> free_render_triangles;
  std::uint32_t cut_count = 0;  ///< number of calls to cut so far
  /// Names this state of positions and cuts. `build`, `moved` and each cut that changes anything draw a new
  /// number; only copies of a mesh have the same.
  std::uint64_t state = 0;
  std::uint64_t topology_version = 0;  ///< counts cuts that changed anything

  static constexpr std::uint32_t none = 0xffffffffu;

  /// Builds the hybrid mesh of an uncut cloth: one physics triangle and one congruent render triangle for
  /// each triangle of `mesh`, all lengths tension-free as given. Physics triangle i is triangle i of the
  /// input. Errors: empty_mesh, index_out_of_range, not_finite (or 1e50 and beyond), degenerate_triangle (see
  /// has_area), duplicate_triangle, non_manifold_edge, too_large. Complexity: O(n log n).
  [[nodiscard]] static Result<HybridMesh> build(const TriangleMesh& mesh);

  /// Tells that positions were written to: the next cut then looks at all of them.
  void moved();

  [[nodiscard]] const Arrangement* arrangement(AncestorId t) const {
    const std::uint32_t i = arrangement_of[t.index()];
    return i == none ? nullptr : &arrangements[i];
  }
  [[nodiscard]] const EdgeState* edge_state(AncestorEdgeId e) const {
    const std::uint32_t i = edge_state_of[e.index()];
    return i == none ? nullptr : &edge_states[i];
  }
  /// The physics triangles that ancestor t has become: t itself while it is uncut.
  [[nodiscard]] std::size_t fragment_count(AncestorId t) const {
    const Arrangement* a = arrangement(t);
    return a ? a->polygons.size() : 1;
  }
  [[nodiscard]] TriangleId fragment(AncestorId t, std::size_t polygon) const {
    const Arrangement* a = arrangement(t);
    return a ? a->polygons[polygon].triangle : TriangleId{t.index()};
  }
  /// Position in space of a render vertex, as things are now.
  [[nodiscard]] Eigen::Vector3d position(const RenderVertex& v) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      if (v.point[i] != 0)
        sum += positions[v.nodes[i].index()] * (static_cast<double>(v.point[i]) / lattice_size);
    return sum;
  }
};

}  // namespace cut

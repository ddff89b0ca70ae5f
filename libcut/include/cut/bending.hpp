/// @file
/// Who resists bending at an edge (§7): the two opposite corners of triangles that share it. In: a hybrid
/// mesh, cut or not, and an edge of the uncut mesh. Out: the pairs of physics nodes to join by a spring, and
/// how much of the edge each pair has.
///
/// Pairs follow from the state of the cuts and are stored nowhere. `Changes::edges` names the edges whose
/// pairs a cut may have changed.
#pragma once
#include <array>
#include <vector>

#include "cut/hybrid_mesh.hpp"

namespace cut {

/// A fragment on one side of an edge and one on the other that hang together along a part of it.
struct BendingPair {
  std::array<NodeId, 2>
      nodes;  ///< the corners opposite of the edge: a copy of the opposite node on each side
  std::array<TriangleId, 2> fragments;  ///< of AncestorEdge::triangles[0] and [1]
  std::array<double, 2> bordered;  ///< parts of the edge that each fragment reaches, cut or not: in (0, 1]
  double shared = 0;  ///< part of the edge along which the two hang together: in (0, 1], at most `bordered`
  bool operator==(const BendingPair&) const = default;
};

/// All pairs at an edge, by increasing fragments; none at a border edge. Two pairs may have the same nodes,
/// where fragments hang together elsewhere. The `shared` of all pairs at an edge sum up to the part of it
/// that is uncut. Cost: that of the edge's sections.
[[nodiscard]] std::vector<BendingPair> bending_pairs(const HybridMesh& mesh, AncestorEdgeId edge);

/// Tension-free distance of the two corners opposite of an edge, along a straight line: the rest length of
/// their spring. @pre the edge has two triangles
[[nodiscard]] double bending_rest_length(const AncestorMesh& ancestors, AncestorEdgeId edge);

}  // namespace cut

/// @file
/// The change set that a cut returns: which entries of the flat arrays have which new value, and where copies
/// came from.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/buffers.hpp"

namespace cut {

/// New values for single entries of one array, by increasing index, and the array's new size.
template <class T>
struct ArrayChanges {
  struct Entry {
    std::uint32_t index;
    T value;
  };
  std::vector<Entry> entries;
  std::size_t size_after = 0;
};

/// `node` is a copy of `source`: same position, same velocity.
struct NodeCopy {
  NodeId node;
  NodeId source;
};

/// `triangle` was cut off from `source`: same ancestor, same rest shape.
struct TriangleCopy {
  TriangleId triangle;
  TriangleId source;
};

/// `spring` joins copies of what `source` joins, or still one of its ends: same ancestor edge, same rest
/// length. A spring keeps its entry while any pair that comes from its own is left, so that what a simulator
/// keeps for each spring need only be copied to these.
struct SpringCopy {
  SpringId spring;
  SpringId source;
};

struct Changes {
  std::uint64_t version_before = 0;  ///< HybridMesh::topology_version that this applies to
  std::uint64_t version_after = 0;
  std::vector<NodeCopy> node_copies;          ///< in the order of creation
  std::vector<TriangleCopy> triangle_copies;  ///< in the order of creation
  std::vector<SpringCopy> spring_copies;      ///< in the order of creation
  /// Edges of the uncut mesh beside which something changed, sorted: a fragment, a corner's node, a section
  /// that was cut. `bending_pairs` of all others are as before.
  std::vector<AncestorEdgeId> edges;
  ArrayChanges<AncestorNodeId> nodes;
  ArrayChanges<PhysicsTriangle> triangles;
  ArrayChanges<Spring> springs;
  ArrayChanges<RenderVertex> render_vertices;
  ArrayChanges<RenderTriangle> render_triangles;

  [[nodiscard]] bool empty() const { return version_before == version_after; }
};

/// Brings a copy of the buffers from version_before to version_after. O(changes).
/// @pre `buffers` equals the mesh's buffers before the cut
void apply(const Changes& changes, Buffers& buffers);

/// The change set that undoes `changes`: from version_after back to version_before, to the bit. Without
/// copies and edges, since nothing is copied on the way back. It is for buffers; a HybridMesh goes back to an
/// earlier state by being copied. O(changes). @pre `before` equals the mesh's buffers before the cut
[[nodiscard]] Changes inverse(const Changes& changes, const Buffers& before);

}  // namespace cut

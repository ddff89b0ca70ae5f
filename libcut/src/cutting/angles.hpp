/// @file
/// The angles that polygons have at nodes of their triangles: what render vertices are found from (§4.6).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"

namespace cut {

/// An angle that a polygon has at a node of its triangle.
struct Angle {
  AncestorId ancestor;
  std::uint32_t node;
  std::uint32_t polygon;
  std::uint32_t corner;
  /// The sections beside it, as indices along their ancestor edges: the one that ends here and the one that
  /// starts here, counterclockwise; an invalid edge where a cut bounds the angle.
  std::array<AncestorEdgeId, 2> edge;
  std::array<std::uint32_t, 2> section{};
};

/// The angles of all triangles around some nodes.
class Angles {
 public:
  Angles(const HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor);

  /// Those of a cut triangle around one of the nodes, sorted by node.
  [[nodiscard]] std::span<const Angle> of(AncestorId a) const;
  /// Appends those that triangle a, cut or not, has at one of its nodes.
  void append_at(AncestorId a, std::uint32_t node, std::vector<Angle>& group) const;
  /// Appends those that triangle a has at the boundary node at t of one of its edges.
  void append_at(AncestorId a, AncestorEdgeId edge, std::int32_t t, std::vector<Angle>& group) const;

 private:
  const HybridMesh& mesh_;
  struct Part {
    std::vector<Angle> angles;
    std::vector<std::size_t> ends;  ///< per triangle
  };
  std::vector<AncestorId> triangles_;  ///< the cut ones, sorted
  std::vector<Part> parts_;            ///< of so many triangles
};

}  // namespace cut

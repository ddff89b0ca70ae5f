/// @file
/// The flat arrays that a simulator and a renderer work on (§3.2). A cut changes single entries of them;
/// entries keep their index for as long as they live, and freed entries of the render arrays are used again.
#pragma once
#include <array>
#include <compare>
#include <vector>

#include "cut/ids.hpp"
#include "cut/lattice_point.hpp"

namespace cut {

using SpringId = Id<struct SpringTag>;
using RenderVertexId = Id<struct RenderVertexTag>;
using RenderTriangleId = Id<struct RenderTriangleTag>;

/// A physics triangle: three physics nodes, and the triangle of the uncut mesh whose shape it keeps. Corner i
/// stands for corner i of the ancestor. A removed triangle has an invalid ancestor.
struct PhysicsTriangle {
  std::array<NodeId, 3> nodes;
  AncestorId ancestor;
  bool operator==(const PhysicsTriangle&) const = default;
};

/// One edge of the MSDM graph: there is exactly one for each pair of physics nodes that some physics triangle
/// joins. nodes[k] is a copy of node k of the ancestor edge, whose rest length it keeps. A removed spring has
/// invalid nodes.
struct Spring {
  std::array<NodeId, 2> nodes;
  AncestorEdgeId edge;
  bool operator==(const Spring&) const = default;
};

/// A vertex of the render mesh: a lattice point of a physics triangle. Its position in space is
/// (b0·p0 + b1·p1 + b2·p2) / N with p_i the positions of `nodes`. A free entry has an invalid triangle.
struct RenderVertex {
  TriangleId triangle;
  std::array<NodeId, 3> nodes;
  LatticePoint point;
  bool operator==(const RenderVertex&) const = default;
};

/// A triangle of the render mesh and the physics triangle that it is part of. A free entry has an invalid
/// triangle.
struct RenderTriangle {
  std::array<RenderVertexId, 3> vertices;
  TriangleId triangle;
  bool operator==(const RenderTriangle&) const = default;
};

struct Buffers {
  std::vector<AncestorNodeId>
      nodes;  ///< per physics node: the node of the uncut mesh that it is or is a copy of
  std::vector<PhysicsTriangle> triangles;
  std::vector<Spring> springs;
  std::vector<RenderVertex> render_vertices;
  std::vector<RenderTriangle> render_triangles;
  bool operator==(const Buffers&) const = default;
};

}  // namespace cut

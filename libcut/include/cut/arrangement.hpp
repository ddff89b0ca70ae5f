/// @file
/// What cuts made of one triangle of the uncut mesh: a planar arrangement of nodes, edges and polygons (§3.2,
/// Figure 2). A triangle that no cut has touched has none.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "cut/buffers.hpp"
#include "cut/ids.hpp"
#include "cut/lattice_point.hpp"

namespace cut {

/// A physics node (corner), boundary node or inner node of the arrangement.
struct ArrangementNode {
  LatticePoint point;
  std::uint32_t stamp = 0;  ///< number of the last call to cut that this node was part of; 0: none
  bool rendered = false;    ///< part of a render polygon's hull or hole since an earlier call (§4.7)
  bool operator==(const ArrangementNode&) const = default;
};

/// A cut inside the triangle, from node `from` to node `to`. It is an internal edge where the same polygon
/// lies on both sides, and two contour edges where the polygons differ.
struct CutEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t left = 0;   ///< index of the polygon on the left of from → to
  std::uint32_t right = 0;  ///< index of the polygon on the right
  double deviation = 0;  ///< how far a node that was dropped from this edge may lie off it (§4.7), a length
  bool operator==(const CutEdge&) const = default;
};

/// A node of a polygon's hull or hole, once for each angle that the polygon has there.
struct PolygonCorner {
  std::uint32_t node = 0;  ///< index into Arrangement::nodes
  RenderVertexId vertex;
  bool operator==(const PolygonCorner&) const = default;
};

/// The render area of one physics triangle. Internal edges are left out.
struct RenderPolygon {
  TriangleId triangle;
  std::vector<PolygonCorner> corners;    ///< all loops one after the other: the counterclockwise hull first
  std::vector<std::uint32_t> loop_ends;  ///< end of each loop in `corners`
  std::vector<RenderTriangleId> triangles;
  bool operator==(const RenderPolygon&) const = default;
};

struct Arrangement {
  /// Corners 0, 1, 2, then the boundary nodes of edges 0, 1, 2 in counterclockwise order, then the inner
  /// nodes.
  std::vector<ArrangementNode> nodes;
  std::array<std::uint32_t, 3> boundary_counts{};  ///< number of boundary nodes on each edge
  std::vector<CutEdge> edges;                      ///< sorted by (from, to), from < to
  std::vector<RenderPolygon> polygons;
  /// Polygon at each section of edge i, counterclockwise: section k lies between node k and k + 1 of that
  /// edge.
  std::array<std::vector<std::uint32_t>, 3> section_polygons;

  bool operator==(const Arrangement&) const = default;

  /// Index of the k-th node along edge i, counterclockwise; 0 is the corner that the edge starts at.
  [[nodiscard]] std::uint32_t edge_node(std::size_t i, std::uint32_t k) const {
    if (k == 0) return static_cast<std::uint32_t>(i);
    if (k == boundary_counts[i] + 1) return static_cast<std::uint32_t>(next_corner(i));
    std::uint32_t first = 3;
    for (std::size_t j = 0; j < i; ++j) first += boundary_counts[j];
    return first + k - 1;
  }
  [[nodiscard]] std::uint32_t first_inner_node() const {
    return 3 + boundary_counts[0] + boundary_counts[1] + boundary_counts[2];
  }
};

}  // namespace cut

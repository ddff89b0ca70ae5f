/// @file
/// The cuts inside one triangle as a planar graph on lattice points, kept planar while edges are added
/// (§4.4).
///
/// New edges are joined with the old ones by iterated snap rounding: two edges that cross are both led
/// through their crossing rounded to the lattice, and an edge that passes through the cell of a node is led
/// through that node, until nothing changes. An edge moves by half a cell (half of δf) for each node that it
/// is led through. Then no two edges cross, no node lies on an edge, and no edge is there twice.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/lattice_point.hpp"

namespace cut::lattice {

struct GraphEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t left = 0;   ///< polygon on the left of from → to, as it was before this cut
  std::uint32_t right = 0;  ///< polygon on the right, as it was before this cut
  double deviation = 0;     ///< see CutEdge::deviation
  bool is_new = false;      ///< added by this cut
};

struct PlanarGraph {
  std::vector<LatticePoint> points;  ///< all different
  std::vector<GraphEdge> edges;      ///< planar between calls
  /// False when rounding did not come to an end within its budget, which no input is known to reach: the
  /// graph has lost edges then and is not to be used.
  bool complete = true;
};

/// Index of the node at p, which is appended when there is none.
std::uint32_t find_or_add_node(PlanarGraph& graph, LatticePoint p);

/// Appends a node and leads the edges that pass through its cell through it. Returns its index, or that of
/// the node which is already there.
std::uint32_t insert_node(PlanarGraph& graph, LatticePoint p);

/// Adds edges between existing nodes. An edge that falls onto an old one vanishes in it. Edges between two
/// points of the same side of the triangle stay on that side. O(crossings · edges).
void insert_edges(PlanarGraph& graph, std::vector<GraphEdge> new_edges);

}  // namespace cut::lattice

/// @file
/// Step 3, Merge Existing Nodes (§4.3, Figure 4): a cutting line is led through the nodes within δe of it and
/// becomes a polygonal chain.
#pragma once
#include <cstdint>
#include <vector>

#include "cutting/polygon_nodes.hpp"
#include "cutting/state.hpp"

namespace cut {

/// The nodes of the chain that the line from node a to node b becomes, ends included. All nodes within δe of
/// a segment are merged at once, and the new segments are looked at again. The chain stays within 2 δe of the
/// line (without such a cap a line that crosses an old cut with close nodes would climb along it), and within
/// its polygon. O(chain² · nodes of the polygon), and for each node within δe of a segment O(edges) to see
/// whether an edge hides it.
std::vector<std::uint32_t> merge_existing_nodes(const TriangleWork& work, const PolygonNodes& nodes,
                                                std::uint32_t polygon, std::uint32_t a, std::uint32_t b);

}  // namespace cut

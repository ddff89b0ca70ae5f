/// @file
/// Step 2 on cuts (§4.2): where cutting lines meet an older cut they divide it, decided once for the cut edge
/// and not by one of the polygons beside it. In: a work whose graph is laid out. Out: ends on cuts moved to
/// the new nodes, the graph's cut edges led through these.
#pragma once
#include "cutting/state.hpp"

namespace cut {

/// Groups of ends within δn on the same cut edge get one node; each end goes to the nearest node on its edge.
/// An edge is led through all its new nodes at once: dividing it at one after the other would move it off the
/// others by rounding.
/// @pre edge i of the graph is edge i of `before`
void merge_on_cut_edges(TriangleWork& work);

}  // namespace cut

/// @file
/// Steps 3, 4, 5 and 7 on one triangle (§4.3, §4.4, §4.5, §4.7): its cutting lines become edges of a planar
/// graph. In: a TriangleWork with settled line ends. Out: its graph, and the sections of its sides that lines
/// run along. Works of different triangles share nothing and can be arranged in any order, or at the same
/// time.
#pragma once
#include <array>
#include <vector>

#include "cutting/state.hpp"

namespace cut {

/// May be called again, after lines were taken away: it starts from `before`.
/// @param boundary the boundary nodes of each side now, counterclockwise
void arrange_triangle(TriangleWork& work, const std::array<std::vector<LatticePoint>, 3>& boundary,
                      const CutContext& context);

/// Whether the work's graph is another one than `before`.
bool differs_from_before(const TriangleWork& work);

}  // namespace cut

/// @file
/// "Lines outside the physics triangle's render area are discarded" (§4.5), done where lines are detected:
/// what a fragment does not render cannot attract or be attracted.
#pragma once
#include <vector>

#include "cutting/state.hpp"

namespace cut {

/// Appends the parts of segment ab that lie in polygon `polygon` of the arrangement. Ends on a contour carry
/// its cut edge. O(edges).
void clip_to_polygon(const Arrangement& arrangement, std::uint32_t polygon, LatticePoint a, LatticePoint b,
                     std::vector<CuttingLine>& lines);

}  // namespace cut

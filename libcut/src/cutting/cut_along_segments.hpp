/// @file
/// Step 5, Cut Along Segments (§4.5): what of the new edges takes effect. Edges outside the polygon that
/// their line belongs to are discarded; edges along a side of the triangle cut that side's sections instead.
#pragma once
#include "cutting/state.hpp"

namespace cut {

/// A new edge names the polygon of its line on both sides (GraphEdge::left, right).
void cut_along_segments(TriangleWork& work);

/// Marks the sections of side i between two nodes of it as cut, where they belong to `polygon`.
void cut_sections_between(TriangleWork& work, std::size_t i, LatticePoint a, LatticePoint b,
                          std::uint32_t polygon);

}  // namespace cut

/// @file
/// Step 7, Merge Adjacent Edges (§4.7): nodes that only continue a straight chain are dropped.
#pragma once
#include "cutting/state.hpp"

namespace cut {

/// Drops inner nodes that are not part of a render polygon yet, have two edges of the same kind, and lie
/// within δe of the line that replaces these, alone. An edge remembers how far dropped nodes may lie off it
/// (CutEdge::deviation), and never drops a node that would bring this beyond δe: dropping again in each frame
/// does not let a cut drift.
void merge_adjacent_edges(TriangleWork& work);

}  // namespace cut

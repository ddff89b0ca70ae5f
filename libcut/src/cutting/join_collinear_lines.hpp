/// @file
/// Joins the cutting lines of neighbouring cutter triangles where they continue each other, so that a cut
/// does not depend on how a flat part of the cutter is divided into triangles.
#pragma once
#include <vector>

#include "cutting/state.hpp"

namespace cut {

/// Replaces chains of lines of the same polygon whose inner points lie within two lattice units of the
/// chain's chord by that chord. Only free points where exactly two lines meet are dropped; a closed chain
/// keeps its smallest one. However a chain is divided, the same lines come out, when the points that divide
/// it lie exactly on it and it has no more than 40 corners. O(n log n).
void join_collinear_lines(std::vector<CuttingLine>& lines);

}  // namespace cut

/// @file
/// The merge distances (§4.2) of a run when only some of them are given. In: what the user gave, the cloth.
/// Out: all three.
#pragma once
#include <optional>

#include "cut/merge_distances.hpp"

namespace snip {

/// Lengths in the units of the mesh; those not given follow from it.
struct GivenMergeDistances {
  std::optional<double> cut, node, edge;
};

/// What is not given is as `cut::default_merge_distances` has it, unless a distance that is given would then
/// break δc ≥ δn ≥ δe. Errors: bad_merge_distances, when the given ones contradict each other.
cut::Result<cut::MergeDistances> complete(const GivenMergeDistances& given, const cut::HybridMesh& mesh);

}  // namespace snip

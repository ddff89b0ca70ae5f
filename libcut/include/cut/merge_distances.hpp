/// @file
/// The merge distances of §4.2: lengths in the tension-free metric. They decide what is merged, never whether
/// the topology is sound.
#pragma once
#include "cut/error.hpp"
#include "cut/hybrid_mesh.hpp"

namespace cut {

struct MergeDistances {
  double cut = 0;   ///< δc: to nodes that were part of the previous cut of the same Cutter
  double node = 0;  ///< δn: to any other node
  double edge = 0;  ///< δe: to edges, and from nodes to cutting lines
};

/// δc, δn, δe = 1/10, 1/20, 1/40 of the mean tension-free edge length (§6).
[[nodiscard]] MergeDistances default_merge_distances(const HybridMesh& mesh);

/// Checks δc ≥ δn ≥ δe > δf (equation 7), δf being one lattice unit of the longest edge: its length / 2^25.
/// O(edges).
[[nodiscard]] Result<MergeDistances> checked(const MergeDistances& distances, const HybridMesh& mesh);

}  // namespace cut

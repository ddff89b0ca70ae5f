/// @file
/// The merge distances of §4.2: lengths in the tension-free metric. They decide what is merged, never whether
/// the topology is sound.
#pragma once
#include "cut/error.hpp"
#include "cut/hybrid_mesh.hpp"

namespace cut {

/// Lengths on the tension-free cloth within which features merge (§4.2, §4.3, §4.7). On edges shorter than 4
/// δc, and in triangles lower than that, all three are smaller by the same factor, so that δc is a quarter of
/// the length or height.
struct MergeDistances {
  double cut = 0;   ///< δc: to nodes that were part of the previous cut of the same Cutter
  double node = 0;  ///< δn: to any other node
  double edge = 0;  ///< δe: to edges, and from nodes to cutting lines
};

/// δc, δn, δe = 1/10, 1/20, 1/40 of the mean tension-free edge length (§6).
[[nodiscard]] MergeDistances default_merge_distances(const HybridMesh& mesh);

/// Checks δc ≥ δn ≥ δe > δf (equation 7), δf being one lattice unit of the longest edge: its length / 2^25;
/// and that δc is no longer than that edge. O(edges).
[[nodiscard]] Result<MergeDistances> checked(const MergeDistances& distances, const HybridMesh& mesh);

}  // namespace cut

// Completes the merge distances (§4.2) that a user left open; see the header.
#include "snip/merge_distances.hpp"

#include <algorithm>

namespace snip {

cut::Result<cut::MergeDistances> complete(const GivenMergeDistances& given, const cut::HybridMesh& mesh) {
  cut::MergeDistances distances = cut::default_merge_distances(mesh);
  distances.edge = given.edge.value_or(distances.edge);
  distances.node = given.node.value_or(std::max(distances.node, distances.edge));
  if (!given.node && given.cut) distances.node = std::min(distances.node, *given.cut);
  if (!given.edge) distances.edge = std::min(distances.edge, distances.node);
  distances.cut = given.cut.value_or(std::max(distances.cut, distances.node));
  return cut::checked(distances, mesh);
}

}  // namespace snip

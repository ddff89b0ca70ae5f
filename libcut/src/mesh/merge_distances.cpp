#include "cut/merge_distances.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cut {

MergeDistances default_merge_distances(const HybridMesh& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
    sum += mesh.ancestors.rest_length(AncestorEdgeId{e});
  const double mean = sum / static_cast<double>(std::max<std::size_t>(mesh.ancestors.edges.size(), 1));
  return {mean / 10, mean / 20, mean / 40};
}

Result<MergeDistances> checked(const MergeDistances& d, const HybridMesh& mesh) {
  double longest = 0;
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
    longest = std::max(longest, mesh.ancestors.rest_length(AncestorEdgeId{e}));
  const double unit = longest / lattice_size;
  if (std::isfinite(d.cut) && d.cut >= d.node && d.node >= d.edge && d.edge > unit) return d;
  return Error{Error::Kind::bad_merge_distances,
               "the merge distances must satisfy cut >= node >= edge > " + std::to_string(unit) +
                   " (the longest edge / 2^25), but they are cut = " + std::to_string(d.cut) +
                   ", node = " + std::to_string(d.node) + ", edge = " + std::to_string(d.edge),
               0};
}

}  // namespace cut

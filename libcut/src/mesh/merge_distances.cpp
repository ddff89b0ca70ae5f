// The default merge distances, and the check of those that a user gives (§4.2).
#include "cut/merge_distances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

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
  if (d.cut <= longest && d.cut >= d.node && d.node >= d.edge && d.edge > unit) return d;
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(),
                "the merge distances must satisfy %.6g >= cut >= node >= edge > %.6g (the longest edge, and "
                "it / 2^25), but they are "
                "cut = %.6g, node = %.6g, edge = %.6g",
                longest, unit, d.cut, d.node, d.edge);
  return Error{Error::Kind::bad_merge_distances, text.data(), 0};
}

}  // namespace cut

/// @file
/// Runs the groups of rules one after the other. In: the mesh. Out: the violations.
#include "cut/validate.hpp"

#include "validate/rules.hpp"

namespace cut {

std::vector<Violation> validate(const HybridMesh& mesh, std::size_t limit) {
  using namespace validation;
  Report report(limit);
  check_ids(mesh, report);
  if (report.size() > 0) return report.take();  // nothing else can be looked up safely
  for (const auto check : {check_ancestors, check_entries, check_boundaries, check_arrangements,
                           check_triangulations, check_connectivity, check_springs})
    if (!report.full()) check(mesh, report);
  return report.take();
}

}  // namespace cut

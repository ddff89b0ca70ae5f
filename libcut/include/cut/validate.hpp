/// @file
/// Checks everything that must hold of a hybrid mesh between two cuts (docs/data_model.md lists the rules).
#pragma once
#include <string>
#include <vector>

#include "cut/hybrid_mesh.hpp"

namespace cut {

struct Violation {
  std::string rule;     ///< name of the broken rule, e.g. "polygons_partition_ancestor"
  std::string message;  ///< what is wrong and with which element, in one line
};

/// All violations found, at most `limit`. An empty list means the mesh is sound. Independent of how the
/// cutting code reached this state: it recomputes everything from the arrangements. O(n log n).
[[nodiscard]] std::vector<Violation> validate(const HybridMesh& mesh, std::size_t limit = 100);

}  // namespace cut

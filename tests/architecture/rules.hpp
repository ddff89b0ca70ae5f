/// @file
/// The ladder of layers (docs/architecture.md) as a check over the include graph, and that each file says
/// what it is for (CONTRIBUTING.md). In: a source tree. Out: one line for each violation, in words that say
/// what to do about it.
#pragma once
#include <string>
#include <vector>

#include "architecture/source_tree.hpp"

namespace architecture {

/// Every violation in the tree; empty when all is well.
std::vector<std::string> violations(const SourceTree& tree);

}  // namespace architecture

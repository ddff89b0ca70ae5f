/// @file
/// The lines that cuts have left, in the material: how many separate ones there are.
#pragma once
#include <cstddef>
#include <cut/hybrid_mesh.hpp>

namespace testing {

/// Number of connected components of the graph of all cut edges, those along physics edges included. An
/// unbroken line is one.
std::size_t count_cut_lines(const cut::HybridMesh& mesh);

}  // namespace testing

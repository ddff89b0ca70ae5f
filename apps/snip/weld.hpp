/// @file
/// Merges vertices that lie within a distance of each other, with the point cluster dictionary (§5.2).
#pragma once
#include <cstddef>
#include <string_view>

#include "snip/mesh_file/mesh.hpp"
#include "snip/result.hpp"

namespace snip {

/// Merges each vertex, in their order, into the nearest one before it that was kept and is no farther than
/// `distance`; a kept vertex does not move. Triangles then name kept vertices only, and may be degenerate or
/// repeated: `clean` drops them. UV and normals stay with the corners; colours are those of kept vertices.
/// An error when the distance is not positive, or too small for the dictionary's grid (a mesh that is larger
/// than 2^30 distances). Complexity: O(n).
/// @return the number of vertices that were merged away
Result<std::size_t> weld(Mesh& mesh, double distance, std::string_view name);

}  // namespace snip

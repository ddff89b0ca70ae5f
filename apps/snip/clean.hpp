/// @file
/// Tidies a mesh from a file before it is used: triangles without area and repeated triangles are dropped,
/// and counted, so that the person who gave the file can be told.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "cut/triangle_mesh.hpp"
#include "snip/mesh_file/mesh.hpp"
#include "snip/result.hpp"

namespace snip {

struct CleanReport {
  std::size_t degenerate =
      0;  ///< triangles with two equal corners or no area, polygons with fewer than three corners
  std::size_t duplicates = 0;  ///< triangles with the corners of an earlier one, in either winding
};

/// Drops degenerate and duplicate triangles; `cut::has_area` tells what is degenerate. Points and attributes
/// stay, with their numbers. Complexity: O(n log n).
/// @return what was dropped, or an error when no triangle is left
Result<CleanReport> clean(Mesh& mesh, std::string_view name);

/// What was dropped as one line for a person, empty when it was nothing.
std::string describe(const CleanReport& report, std::string_view name);

/// Keeps the triangles whose entry is not 0, with their attributes. @pre keep has one entry for each triangle
void keep_triangles(Mesh& mesh, std::span<const unsigned char> keep);

/// Points and triangles alone, as libcut takes them.
cut::TriangleMesh to_triangle_mesh(const Mesh& mesh);

}  // namespace snip

/// @file
/// What a reader collects, whatever the format: points and attributes, and polygons as runs of corners.
/// Positions and indices are checked by the reader, which knows the place in the file; `to_mesh`
/// triangulates.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cut/triangle_mesh.hpp"
#include "snip/mesh_file/mesh.hpp"

namespace snip {

struct PolygonSoup {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector2d> uvs;
  std::vector<Eigen::Vector3d> normals;
  Colours colours;
  std::vector<std::uint32_t> corner_positions;
  std::vector<std::uint32_t> corner_uvs;      ///< empty, or one for each corner
  std::vector<std::uint32_t> corner_normals;  ///< empty, or one for each corner
  std::vector<std::size_t> polygon_ends;      ///< one past the last corner of each polygon
};

/// Triangulates. Fails where there are more points or triangles than an index can count, or a polygon with
/// more than max_polygon_corners. @throws scan::ParseError
Mesh to_mesh(PolygonSoup soup);

/// The attribute index of each vertex if all corners of a vertex agree on the value, as a format that knows
/// attributes of vertices only requires. Vertices without a corner get no_index.
/// @return nothing if a corner has none or two corners of a vertex differ
template <class Value>
std::optional<std::vector<std::uint32_t>> attribute_of_vertices(const Mesh& mesh,
                                                                const std::vector<Triangle>& attribute,
                                                                const std::vector<Value>& values) {
  if (attribute.size() != mesh.triangles.size() || attribute.empty()) return std::nullopt;
  std::vector<std::uint32_t> of_vertex(mesh.positions.size(), no_index);
  for (std::size_t t = 0; t < attribute.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = attribute[t][k];
      std::uint32_t& known = of_vertex[mesh.triangles[t][k]];
      if (index == no_index) return std::nullopt;
      if (known == no_index)
        known = index;
      else if (values[known] != values[index])
        return std::nullopt;
    }
  return of_vertex;
}

}  // namespace snip

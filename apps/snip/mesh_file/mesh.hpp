/// @file
/// The mesh as files know it: triangles over points in double precision, with the attributes that a cut
/// has to carry along. Readers produce it, `clean` tidies it, writers take it.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace snip {

using Triangle = std::array<std::uint32_t, 3>;

/// Stands for "this corner has no such attribute".
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// The number types of PLY. Attributes remember theirs, so that they are written as they were read.
enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Colours of the vertices: none, or one for each position. Values are in the unit of their type: 0 to 255
/// for uint8, 0 to 1 for float32 and float64.
struct Colours {
  std::vector<ScalarType> types;  ///< one for each channel: red, green, blue, and alpha where there is one
  std::vector<std::array<double, 4>> values;
  [[nodiscard]] bool empty() const { return values.empty(); }
};

/// Triangles over points. The order of the points is that of the file. `uv_triangles` and `normal_triangles`
/// are empty, or parallel to `triangles` with one index (or `no_index`) for each corner.
struct Mesh {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> polygon_of_triangle;  ///< the polygon of the file that a triangle is part of
  std::size_t polygon_count = 0;
  std::vector<Eigen::Vector2d> uvs;
  std::vector<Triangle> uv_triangles;
  std::vector<Eigen::Vector3d> normals;
  std::vector<Triangle> normal_triangles;
  Colours colours;
};

}  // namespace snip

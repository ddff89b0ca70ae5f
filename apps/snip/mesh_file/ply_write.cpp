// Writes PLY, binary little endian: exact and compact.
#include <algorithm>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/polygon_soup.hpp"
#include "snip/mesh_file/scalar.hpp"

namespace snip {

void write_ply(const Mesh& mesh, std::string& out) {
  const auto normals = attribute_of_vertices(mesh, mesh.normal_triangles, mesh.normals);
  const auto uvs = attribute_of_vertices(mesh, mesh.uv_triangles, mesh.uvs);
  const auto property = [&out](ScalarType type, std::string_view name) {
    out.append("property ").append(name_of(type)).append(" ").append(name).append("\n");
  };
  out += "ply\nformat binary_little_endian 1.0\n";
  out += "element vertex " + std::to_string(mesh.positions.size()) + "\n";
  for (const std::string_view name : {"x", "y", "z"}) property(ScalarType::float64, name);
  if (normals)
    for (const std::string_view name : {"nx", "ny", "nz"}) property(ScalarType::float64, name);
  if (uvs)
    for (const std::string_view name : {"s", "t"}) property(ScalarType::float64, name);
  constexpr std::string_view channels[] = {"red", "green", "blue", "alpha"};
  if (!mesh.colours.empty())
    for (std::size_t c = 0; c < mesh.colours.types.size(); ++c) property(mesh.colours.types[c], channels[c]);
  // Most programs expect signed indices, and only the largest meshes need the other half of the range.
  const ScalarType index = mesh.positions.size() <= 0x7fffffffu ? ScalarType::int32 : ScalarType::uint32;
  out += "element face " + std::to_string(mesh.triangles.size()) + "\n";
  out.append("property list uchar ").append(name_of(index)).append(" vertex_indices\n");
  // Where corners of a vertex differ, at a seam, the faces carry the coordinates: as MeshLab has it.
  const bool uvs_by_corner = !uvs && !mesh.uv_triangles.empty();
  if (uvs_by_corner) out += "property list uchar double texcoord\n";
  out += "end_header\n";

  const auto append = [&out](const auto& values) {
    for (const double value : values) encode(ScalarType::float64, value, out);
  };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    append(mesh.positions[v]);
    if (normals) append((*normals)[v] == no_index ? Eigen::Vector3d(0, 0, 0) : mesh.normals[(*normals)[v]]);
    if (uvs) append((*uvs)[v] == no_index ? Eigen::Vector2d(0, 0) : mesh.uvs[(*uvs)[v]]);
    if (!mesh.colours.empty())
      for (std::size_t c = 0; c < mesh.colours.types.size(); ++c)
        encode(mesh.colours.types[c], mesh.colours.values[v][c], out);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out += '\3';
    for (const std::uint32_t corner : mesh.triangles[t]) encode(index, corner, out);
    if (!uvs_by_corner) continue;
    const Triangle& corners = mesh.uv_triangles[t];
    const bool complete = std::ranges::find(corners, no_index) == corners.end();
    out += complete ? '\6' : '\0';
    if (complete)
      for (const std::uint32_t corner : corners) append(mesh.uvs[corner]);
  }
}

}  // namespace snip

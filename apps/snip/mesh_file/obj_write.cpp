// Writes Wavefront OBJ: one group for each piece, attributes by corner.
#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/print.hpp"
#include "snip/mesh_file/scalar.hpp"

namespace snip {

void write_obj(const Mesh& mesh, std::span<const std::size_t> piece_begin, std::string& out) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    out += 'v';
    for (const double value : mesh.positions[v]) print::number(out, value);
    if (!mesh.colours.empty())
      for (std::size_t c = 0; c < 3; ++c)
        print::number(out, mesh.colours.values[v][c] / full_intensity(mesh.colours.types[c]));
    out += '\n';
  }
  for (const Eigen::Vector2d& uv : mesh.uvs) {
    out += "vt";
    for (const double value : uv) print::number(out, value);
    out += '\n';
  }
  for (const Eigen::Vector3d& normal : mesh.normals) {
    out += "vn";
    for (const double value : normal) print::number(out, value);
    out += '\n';
  }
  std::size_t piece = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (; piece < piece_begin.size() && piece_begin[piece] == t; ++piece) {
      out += "g piece_";
      print::integer(out, piece);
      out += '\n';
    }
    out += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t uv = mesh.uv_triangles.empty() ? no_index : mesh.uv_triangles[t][k];
      const std::uint32_t normal = mesh.normal_triangles.empty() ? no_index : mesh.normal_triangles[t][k];
      out += ' ';
      print::integer(out, mesh.triangles[t][k] + std::uint64_t{1});
      if (uv != no_index || normal != no_index) out += '/';
      if (uv != no_index) print::integer(out, uv + std::uint64_t{1});
      if (normal != no_index) {
        out += '/';
        print::integer(out, normal + std::uint64_t{1});
      }
    }
    out += '\n';
  }
}

}  // namespace snip

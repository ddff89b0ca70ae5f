// Writes STL in ascii: binary STL has single precision only, in which thin triangles of a cut collapse.
#include <Eigen/Geometry>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/print.hpp"

namespace snip {

void write_stl(const Mesh& mesh, std::span<const std::size_t> piece_begin, std::string& out) {
  const std::size_t pieces = std::max<std::size_t>(piece_begin.size(), 1);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::string name = piece_begin.empty() ? "mesh" : "piece_" + std::to_string(piece);
    const std::size_t begin = piece_begin.empty() ? 0 : piece_begin[piece];
    const std::size_t end = piece + 1 < piece_begin.size() ? piece_begin[piece + 1] : mesh.triangles.size();
    out.append("solid ").append(name).append("\n");
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Eigen::Vector3d across =
          (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
      out += "facet normal";
      for (const double value : across.stableNormalized()) print::number(out, value);
      out += "\nouter loop\n";
      for (const std::uint32_t corner : mesh.triangles[t]) {
        out += "vertex";
        for (const double value : mesh.positions[corner]) print::number(out, value);
        out += '\n';
      }
      out += "endloop\nendfacet\n";
    }
    out.append("endsolid ").append(name).append("\n");
  }
}

}  // namespace snip

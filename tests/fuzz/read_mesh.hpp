/// @file
/// What the fuzz targets of the mesh readers share. In: any bytes. Aborts if the reader lets something
/// through that no mesh may have, or if what was read does not survive being written.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "snip/clean.hpp"
#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/mesh_file.hpp"
#include "snip/pieces.hpp"

namespace fuzz {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

inline void require_indices(const std::vector<snip::Triangle>& triangles, std::size_t count, bool may_lack) {
  for (const snip::Triangle& triangle : triangles)
    for (const std::uint32_t index : triangle)
      require(index < count || (may_lack && index == snip::no_index), "index in range");
}

inline void require_sound(const snip::Mesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  require_indices(mesh.triangles, mesh.positions.size(), false);
  require_indices(mesh.uv_triangles, mesh.uvs.size(), true);
  require_indices(mesh.normal_triangles, mesh.normals.size(), true);
  require(mesh.polygon_of_triangle.size() == triangles, "a polygon for each triangle");
  require(mesh.uv_triangles.empty() || mesh.uv_triangles.size() == triangles, "UV for each triangle");
  require(mesh.normal_triangles.empty() || mesh.normal_triangles.size() == triangles,
          "normals for each triangle");
  require(mesh.colours.empty() || mesh.colours.values.size() == mesh.positions.size(),
          "a colour for each point");
  for (const Eigen::Vector3d& p : mesh.positions)
    require(p.allFinite() && p.cwiseAbs().maxCoeff() <= 1e50, "coordinates are finite and not too large");
}

/// Reads, checks, cleans, finds pieces, writes in the same format and reads again.
inline int read_mesh(const std::uint8_t* data, std::size_t size, snip::MeshFormat format) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  auto mesh = snip::parse_mesh(bytes, format, "input");
  if (!mesh) {
    const std::string& message = mesh.error().message;
    require(message.starts_with("input"), "the error names the file");
    for (const char c : message) require(c >= 0x20 && c < 0x7f, "the error is one printable line");
    return 0;
  }
  require_sound(*mesh);
  if (!snip::clean(*mesh, "input")) return 0;
  require_sound(*mesh);
  const snip::Pieces pieces = snip::find_pieces(mesh->positions, mesh->triangles);
  const std::vector<std::size_t> piece_begin = snip::sort_by_piece(*mesh, pieces);

  std::string written;
  switch (format) {
    case snip::MeshFormat::obj:
      snip::write_obj(*mesh, piece_begin, written);
      break;
    case snip::MeshFormat::ply:
      snip::write_ply(*mesh, written);
      break;
    case snip::MeshFormat::stl:
      snip::write_stl(*mesh, piece_begin, written);
      break;
    case snip::MeshFormat::off:
      snip::write_off(*mesh, written);
      break;
  }
  const auto again = snip::parse_mesh(written, format, "input");
  require(static_cast<bool>(again), "what was written can be read");
  require_sound(*again);
  require(again->triangles.size() == mesh->triangles.size(), "as many triangles as were written");
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      require(again->positions[again->triangles[t][k]] == mesh->positions[mesh->triangles[t][k]],
              "corners are where they were");
  return 0;
}

}  // namespace fuzz

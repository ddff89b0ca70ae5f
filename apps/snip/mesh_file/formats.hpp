/// @file
/// One reader and one writer for each format. A reader takes the bytes of a file and gives a mesh; nothing in
/// a header is believed before the bytes are there, so memory is bounded by a multiple of the size of the
/// file. A writer appends to a text. Files, names and errors for people: mesh_file.hpp.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "snip/mesh_file/mesh.hpp"

namespace snip {

// Readers. @throws scan::ParseError

/// Wavefront OBJ: v (with colours), vt, vn, f; polygons, negative indices, continued lines. Lines and points
/// are no surface and are left out, as are groups and materials. Free-form surfaces are refused.
Mesh read_obj(std::string_view bytes);
/// PLY 1.0, ascii or binary of either byte order, with any elements and properties. Known are: vertex x y z,
/// nx ny nz, red green blue alpha, s t (u v, texture_u texture_v); face vertex_indices, texcoord.
Mesh read_ply(std::string_view bytes);
/// STL, binary or ascii. Corners with exactly equal coordinates are one point.
Mesh read_stl(std::string_view bytes);
/// OFF in ascii, with the prefixes ST, C and N for attributes of vertices. Colours of faces are left out.
Mesh read_off(std::string_view bytes);

// Writers. The triangles of piece k are those from piece_begin[k] up to piece_begin[k + 1] or the end; no
// pieces at all is one nameless piece. Numbers have 17 significant digits, which is exact.

/// Positions, colours, UV, normals; a group `piece_k` for each piece.
void write_obj(const Mesh& mesh, std::span<const std::size_t> piece_begin, std::string& out);
/// Binary little endian; positions in double, colours in their own type, UV of vertices or else of corners,
/// normals where all corners of a vertex agree on them.
void write_ply(const Mesh& mesh, std::string& out);
/// Ascii, since binary STL has single precision only; a solid for each piece.
void write_stl(const Mesh& mesh, std::span<const std::size_t> piece_begin, std::string& out);
/// Positions and colours.
void write_off(const Mesh& mesh, std::string& out);

}  // namespace snip

/// @file
/// Mesh files by name: reads and writes OBJ, PLY, STL and OFF, told apart by the ending of the name.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "snip/mesh_file/mesh.hpp"
#include "snip/result.hpp"

namespace snip {

enum class MeshFormat { obj, ply, stl, off };

/// The format that the ending of the name stands for, in small or capital letters.
Result<MeshFormat> format_of(const std::filesystem::path& path);

/// Reads a whole mesh file. The error is one line with the file, the place in it, and what is wrong.
Result<Mesh> read_mesh(const std::filesystem::path& path);

/// Reads a mesh from the bytes of a file. @param name stands for the file in errors
/// Memory: a small multiple of the bytes, whatever they say.
Result<Mesh> parse_mesh(std::string_view bytes, MeshFormat format, std::string_view name);

/// The bytes of a mesh file. The triangles of piece k are those from piece_begin[k] up to piece_begin[k + 1]
/// or the end; no pieces at all is one nameless piece.
std::string print_mesh(MeshFormat format, const Mesh& mesh, std::span<const std::size_t> piece_begin = {});

/// Writes these bytes in the format of the name; the file is complete or not there at all.
Result<> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                    std::span<const std::size_t> piece_begin = {});

}  // namespace snip

// Mesh files by name; see the header.
#include "snip/mesh_file/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/scan.hpp"
#include "snip/whole_file.hpp"

namespace snip {

Result<MeshFormat> format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".off") return MeshFormat::off;
  return Error{fmt::format("{}: unknown kind of mesh file: the name must end in .obj, .ply, .stl or .off",
                           path.string())};
}

Result<Mesh> parse_mesh(std::string_view bytes, MeshFormat format, std::string_view name) {
  if (bytes.empty()) return Error{fmt::format("{}: the file is empty", name)};
  try {
    switch (format) {
      case MeshFormat::obj:
        return read_obj(bytes);
      case MeshFormat::ply:
        return read_ply(bytes);
      case MeshFormat::stl:
        return read_stl(bytes);
      case MeshFormat::off:
        break;
    }
    return read_off(bytes);
  } catch (const scan::ParseError& error) {
    return Error{fmt::format("{}{}: {}", name, error.where, error.what)};
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: not enough memory for a file of {} bytes", name, bytes.size())};
  }
}

Result<Mesh> read_mesh(const std::filesystem::path& path) {
  const Result<MeshFormat> format = format_of(path);
  if (!format) return format.error();
  const Result<std::string> bytes = read_whole_file(path);
  if (!bytes) return bytes.error();
  return parse_mesh(*bytes, *format, path.string());
}

std::string print_mesh(MeshFormat format, const Mesh& mesh, std::span<const std::size_t> piece_begin) {
  std::string bytes;
  switch (format) {
    case MeshFormat::obj:
      write_obj(mesh, piece_begin, bytes);
      break;
    case MeshFormat::ply:
      write_ply(mesh, bytes);
      break;
    case MeshFormat::stl:
      write_stl(mesh, piece_begin, bytes);
      break;
    case MeshFormat::off:
      write_off(mesh, bytes);
      break;
  }
  return bytes;
}

Result<> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                    std::span<const std::size_t> piece_begin) {
  const Result<MeshFormat> format = format_of(path);
  if (!format) return format.error();
  return write_whole_file(path, print_mesh(*format, mesh, piece_begin));
}

}  // namespace snip

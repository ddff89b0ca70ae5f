/// @file
/// What commands tell people, and the mesh that most of them begin with.
#pragma once
#include <filesystem>
#include <string_view>

#include "cut/error.hpp"
#include "snip/mesh_file/mesh.hpp"
#include "snip/result.hpp"

namespace snip {

/// Writes `snip: error: ...` to stderr. Control characters within the message become blanks.
void report_error(const Error& error);
/// Writes `snip: warning: ...` to stderr.
void report_warning(std::string_view message);

/// Reads a mesh and drops degenerate and duplicate triangles, with a warning that says how many.
Result<Mesh> read_clean_mesh(const std::filesystem::path& path);

/// What libcut says about a mesh, with the file and the face of it that it is about.
/// @param mesh the mesh that was given to libcut
Error explain(const cut::Error& error, const Mesh& mesh, std::string_view name);

}  // namespace snip

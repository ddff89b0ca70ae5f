/// @file
/// What commands tell people, and the mesh that most of them begin with.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "cut/error.hpp"
#include "snip/clean.hpp"
#include "snip/mesh_file/mesh.hpp"
#include "snip/result.hpp"

namespace snip {

/// Writes `snip: error: ...` to stderr. Control characters within the message become blanks.
void report_error(const Error& error);
/// Writes `snip: warning: ...` to stderr.
void report_warning(std::string_view message);

/// Reports the error of a command that has failed, and sets the exit code for it.
void conclude(const Result<>& result, int& exit_code);

/// Drops degenerate and duplicate triangles, with a warning that says how many.
Result<CleanReport> clean_and_warn(Mesh& mesh, const std::string& name);
/// Reads a mesh and drops degenerate and duplicate triangles, with a warning that says how many.
Result<Mesh> read_clean_mesh(const std::filesystem::path& path);

/// What libcut says about a mesh, with the file and the face of it that it is about.
/// @param mesh the mesh that was given to libcut
Error explain(const cut::Error& error, const Mesh& mesh, std::string_view name);

}  // namespace snip

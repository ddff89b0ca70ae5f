/// @file
/// What `cut` and `weld` write: a mesh and, on demand, statistics. Both or none.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <optional>

#include "snip/mesh_file/mesh_file.hpp"
#include "snip/output_file.hpp"
#include "snip/result.hpp"
#include "snip/stats.hpp"

namespace snip {

struct OutputPaths {
  std::filesystem::path mesh;
  std::optional<std::filesystem::path> stats;
};

/// Looks before any work is done whether both can be written, and whether the statistics would replace the
/// mesh or one of the inputs.
/// @return the format of the mesh
Result<MeshFormat> check(const OutputPaths& paths, std::initializer_list<std::filesystem::path> inputs);

/// Writes the statistics, and puts both files in place when that went well.
Result<> publish(OutputFile& mesh, const std::filesystem::path& stats, const Json& json);

}  // namespace snip

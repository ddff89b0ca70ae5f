// What commands write; see the header.
#include "snip/commands/outputs.hpp"

#include <fmt/format.h>

namespace snip {

Result<MeshFormat> check(const OutputPaths& paths, std::initializer_list<std::filesystem::path> inputs) {
  Result<MeshFormat> format = format_of(paths.mesh);
  if (!format) return format;
  if (const auto target = output_target(paths.mesh); !target) return target.error();
  if (!paths.stats) return format;
  if (const auto target = output_target(*paths.stats); !target) return target.error();
  if (same_target(*paths.stats, paths.mesh))
    return Error{
        fmt::format("{}: the mesh and the statistics cannot go to the same file", paths.stats->string())};
  for (const std::filesystem::path& input : inputs)
    if (same_target(*paths.stats, input))
      return Error{
          fmt::format("{}: the statistics cannot replace a mesh that is read", paths.stats->string())};
  return format;
}

Result<> publish(OutputFile& mesh, const std::filesystem::path& stats, const Json& json) {
  Result<OutputFile> file = completed_file(stats, json.dump(2) + "\n");
  if (!file) return file.error();
  if (const Result<> published = mesh.publish(); !published) return published;
  return file->publish();
}

}  // namespace snip

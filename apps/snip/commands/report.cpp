// Messages; see the header.
#include "snip/commands/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "snip/command_line.hpp"
#include "snip/console.hpp"
#include "snip/mesh_file/mesh_file.hpp"

namespace snip {
namespace {

void report(std::string_view kind, std::string_view message) {
  std::string line(message);
  // A name in it may hold anything; a terminal would obey some of that.
  std::ranges::replace_if(line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  print_err(fmt::format("snip: {}: {}\n", kind, line));
}

}  // namespace

void report_error(const Error& error) { report("error", error.message); }

void report_warning(std::string_view message) { report("warning", message); }

void conclude(const Result<>& result, int& exit_code) {
  if (result) return;
  report_error(result.error());
  exit_code = exit_bad_input;
}

Result<CleanReport> clean_and_warn(Mesh& mesh, const std::string& name) {
  Result<CleanReport> cleaned = clean(mesh, name);
  if (!cleaned) return cleaned;
  const std::string dropped = describe(*cleaned, name);
  if (!dropped.empty()) report_warning(dropped);
  return cleaned;
}

Result<Mesh> read_clean_mesh(const std::filesystem::path& path) {
  Result<Mesh> mesh = read_mesh(path);
  if (!mesh) return mesh;
  if (const auto cleaned = clean_and_warn(*mesh, path.string()); !cleaned) return cleaned.error();
  return mesh;
}

Error explain(const cut::Error& error, const Mesh& mesh, std::string_view name) {
  using Kind = cut::Error::Kind;
  const bool about_triangle = error.kind == Kind::degenerate_triangle ||
                              error.kind == Kind::duplicate_triangle || error.kind == Kind::non_manifold_edge;
  if (!about_triangle || error.element >= mesh.polygon_of_triangle.size())
    return {fmt::format("{}: {}", name, error.message)};
  return {fmt::format("{}: {}, which is of face {} of the file (all counted from 0)", name, error.message,
                      mesh.polygon_of_triangle[error.element])};
}

}  // namespace snip

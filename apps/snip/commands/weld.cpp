// snip weld MESH -d DISTANCE -o OUT [--stats FILE]: merges vertices.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "snip/commands/checks.hpp"
#include "snip/commands/commands.hpp"
#include "snip/commands/outputs.hpp"
#include "snip/commands/report.hpp"
#include "snip/stats.hpp"
#include "snip/weld.hpp"

namespace snip {
namespace {

struct WeldOptions {
  std::string mesh;
  double distance = 0;
  OutputPaths out;
};

Result<> run(const WeldOptions& options) {
  const Result<MeshFormat> out_format = check(options.out, {options.mesh});
  if (!out_format) return out_format.error();
  Stopwatch stopwatch;
  Result<Mesh> mesh = read_mesh(options.mesh);
  if (!mesh) return mesh.error();
  stopwatch.lap("read");
  const std::size_t vertices_before = mesh->positions.size();
  const std::size_t triangles_before = mesh->triangles.size();
  const Result<std::size_t> merged = weld(*mesh, options.distance, options.mesh);
  if (!merged) return merged.error();
  stopwatch.lap("weld");
  const Result<CleanReport> cleaned = clean_and_warn(*mesh, options.mesh);
  if (!cleaned) return cleaned.error();
  stopwatch.lap("clean");
  const Pieces pieces = find_pieces(mesh->positions, mesh->triangles);
  const std::vector<std::size_t> piece_begin = sort_by_piece(*mesh, pieces);
  stopwatch.lap("pieces");
  Result<OutputFile> file = completed_file(options.out.mesh, print_mesh(*out_format, *mesh, piece_begin));
  if (!file) return file.error();
  stopwatch.lap("write");
  if (!options.out.stats) return file->publish();
  return publish(*file, *options.out.stats,
                 {{"pieces", to_json(pieces.pieces)},
                  {"vertices", {{"before", vertices_before}, {"after", mesh->positions.size()}}},
                  {"triangles", {{"before", triangles_before}, {"after", mesh->triangles.size()}}},
                  {"dropped", {{"degenerate", cleaned->degenerate}, {"duplicate", cleaned->duplicates}}},
                  {"timings_ms", to_json(stopwatch)}});
}

}  // namespace

void add_weld_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("weld", "Merge vertices that lie within a distance of each other");
  auto options = std::make_shared<WeldOptions>();
  command->add_option("MESH", options->mesh, "Mesh to weld (.obj, .ply, .stl, .off)")
      ->required()
      ->check(a_name());
  command->add_option("-d,--distance", options->distance, "Merge vertices no farther apart than this")
      ->required()
      ->check(positive_number());
  command->add_option("-o,--output", options->out.mesh, "Mesh to write (.obj, .ply, .stl, .off)")
      ->required()
      ->check(a_name());
  command->add_option("--stats", options->out.stats, "Write what was done as JSON")->check(a_name());
  command->callback([options, &exit_code] { conclude(run(*options), exit_code); });
}

}  // namespace snip

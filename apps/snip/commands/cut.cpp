// snip cut CLOTH CUTTER -o OUT [--merge-cut D] [--merge-node D] [--merge-edge D] [--stats FILE]: cuts a mesh
// once, as it is.
#include "cut/cutter.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "cut/validate.hpp"
#include "snip/commands/checks.hpp"
#include "snip/commands/commands.hpp"
#include "snip/commands/outputs.hpp"
#include "snip/commands/report.hpp"
#include "snip/merge_distances.hpp"
#include "snip/rendered_mesh.hpp"
#include "snip/stats.hpp"

namespace snip {
namespace {

struct CutOptions {
  std::string cloth;
  std::string cutter;
  OutputPaths out;
  GivenMergeDistances merge;
};

Counts physics_counts(const cut::HybridMesh& mesh) {
  const cut::Buffers& buffers = mesh.buffers;
  Counts counts;
  counts.nodes = buffers.nodes.size();
  counts.edges = static_cast<std::size_t>(
      std::ranges::count_if(buffers.springs, [](const cut::Spring& s) { return s.edge.valid(); }));
  counts.triangles = static_cast<std::size_t>(std::ranges::count_if(
      buffers.triangles, [](const cut::PhysicsTriangle& t) { return t.ancestor.valid(); }));
  return counts;
}

// Edges by Euler's formula, from what is known of the pieces.
Counts render_counts(const cut::HybridMesh& mesh, const std::vector<Piece>& pieces) {
  Counts counts;
  counts.nodes = mesh.buffers.render_vertices.size() - mesh.free_render_vertices.size();
  std::int64_t euler_characteristic = 0;
  for (const Piece& piece : pieces) {
    counts.triangles += piece.triangles;
    euler_characteristic += piece.euler_characteristic;
  }
  counts.edges = static_cast<std::size_t>(static_cast<std::int64_t>(counts.nodes + counts.triangles) -
                                          euler_characteristic);
  return counts;
}

Json to_json(const std::vector<cut::Violation>& violations) {
  Json json = Json::array();
  for (const cut::Violation& violation : violations)
    json.push_back({{"rule", violation.rule}, {"message", violation.message}});
  return json;
}

void add_steps(Stopwatch& stopwatch, const cut::StepTimings& steps) {
  stopwatch.add("broad_phase", steps.broad_phase);
  stopwatch.add("detect", steps.detect);
  stopwatch.add("merge_endpoints", steps.merge_endpoints);
  stopwatch.add("arrange", steps.arrange);
  stopwatch.add("reconnect", steps.reconnect);
  stopwatch.add("publish", steps.publish);
}

Result<> run(const CutOptions& options) {
  const Result<MeshFormat> out_format = check(options.out, {options.cloth, options.cutter});
  if (!out_format) return out_format.error();
  Stopwatch stopwatch;
  const Result<Mesh> cloth = read_clean_mesh(options.cloth);
  if (!cloth) return cloth.error();
  const Result<Mesh> blade = read_clean_mesh(options.cutter);
  if (!blade) return blade.error();
  stopwatch.lap("read");

  auto hybrid = cut::HybridMesh::build(to_triangle_mesh(*cloth));
  if (!hybrid) return explain(hybrid.error(), *cloth, options.cloth);
  stopwatch.lap("build");
  const auto distances = complete(options.merge, *hybrid);
  if (!distances) return Error{distances.error().message};
  const Pieces before = find_pieces(cloth->positions, cloth->triangles);
  const Counts physics_before = physics_counts(*hybrid);
  const Counts render_before = render_counts(*hybrid, before.pieces);
  stopwatch.lap("measure");

  cut::Cutter cutter(*distances);
  const auto changes = cutter.cut(*hybrid, to_triangle_mesh(*blade));
  if (!changes) return explain(changes.error(), *blade, options.cutter);
  stopwatch.lap("cut");
  add_steps(stopwatch, cutter.timings());

  Mesh result = rendered_mesh(*cloth, *hybrid);
  const Pieces after = find_pieces(result.positions, result.triangles);
  const std::vector<std::size_t> piece_begin = sort_by_piece(result, after);
  stopwatch.lap("pieces");
  Result<OutputFile> file = completed_file(options.out.mesh, print_mesh(*out_format, result, piece_begin));
  if (!file) return file.error();
  stopwatch.lap("write");
  if (!options.out.stats) return file->publish();
  const std::vector<cut::Violation> violations = cut::validate(*hybrid);
  stopwatch.lap("validate");
  return publish(
      *file, *options.out.stats,
      {{"pieces", to_json(after.pieces)},
       {"area_before", total_area(before.pieces)},
       {"area_after", total_area(after.pieces)},
       {"physics", {{"before", to_json(physics_before)}, {"after", to_json(physics_counts(*hybrid))}}},
       {"render",
        {{"before", to_json(render_before)}, {"after", to_json(render_counts(*hybrid, after.pieces))}}},
       {"merge_distances", {{"cut", distances->cut}, {"node", distances->node}, {"edge", distances->edge}}},
       {"timings_ms", to_json(stopwatch)},
       {"violations", to_json(violations)}});
}

}  // namespace

void add_cut_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("cut", "Cut a surface mesh with a triangle mesh");
  auto options = std::make_shared<CutOptions>();
  command->add_option("CLOTH", options->cloth, "Mesh to cut (.obj, .ply, .stl, .off)")
      ->required()
      ->check(a_name());
  command->add_option("CUTTER", options->cutter, "Mesh to cut it with (.obj, .ply, .stl, .off)")
      ->required()
      ->check(a_name());
  command->add_option("-o,--output", options->out.mesh, "Where the pieces go (.obj, .ply, .stl, .off)")
      ->required()
      ->check(a_name());
  command
      ->add_option("--merge-cut", options->merge.cut,
                   "Merge the ends of a cut with nodes of the previous cut within this distance "
                   "(default: 1/10 of the mean edge length)")
      ->check(positive_number());
  command
      ->add_option("--merge-node", options->merge.node,
                   "... with other nodes within this distance (default: 1/20)")
      ->check(positive_number());
  command
      ->add_option("--merge-edge", options->merge.edge, "... with edges within this distance (default: 1/40)")
      ->check(positive_number());
  command->add_option("--stats", options->out.stats, "Write pieces, areas, counts and times as JSON")
      ->check(a_name());
  command->callback([options, &exit_code] { conclude(run(*options), exit_code); });
}

}  // namespace snip

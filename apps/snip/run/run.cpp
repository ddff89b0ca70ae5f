// `snip run`, see run.hpp: the loop over the frames, and what is said and written at its end.
#include "snip/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

#include "cut/validate.hpp"
#include "snip/commands/report.hpp"
#include "snip/console.hpp"
#include "snip/mesh_file/mesh_file.hpp"
#include "snip/output_file.hpp"
#include "snip/pieces.hpp"
#include "snip/rendered_mesh.hpp"
#include "snip/run/frame_table.hpp"
#include "snip/run/picture_files.hpp"
#include "snip/run/progress.hpp"
#include "snip/run/scene_file.hpp"

namespace snip {
namespace {

/// What the frames added up to.
struct Totals {
  double cut_ms = 0, slowest_cut_ms = 0, simulation_ms = 0;

  void add(const Frame& frame) {
    cut_ms += frame.cut_ms;
    slowest_cut_ms = std::max(slowest_cut_ms, frame.cut_ms);
    simulation_ms += frame.simulation_ms;
  }
};

Result<OutputFile> begin_table(const std::filesystem::path& path) {
  auto table = OutputFile::create(path);
  if (!table) return table;
  if (const auto written = table->write(frame_header()); !written) return written.error();
  return table;
}

/// All frames. An error of the simulation is returned; the run then stands at the last good frame.
Result<> all_frames(SceneRun& run, OutputFile* table, PictureFiles* pictures, Totals& totals) {
  const std::size_t count = run.scene().frames;
  Progress progress(count);
  bool warned = false;
  const auto warn = [&] {
    if (warned || run.warning().empty()) return;
    progress.clear();
    report_warning(run.warning());
    warned = true;
  };
  warn();
  for (;;) {
    totals.add(run.frame());
    if (table)
      if (const auto written = table->write(frame_row(run.frame())); !written) return written;
    const bool is_last = run.frame().number == count;
    if (pictures)
      if (const auto taken = pictures->take(run, is_last); !taken) return taken;
    const std::size_t pieces = run.frame().pieces;
    progress.update(run.frame().number, fmt::format("{} piece{}", pieces, pieces == 1 ? "" : "s"));
    if (is_last) return {};
    const auto advanced = run.advance();
    warn();
    if (!advanced) return advanced;
  }
}

Result<> write_mesh_of(const SceneRun& run, const std::filesystem::path& path) {
  Mesh mesh = rendered_mesh(run.cloth(), run.mesh());
  const Pieces pieces = find_pieces(mesh.positions, mesh.triangles);
  return write_mesh(path, mesh, sort_by_piece(mesh, pieces));
}

void print_summary(const SceneRun& run, const Totals& totals, const PictureFiles* pictures,
                   const std::filesystem::path& folder) {
  const Frame& frame = run.frame();
  print_out(fmt::format(
      "{} frames, {:.3g} s: {} piece{}, {} physics nodes, {} edges, {} triangles, {} render triangles\n",
      frame.number, frame.time, frame.pieces, frame.pieces == 1 ? "" : "s", frame.physics_nodes,
      frame.physics_edges, frame.physics_triangles, frame.render_triangles));
  const double seconds = totals.simulation_ms / 1000;
  const auto updates = static_cast<double>(run.simulation().updates());
  print_out(fmt::format("MSDM updates per second: {:.0f} ({:.0f} updates in {:.3g} s)\n",
                        seconds > 0 ? updates / seconds : 0, updates, seconds));
  print_out(fmt::format("cutting: {:.3g} ms in all, {:.3g} ms in the slowest frame\n", totals.cut_ms,
                        totals.slowest_cut_ms));
  std::string written = run.scene().output.csv ? "frames.csv" : "";
  const auto add = [&](const std::string& item) { written += (written.empty() ? "" : ", ") + item; };
  if (!run.scene().output.mesh.empty()) add(run.scene().output.mesh);
  if (pictures && pictures->picture_count() > 0) add(fmt::format("{} pictures", pictures->picture_count()));
  if (pictures && pictures->animation_count() > 0) add("animation.webp");
  if (!written.empty()) print_out(fmt::format("written to {}: {}\n", folder.string(), written));
}

}  // namespace

Result<> run_scene(const RunOptions& options) {
  auto scene = read_scene(options.scene);
  if (!scene) return scene.error();
  scene->frames = options.frames.value_or(scene->frames);
  auto run = SceneRun::start(*scene, options.scene.parent_path());
  if (!run) return run.error();

  const std::filesystem::path folder =
      options.output_folder.empty() ? options.scene.stem() : options.output_folder;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    return Error{fmt::format("{}: the folder cannot be made: {}", folder.string(), failure.message())};
  if (!scene->output.mesh.empty())
    if (const auto target = output_target(folder / scene->output.mesh); !target) return target.error();
  std::optional<OutputFile> table;
  if (scene->output.csv) {
    auto begun = begin_table(folder / "frames.csv");
    if (!begun) return begun.error();
    table = std::move(*begun);
  }
  std::optional<PictureFiles> pictures;
  if (!options.no_images) {
    auto created = PictureFiles::create(*run, folder);
    if (!created) return created.error();
    pictures = std::move(*created);
  }

  Totals totals;
  Result<> ran = all_frames(*run, table ? &*table : nullptr, pictures ? &*pictures : nullptr, totals);
  // What there is gets written, even if the run broke down.
  if (table)
    if (const auto published = table->publish(); !published) return published;
  if (!scene->output.mesh.empty())
    if (const auto written = write_mesh_of(*run, folder / scene->output.mesh); !written) return written;
  if (pictures)
    if (const auto written = pictures->finish(); !written) return written;
  for (const cut::Violation& violation : cut::validate(run->mesh(), 3))
    report_warning(fmt::format("the mesh is not sound: {}: {}", violation.rule, violation.message));
  if (!ran) return ran;
  print_summary(*run, totals, pictures ? &*pictures : nullptr, folder);
  return {};
}

}  // namespace snip

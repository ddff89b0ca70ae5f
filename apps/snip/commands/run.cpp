// snip run SCENE [-o DIR] [--frames N] [--no-images]: a cloth that is cut while it moves.
#include "snip/run/run.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "snip/commands/checks.hpp"
#include "snip/commands/commands.hpp"
#include "snip/commands/report.hpp"
#include "snip/run/scene.hpp"

namespace snip {

void add_run_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Run a scene: a cloth that is cut while it moves");
  auto options = std::make_shared<RunOptions>();
  command->add_option("SCENE", options->scene, "Scene file (docs/scene_file.md)")
      ->required()
      ->check(a_name());
  command->add_option("-o,--output", options->output_folder, "Folder to write to (default: the scene's name)")
      ->check(a_name());
  command->add_option("--frames", options->frames, "Number of frames, in place of the scene's own")
      ->check(CLI::Range(std::size_t{1}, most_frames));
  command->add_flag("--no-images", options->no_images, "Write no pictures");
  command->callback([options, &exit_code] { conclude(run_scene(*options), exit_code); });
}

}  // namespace snip

/// @file
/// `snip run`: a scene file from the first frame to the last, and what it writes (docs/scene_file.md).
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>

#include "snip/result.hpp"

namespace snip {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path
      output_folder;  ///< made when it is not there; empty: the name of the scene without ending
  std::optional<std::size_t> frames;  ///< in place of the scene's own number. @pre greater than 0
  bool no_images = false;             ///< neither pictures nor an animation
};

/// Runs the scene. Progress goes to stderr; stdout gets a summary: the pieces, what the cuts cost, how many
/// updates of the mass-spring-damper model were done in a second, what was written where. When the simulation
/// breaks down, what there is up to the last good frame is written before the error returns.
Result<> run_scene(const RunOptions& options);

}  // namespace snip

/// @file
/// The pictures that a run writes: single ones, and an animation.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>

#include "snip/render/image_file.hpp"
#include "snip/run/scene_picture.hpp"

namespace snip {

class PictureFiles {
 public:
  /// @param folder has to be there already
  static Result<PictureFiles> create(const SceneRun& run, const std::filesystem::path& folder);

  /// Draws and writes what is due at this frame. @param is_last a picture is written in any case, where
  /// pictures are wanted at all
  Result<> take(const SceneRun& run, bool is_last);
  /// Writes the animation, if one is wanted. @pre `take` was called for frame 0
  Result<> finish();

  [[nodiscard]] std::size_t picture_count() const { return pictures_; }
  [[nodiscard]] std::size_t animation_count() const { return shown_; }

 private:
  PictureFiles(const SceneRun& run, const std::filesystem::path& folder);
  std::filesystem::path folder_;
  Camera camera_;
  double edge_pixels_;
  std::optional<Animation> animation_;
  std::size_t pictures_ = 0, shown_ = 0;
};

}  // namespace snip

// Picture files of a run, see picture_files.hpp.
#include "snip/run/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "snip/output_file.hpp"
#include "snip/whole_file.hpp"

namespace snip {
namespace {

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Milliseconds for which picture `k` of an animation is shown: they add up without drift. Viewers show what
/// is shorter than 20 ms at a speed of their own.
int milliseconds(std::size_t k, double seconds_each) {
  const auto end_of = [&](std::size_t i) {
    return std::llround(static_cast<double>(i) * seconds_each * 1000);
  };
  return static_cast<int>(std::clamp<long long>(end_of(k + 1) - end_of(k), 20, 60'000));
}

constexpr const char* animation_name = "animation.webp";

/// An animation is kept in memory until its end, compressed; a WebP file can have 4 GiB.
Result<> animation_fits(const Scene& scene) {
  const OutputSettings& output = scene.output;
  const std::size_t most =
      std::min(most_animation_pictures, most_animation_pixels / (output.width * output.height));
  if (scene.frames / output.animation_interval < most) return {};
  return Error{
      fmt::format("{}: an animation of {} by {} pixels can have at most {} pictures: {} frames want an "
                  "animation_interval of {}, or 0 for no animation",
                  output.place, output.width, output.height, most, scene.frames, scene.frames / most + 1)};
}

}  // namespace

PictureFiles::PictureFiles(const SceneRun& run, const std::filesystem::path& folder)
    : folder_(folder), camera_(scene_camera(run)), edge_pixels_(pixels_per_edge(run, camera_)) {}

Result<PictureFiles> PictureFiles::create(const SceneRun& run, const std::filesystem::path& folder) {
  PictureFiles files(run, folder);
  const OutputSettings& output = run.scene().output;
  if (output.animation_interval > 0) {
    if (const auto fits = animation_fits(run.scene()); !fits) return fits.error();
    if (const auto target = output_target(folder / animation_name); !target) return target.error();
    auto animation = Animation::create(output.width, output.height);
    if (!animation) return animation.error();
    files.animation_ = std::move(*animation);
  }
  return files;
}

Result<> PictureFiles::take(const SceneRun& run, bool is_last) {
  const OutputSettings& output = run.scene().output;
  const std::size_t frame = run.frame().number;
  const bool still = output.picture_interval > 0 && (frame % output.picture_interval == 0 || is_last);
  const bool moving = animation_ && frame % output.animation_interval == 0;
  if (!still && !moving) return {};
  const Image image = draw(scene_drawing(run, edge_pixels_), camera_, output.width, output.height);
  if (moving) {
    const double seconds = static_cast<double>(output.animation_interval) * run.scene().frame_time();
    if (const auto added = animation_->add(image, milliseconds(shown_, seconds)); !added) return added;
    ++shown_;
  }
  if (!still) return {};
  const auto png = encode_png(image);
  if (!png) return png.error();
  ++pictures_;
  return write_whole_file(folder_ / fmt::format("frame_{:05}.png", frame), as_text(*png));
}

Result<> PictureFiles::finish() {
  if (!animation_) return {};
  const auto bytes = animation_->finish();
  if (!bytes) return bytes.error();
  return write_whole_file(folder_ / animation_name, as_text(*bytes));
}

}  // namespace snip

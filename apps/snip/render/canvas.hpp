/// @file
/// A z-buffer rasteriser on plain arrays: triangles, lines and dots, each hidden by what is nearer.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "snip/render/camera.hpp"
#include "snip/render/image.hpp"

namespace snip {

/// Draws with `samples` × `samples` samples for each pixel, which smooths the edges of triangles; lines and
/// dots are smooth by themselves. What is drawn may reach beyond the canvas; what is not finite is left out.
///
/// Draw opaque triangles first: lines, dots and translucent triangles are hidden by what is there already,
/// but do not hide what comes after them.
class Canvas {
 public:
  /// @pre width, height and samples > 0
  Canvas(std::size_t width, std::size_t height, Colour background, std::size_t samples = 2);

  /// Covers a sample when its middle is inside. A sample on the common edge of two triangles belongs to
  /// exactly one of them. opacity < 1 mixes with what is there and leaves its nearness.
  void fill_triangle(const std::array<ScreenPoint, 3>& corners, Colour colour, double opacity = 1);
  /// A line with round ends, `width` pixels wide; lines thinner than a sample are drawn paler instead.
  void draw_line(const ScreenPoint& from, const ScreenPoint& to, double width, Colour colour);
  /// A disc facing the viewer, in front of what is as near as its middle.
  void draw_dot(const ScreenPoint& middle, double diameter, Colour colour);

  /// The picture so far: the mean of the samples of each pixel.
  [[nodiscard]] Image image() const;

 private:
  void mix(std::size_t sample, Colour colour, double opacity);
  void fill_small_triangle(const std::array<ScreenPoint, 3>& corners, Colour colour, double opacity);

  std::size_t width_, height_;  // in samples
  std::size_t samples_;
  std::vector<Colour> colours_;
  std::vector<float> nearness_;
};

}  // namespace snip

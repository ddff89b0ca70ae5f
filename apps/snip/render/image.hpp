/// @file
/// A picture in memory: 8 bits for each of red, green and blue (sRGB), row by row from the top left.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace snip {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Colour&) const = default;
};

struct Image {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 · width · height bytes

  /// @pre x < width, y < height
  [[nodiscard]] Colour at(std::size_t x, std::size_t y) const {
    const std::size_t i = 3 * (y * width + x);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

}  // namespace snip

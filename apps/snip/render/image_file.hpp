/// @file
/// Pictures as bytes of a file: PNG for one picture, WebP for a moving one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "snip/render/image.hpp"
#include "snip/result.hpp"

namespace snip {

/// @pre the image is not empty
Result<std::vector<std::uint8_t>> encode_png(const Image& image);

/// Collects the pictures of an animation that repeats for ever. Memory is that of the compressed pictures.
class Animation {
 public:
  /// @pre 0 < width, height
  static Result<Animation> create(std::size_t width, std::size_t height);
  Animation(Animation&&) noexcept;
  Animation& operator=(Animation&&) noexcept;
  ~Animation();

  /// Adds a picture that stays for `milliseconds`. @pre the size is that of the animation, milliseconds > 0
  Result<> add(const Image& image, int milliseconds);
  /// The file, with all pictures added so far. @pre at least one picture; nothing is added afterwards
  Result<std::vector<std::uint8_t>> finish();

 private:
  struct Encoder;
  explicit Animation(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace snip

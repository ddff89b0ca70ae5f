// PNG by stb_image_write, whose implementation is compiled here and stays private to this file.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "snip/render/image_file.hpp"

namespace snip {

Result<std::vector<std::uint8_t>> encode_png(const Image& image) {
  std::vector<std::uint8_t> bytes;
  const auto append = [](void* target, void* data, int size) {
    const auto* first = static_cast<const std::uint8_t*>(data);
    static_cast<std::vector<std::uint8_t>*>(target)->assign(first, first + size);
  };
  const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  if (stbi_write_png_to_func(append, &bytes, width, height, 3, image.rgb.data(), 3 * width) == 0)
    return Error{"the picture could not be encoded as PNG"};
  return bytes;
}

}  // namespace snip

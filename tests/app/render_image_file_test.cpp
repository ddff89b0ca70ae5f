// Picture files: what is written is read back by other decoders, pixel by pixel.
#include <doctest/doctest.h>
#include <webp/decode.h>

#include <cstring>
#include <string>

#include "snip/render/image_file.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

using snip::Image;

namespace {

Image test_picture(std::size_t width, std::size_t height, std::size_t shift) {
  Image image{width, height, {}};
  for (std::size_t i = 0; i < 3 * width * height; ++i)
    image.rgb.push_back(static_cast<std::uint8_t>((i + shift) * (i + 7) / 5));
  return image;
}

std::size_t number(const std::uint8_t* bytes, std::size_t size) {
  std::size_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

struct Frame {
  std::size_t milliseconds;
  std::vector<std::uint8_t> picture;  // the chunk with the compressed pixels
};

/// Takes an animated WebP apart, as its container specification describes it.
std::vector<Frame> frames_of(const std::vector<std::uint8_t>& file) {
  std::vector<Frame> frames;
  REQUIRE(file.size() > 12);
  REQUIRE(std::memcmp(file.data(), "RIFF", 4) == 0);
  REQUIRE(std::memcmp(file.data() + 8, "WEBP", 4) == 0);
  REQUIRE(number(&file[4], 4) + 8 == file.size());
  for (std::size_t at = 12; at + 8 <= file.size();) {
    const std::size_t size = number(&file[at + 4], 4);
    REQUIRE(at + 8 + size <= file.size());
    if (std::memcmp(&file[at], "ANMF", 4) == 0) {
      const auto* first = &file[at + 8];
      frames.push_back({number(first + 12, 3), {first + 16, first + size}});
    }
    at += 8 + size + size % 2;
  }
  return frames;
}

}  // namespace

TEST_CASE("a PNG has the pixels of the picture") {
  for (const auto& [width, height] : {std::pair<std::size_t, std::size_t>{1, 1}, {17, 5}, {200, 100}}) {
    const Image image = test_picture(width, height, 3);
    const auto file = snip::encode_png(image);
    REQUIRE(file);
    int w = 0, h = 0, channels = 0;
    stbi_uc* pixels =
        stbi_load_from_memory(file->data(), static_cast<int>(file->size()), &w, &h, &channels, 3);
    REQUIRE(pixels != nullptr);
    CHECK(static_cast<std::size_t>(w) == width);
    CHECK(static_cast<std::size_t>(h) == height);
    CHECK(channels == 3);
    CHECK(std::memcmp(pixels, image.rgb.data(), image.rgb.size()) == 0);
    stbi_image_free(pixels);
  }
}

TEST_CASE("an animation has a frame for each picture, for the time given, without loss") {
  auto animation = snip::Animation::create(64, 48);
  REQUIRE(animation);
  for (const int i : {0, 1, 2, 3})
    REQUIRE(animation->add(test_picture(64, 48, 11 * static_cast<std::size_t>(i)), 40 + i));
  const auto file = animation->finish();
  REQUIRE(file);
  const std::vector<Frame> frames = frames_of(*file);
  REQUIRE(frames.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(frames[i].milliseconds == 40 + i);
  int w = 0, h = 0;
  std::uint8_t* pixels = WebPDecodeRGB(frames[0].picture.data(), frames[0].picture.size(), &w, &h);
  REQUIRE(pixels != nullptr);
  CHECK(w == 64);
  CHECK(h == 48);
  CHECK(std::memcmp(pixels, test_picture(64, 48, 0).rgb.data(), 3 * 64 * 48) == 0);
  WebPFree(pixels);
}

TEST_CASE("a picture that stays the same lengthens its frame") {
  auto animation = snip::Animation::create(8, 8);
  REQUIRE(animation);
  for (const std::size_t i : {0u, 0u, 5u}) REQUIRE(animation->add(test_picture(8, 8, i), 100));
  const auto file = animation->finish();
  REQUIRE(file);
  std::size_t total = 0;
  for (const Frame& frame : frames_of(*file)) total += frame.milliseconds;
  CHECK(total == 300);
}

TEST_CASE("an animation that is too large is refused") {
  const auto animation = snip::Animation::create(20000, 10);
  REQUIRE_FALSE(animation);
  CHECK(animation.error().message.find("16383") != std::string::npos);
}

// The pictures in docs/pictures that are frames of a scene, rendered anew by `snip run`: SCENE_FRAME.png, or
// SCENE.png for the last frame. The scene is SCENE.json beside it or in examples/scenes.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <vector>

#include "docs/page_testing.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace fs = std::filesystem;

namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

Picture decoded(const std::string& png) {
  Picture picture;
  int channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const unsigned char*>(png.data()), static_cast<int>(png.size()),
                            &picture.width, &picture.height, &channels, 3),
      stbi_image_free);
  REQUIRE(pixels != nullptr);
  picture.rgb.assign(pixels.get(), pixels.get() + 3 * picture.width * picture.height);
  return picture;
}

/// The same but for a few pixels at edges, which another math library might round to the other side.
bool look_the_same(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return false;
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    if (!std::equal(&a.rgb[i], &a.rgb[i] + 3, &b.rgb[i])) ++different;
  return different <= a.rgb.size() / 3 / 5000;
}

fs::path scene_named(const std::string& name) {
  const fs::path beside = docs::root / "docs/pictures" / (name + ".json");
  return fs::exists(beside) ? beside : docs::root / "examples/scenes" / (name + ".json");
}

/// The bytes of the frame's PNG. Writes into the folder.
std::string rendered(const fs::path& scene, const std::string& frame, const fs::path& folder) {
  auto json = nlohmann::json::parse(docs::text_of(scene));
  const std::string last = frame.empty() ? std::to_string(json["frames"].get<int>()) : frame;
  // Nothing but this frame; a run writes its first and last one in any case.
  json["output"]["picture_interval"] = 10'000'000;
  json["output"]["animation_interval"] = 0;
  std::ofstream(folder / "scene.json") << json;
  const std::string in_folder = "cd '" + folder.string() + "' && ";
  docs::output_of(in_folder + "snip run scene.json -o out --frames " + last);
  return docs::text_of(folder / "out" / ("frame_" + std::string(5 - last.size(), '0') + last + ".png"));
}

}  // namespace

TEST_CASE("the frames in docs/pictures are what snip run draws") {
  // SNIP_WRITE_PICTURES=1 test_docs writes them anew: look at them, and at the text around them.
  const fs::path folder = fs::temp_directory_path() / ("snip_frames_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::regex name_of_frame(R"((.*?)(?:_([0-9]{1,5}))?\.png)");
  std::size_t frames = 0;
  for (const auto& entry : fs::directory_iterator(docs::root / "docs/pictures")) {
    const std::string name = entry.path().filename().string();
    std::smatch parts;
    if (!std::regex_match(name, parts, name_of_frame)) continue;
    ++frames;
    const std::string now = rendered(scene_named(parts[1]), parts[2], folder);
    if (std::getenv("SNIP_WRITE_PICTURES") != nullptr) std::ofstream(entry.path(), std::ios::binary) << now;
    const std::string committed = docs::text_of(entry.path());
    const bool same = now == committed || look_the_same(decoded(now), decoded(committed));
    CHECK_MESSAGE(same, name << " has changed; if so on purpose: SNIP_WRITE_PICTURES=1 test_docs");
  }
  CHECK(frames >= 11);
  fs::remove_all(folder);
}

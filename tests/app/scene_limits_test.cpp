// What a scene can ask for at most: what is said about more, and that nothing within breaks a run.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mesh_testing.hpp"
#include "snip/run/run.hpp"
#include "snip/run/scene_file.hpp"
#include "snip/run/scene_run.hpp"

using mesh_testing::TemporaryDirectory;

namespace {

const std::string grid = R"("shape": "grid", "columns": 2, "rows": 2)";

/// Why a scene cannot be read or started.
std::string error(const std::string& text) {
  const auto scene = snip::parse_scene(text, "s.json");
  if (!scene) return scene.error().message;
  const auto run = snip::SceneRun::start(*scene, ".");
  return run ? "no error" : run.error().message;
}

/// The error of a scene with a cloth and one more line.
std::string error_with(const std::string& line) {
  return error("{\n\"cloth\": {" + grid + "},\n" + line + "\n}");
}

std::string error_of_cloth(const std::string& line) { return error("{\"cloth\":\n{" + line + "}}"); }

/// 1234567 as the documentation has it: 1,234,567.
std::string with_commas(std::string digits) {
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

}  // namespace

TEST_CASE("limits: absurd sizes are refused before anything is built") {
  CHECK(error_of_cloth(R"("shape": "grid", "columns": 1000000000000, "rows": 1)") ==
        "s.json:2: /cloth/columns: has to be from 1 to 3000000, is 1000000000000");
  CHECK(error_of_cloth(R"("shape": "grid", "columns": 10000, "rows": 10000)") ==
        "s.json:1: /cloth: columns times rows can be at most 3000000, is 10000 times 10000");
  CHECK(error_of_cloth(R"("shape": "sphere", "level": 30)").find("from 0 to 9") != std::string::npos);
  CHECK(error_of_cloth(R"("shape": "torus", "around": 2, "through": 5)").find("has to be from 3") !=
        std::string::npos);
}

TEST_CASE("limits: pictures have at most 16 million pixels, however long one side is") {
  CHECK(error_with(R"("output": {"width": 16383, "height": 1024})") == "no error");
  CHECK(error_with(R"("output": {"width": 4096, "height": 4096})") == "no error");
  CHECK(error_with(R"("output": {"width": 16384})") ==
        "s.json:3: /output/width: has to be from 1 to 16383, is 16384");
  CHECK(error_with("\"output\": {\"height\": 16383,\n\"width\": 16383}") ==
        "s.json:4: /output/width: width times height can be at most 16777216, is 16383 times 16383");
}

TEST_CASE("limits: numbers that no calculation can take are named with their place") {
  CHECK(error_with("\"material\": {\n\"density\": 1e200}") ==
        "s.json:4: /material/density: has to be smaller than 1e+50 in magnitude, is 1e+200");
  CHECK(error_with("\"material\": {\"mass\": 1e-300}") ==
        "s.json:3: /material/mass: has to be greater than 1e-50, is 1e-300");
  CHECK(error_of_cloth(R"("shape": "grid", "columns": 1, "rows": 1, "spacing": 1e80)") ==
        "s.json:2: /cloth/spacing: has to be smaller than 1e+50 in magnitude, is 1e+80");
  CHECK(error_with("\"gravity\": [0, -1e50, 0]") ==
        "s.json:3: /gravity/1: has to be smaller than 1e+50 in magnitude, is -1e+50");
  CHECK(error_with("\"time_step\": 1e-51") == "s.json:3: /time_step: has to be greater than 1e-50, is 1e-51");
  CHECK(error_with(R"("output": {"camera": {"up": [0, 1e-200, 0]}})") ==
        "s.json:3: /output/camera/up: has to be longer than 1e-50, is 1e-200");
}

TEST_CASE("limits: a cloth or cutter that is put too far away is named with its place") {
  CHECK(error("{\n\"cloth\": {" + grid + R"(, "spacing": 1e40, "scale": 1e20}})") ==
        "s.json:2: /cloth: the mesh has a coordinate of 1e+50 or more where it is put");
  CHECK(error("{\"cloth\": {" + grid + R"(, "spacing": 5e49}})") ==
        "s.json:1: /cloth: the mesh has a coordinate of 1e+50 or more where it is put");
  CHECK(error("{\"cloth\": {" + grid + "},\n\"cutters\": [{\"mesh\": {" + grid +
              R"(, "scale": 9e49, "move": [9e49, 0, 0]}}]})") ==
        "s.json:2: /cutters/0/mesh: the mesh has a coordinate of 1e+50 or more where it is put");
  const auto scene = snip::parse_scene("{\"cloth\": {" + grid + R"(}, "cutters": [
    {"blade": {"edge": [[9e49, 0, 0], [0, 0, 1]], "keyframes": [{"at": 0, "move": [9e49, 0, 0]}, {"at": 1}]}}]})",
                                       "s.json");
  REQUIRE(scene);
  auto run = snip::SceneRun::start(*scene, ".");
  REQUIRE(run);
  const auto advanced = run->advance();
  REQUIRE_FALSE(advanced);
  CHECK(advanced.error().message.starts_with("frame 1 (0 s): s.json:2: /cutters/0/blade: "));
}

TEST_CASE("limits: a mass that makes no density is named with its place and the range") {
  CHECK(
      error("{\"cloth\": {\"shape\": \"triangle\", \"corners\": [[0, 0, 0], [2e-40, 0, 0], [0, 1e-40, 0]]},\n"
            "\"material\": {\"mass\": 1}}") ==
      "s.json:2: /material: a mass of 1 on this cloth is a density of 1e+80: it has to be greater than 1e-50 "
      "and smaller than 1e+50");
}

TEST_CASE("limits: whatever the numbers of a scene, the table of frames has none that is not finite") {
  const TemporaryDirectory directory;
  int number = 0;
  for (const char* spacing : {"1e-49", "1e-20", "1", "1e20", "2e49"})
    for (const char* rest :
         {R"("gravity": [0, 0, -9e49])", R"("material": {"density": 9e49})",
          R"("material": {"density": 2e-50})",
          R"("material": {"stiffness": 9e49, "damping": 9e49}, "time_step": 9e49)",
          R"("wind": [9e49, 0, 0], "air_drag": 9e49, "time_step": 2e-50)",
          R"("gravity": [0, 0, -9e49], "time_step": 9e49, "integrator": "forward_euler")"}) {
      const std::string text =
          "{\"cloth\": {" + grid + ", \"spacing\": " + spacing + "}, " + rest +
          R"(, "frames": 20, "output": {"picture_interval": 0, "animation_interval": 0}})";
      CAPTURE(text);
      const std::string out = std::to_string(number++);
      (void)snip::run_scene({directory.write("s.json", text), directory / out, {}, false});
      const std::string table = directory.read(out + "/frames.csv");
      REQUIRE(std::count(table.begin(), table.end(), '\n') >= 2);
      const std::string rows = table.substr(table.find('\n'));
      CHECK_MESSAGE(rows.find_first_not_of("0123456789,.e+-\n") == std::string::npos, rows);
    }
}

TEST_CASE("limits: an animation that nobody could keep in memory is refused with what to do about it") {
  const TemporaryDirectory directory;
  const auto scene = directory.write(
      "s.json", "{\"cloth\": {" + grid + "},\n\"output\": {\"width\": 4000, \"height\": 2500}}");
  const auto ran = snip::run_scene({scene, directory / "out", 10'000, false});
  REQUIRE_FALSE(ran);
  CHECK(ran.error().message ==
        scene.string() +
            ":2: /output: an animation of 4000 by 2500 pixels can have at most 1000 pictures: 10000 "
            "frames want an animation_interval of 11, or 0 for no animation");
  CHECK(std::filesystem::is_empty(directory / "out"));
}

TEST_CASE("limits: the documentation names those that the messages name") {
  std::ifstream file(SNIP_SOURCE_DIR "/docs/scene_file.md");
  REQUIRE(file);
  std::stringstream page;
  page << file.rdbuf();
  const std::string limits = page.str().substr(page.str().find("## Limits"));
  const auto is_listed = [&](const std::string& message) {
    // "has to be from 1 to 1000, is 0", "can be at most 1000, is 9"
    const std::size_t end = message.rfind(", is ");
    REQUIRE_MESSAGE(end != std::string::npos, message);
    const std::size_t start = message.rfind(' ', end - 1) + 1;
    const std::string most = with_commas(message.substr(start, end - start));
    CHECK_MESSAGE(limits.find(" " + most + " ") != std::string::npos, most << " of " << message);
  };
  for (const char* line : {R"("frames": 0)", R"("steps_per_frame": 0)", R"("output": {"width": 0})",
                           R"("output": {"picture_interval": -1})", R"("output": {"animation_interval": -1})",
                           R"("cutters": [{"mesh": {"shape": "sphere", "level": 0}, "times": 0}])"})
    is_listed(error_with(line));
  for (const char* line :
       {R"("shape": "grid", "columns": 0)", R"("shape": "random_sheet", "columns": 0)",
        R"("shape": "hexagon", "rings": 0)", R"("shape": "fan", "count": 0)",
        R"("shape": "curved_sheet", "cells": 0)", R"("shape": "sphere", "level": 10)",
        R"("shape": "torus", "around": 0)", R"("shape": "torus", "around": 9000, "through": 9000)",
        R"("shape": "cylinder", "around": 0)", R"("shape": "moebius_strip", "around": 0)"})
    is_listed(error_of_cloth(line));
  for (const std::size_t most : {snip::most_frames, snip::most_pixels, snip::most_animation_pictures})
    CHECK_MESSAGE(limits.find(" " + with_commas(std::to_string(most)) + " ") != std::string::npos, most);
}

/// @file
/// Reads scene files. docs/scene_file.md describes them.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "snip/result.hpp"
#include "snip/run/scene.hpp"

namespace snip {

/// The scene that `text` describes. What is wrong with it comes back as "name:line: /json/pointer: message".
/// Reads no other file.
Result<Scene> parse_scene(std::string_view text, const std::string& name);

Result<Scene> read_scene(const std::filesystem::path& path);

}  // namespace snip

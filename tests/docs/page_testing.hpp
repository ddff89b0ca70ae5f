/// @file
/// What the tests of README.md and docs/ share: files of the repository, and programs of this build.
#pragma once
#include <doctest/doctest.h>
#include <stdio.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace docs {

inline const std::filesystem::path root = SNIP_SOURCE_DIR;

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE_MESSAGE(file, path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What a command prints, with the programs of this build on the path.
inline std::string output_of(const std::string& command) {
  const std::string programs = SNIP_PROGRAMS;
  FILE* pipe = ::popen(("PATH=" + programs + ":$PATH; " + command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    output.append(buffer.data(), n);
  CHECK_MESSAGE(::pclose(pipe) == 0, command);
  return output;
}

}  // namespace docs

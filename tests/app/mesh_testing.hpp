/// @file
/// What the tests of mesh files share.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "snip/mesh_file/mesh_file.hpp"

namespace mesh_testing {

/// The mesh in the text. Fails the test with the reader's words if there is none.
inline snip::Mesh parsed(std::string_view text, snip::MeshFormat format) {
  snip::Result<snip::Mesh> mesh = snip::parse_mesh(text, format, "input");
  REQUIRE_MESSAGE(mesh, (mesh ? "" : mesh.error().message));
  return *mesh;
}

/// What the reader says about a text that it refuses.
inline std::string refusal(std::string_view text, snip::MeshFormat format) {
  const snip::Result<snip::Mesh> mesh = snip::parse_mesh(text, format, "input");
  return mesh ? "accepted" : mesh.error().message;
}

/// A fresh directory, removed with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory()
      : path_(std::filesystem::temp_directory_path() /
              ("snip_test_" + std::to_string(::getpid()) + "_" + std::to_string(count_++))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }
  /// Writes a file. @return its path
  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  [[nodiscard]] std::string read(std::string_view name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

 private:
  std::filesystem::path path_;
  static inline int count_ = 0;
};

}  // namespace mesh_testing

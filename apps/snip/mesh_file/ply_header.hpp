/// @file
/// The header of a PLY file: which elements follow, how many, and what each consists of.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "snip/mesh_file/mesh.hpp"

namespace snip {

struct PlyProperty {
  std::string name;
  std::string label;  ///< "property 'name'", for messages
  ScalarType type = ScalarType::float32;
  bool is_list = false;
  ScalarType count_type = ScalarType::uint8;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::size_t line = 0;  ///< where the header announces it
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t lines = 0;  ///< length of the header
  std::size_t bytes = 0;
};

/// Reads the header and checks that the bytes behind it can hold the elements that it announces.
/// @throws scan::ParseError
PlyHeader read_ply_header(std::string_view bytes);

}  // namespace snip

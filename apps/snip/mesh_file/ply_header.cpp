// Reads the header of a PLY file; see ply_header.hpp.
#include "snip/mesh_file/ply_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "snip/mesh_file/scalar.hpp"
#include "snip/mesh_file/scan.hpp"

namespace snip {
namespace {

using scan::fail;
using scan::fail_at_line;
using scan::quote;

// Far more than any program writes; keeps a hostile header from costing more than its length.
constexpr std::size_t max_properties = 1000;

ScalarType to_type(std::string_view name, std::size_t line) {
  constexpr std::array<std::string_view, 8> long_names = {"int8",  "uint8",  "int16",   "uint16",
                                                          "int32", "uint32", "float32", "float64"};
  for (std::size_t i = 0; i < long_names.size(); ++i) {
    const auto type = static_cast<ScalarType>(i);
    if (name == long_names[i] || name == name_of(type)) return type;
  }
  fail_at_line(line, "unknown property type {}", quote(name));
}

PlyHeader::Encoding to_encoding(scan::Words words, std::size_t line) {
  const std::string_view name = words.next();
  const std::string_view version = words.next();
  if (version != "1.0") fail_at_line(line, "unknown PLY version {}: expected 1.0", quote(version));
  if (name == "ascii") return PlyHeader::Encoding::ascii;
  if (name == "binary_little_endian") return PlyHeader::Encoding::little_endian;
  if (name == "binary_big_endian") return PlyHeader::Encoding::big_endian;
  fail_at_line(line, "unknown PLY format {}", quote(name));
}

PlyProperty to_property(scan::Words words, std::size_t line) {
  PlyProperty property;
  std::string_view type = words.next();
  if (type == "list") {
    property.is_list = true;
    property.count_type = to_type(words.next(), line);
    if (property.count_type >= ScalarType::float32)
      fail_at_line(line, "the length of a list must be an integer");
    type = words.next();
  }
  property.type = to_type(type, line);
  property.name = words.next();
  if (property.name.empty()) fail_at_line(line, "property without a name");
  property.label = "property " + quote(property.name);
  return property;
}

PlyElement to_element(scan::Words words, std::size_t line) {
  PlyElement element;
  element.name = words.next();
  if (element.name.empty()) fail_at_line(line, "element without a name");
  const std::int64_t count = scan::to_integer(words.next(), line, "element count");
  if (count < 0) fail_at_line(line, "element count is negative: {}", count);
  element.count = static_cast<std::size_t>(count);
  element.line = line;
  return element;
}

// The least that one row can take: in ascii a digit and a separator for each value.
std::size_t least_row_size(const PlyElement& element, PlyHeader::Encoding encoding) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (encoding == PlyHeader::Encoding::ascii)
      size += 2;
    else
      size += size_of(property.is_list ? property.count_type : property.type);
  }
  return size;
}

void check_counts(const PlyHeader& header, std::size_t bytes_behind) {
  // The last row of an ascii file may lack its line feed.
  std::size_t left = bytes_behind + (header.encoding == PlyHeader::Encoding::ascii ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    if (element.count == 0) continue;
    if (element.properties.empty())
      fail_at_line(element.line, "element {} has no properties", quote(element.name));
    const std::size_t row = least_row_size(element, header.encoding);
    if (element.count > left / row)
      fail_at_line(element.line, "the header announces {} of element {}, the file is too short for that",
                   element.count, quote(element.name));
    left -= element.count * row;
  }
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeader header;
  scan::Lines lines(bytes);
  std::optional<PlyHeader::Encoding> encoding;
  if (!lines.next() || lines.line() != "ply") fail_at_line(1, "not a PLY file: it must begin with 'ply'");
  while (true) {
    if (!lines.next()) fail_at_line(lines.number(), "the header ends without 'end_header'");
    const std::size_t line = lines.number();
    scan::Words words(lines.line());
    const std::string_view keyword = words.next();
    if (keyword == "end_header") break;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      encoding = to_encoding(words, line);
    } else if (keyword == "element") {
      header.elements.push_back(to_element(words, line));
    } else if (keyword == "property") {
      if (header.elements.empty()) fail_at_line(line, "property before the first element");
      PlyProperty property = to_property(words, line);
      auto& properties = header.elements.back().properties;
      if (properties.size() == max_properties)
        fail_at_line(line, "an element with more than {} properties", max_properties);
      if (std::ranges::find(properties, property.name, &PlyProperty::name) != properties.end())
        fail_at_line(line, "property {} is there twice", quote(property.name));
      properties.push_back(std::move(property));
    } else {
      fail_at_line(line, "{} is no PLY keyword", quote(keyword));
    }
  }
  if (!encoding) fail_at_line(lines.number(), "the header has no 'format' line");
  header.encoding = *encoding;
  header.lines = lines.number();
  header.bytes = bytes.size() - lines.rest().size();
  check_counts(header, lines.rest().size());
  return header;
}

}  // namespace snip

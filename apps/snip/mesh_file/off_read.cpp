// Reads OFF in ascii, with normals (N), colours (C) and texture coordinates (ST) of the vertices.
#include <array>
#include <cmath>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/polygon_soup.hpp"
#include "snip/mesh_file/scan.hpp"

namespace snip {
namespace {

using scan::fail;
using scan::fail_at_line;
using scan::quote;
using scan::Words;

class OffReader {
 public:
  explicit OffReader(std::string_view bytes) : lines_(bytes) {}

  Mesh read() {
    read_counts(read_keyword());
    for (std::size_t vertex = 0; vertex < vertices_; ++vertex) read_vertex(vertex);
    for (std::size_t face = 0; face < faces_; ++face) read_face(face);
    if (lines_.next_with_words())
      fail_at_line(lines_.number(), "unexpected {}: there are more lines than the header announces",
                   quote(Words(lines_.line()).next()));
    if (soup_.polygon_ends.empty()) fail("there is no face in it");
    if (has_uvs_) soup_.corner_uvs = soup_.corner_positions;
    if (has_normals_) soup_.corner_normals = soup_.corner_positions;
    if (has_colours_) soup_.colours.types.assign(channels_, colour_type_);
    return to_mesh(std::move(soup_));
  }

 private:
  // Counts may follow the keyword in its line. @return what is left of the line
  Words read_keyword() {
    if (!lines_.next_with_words()) fail("the file is empty");
    Words words(lines_.line());
    const std::string_view keyword = words.next();
    std::string_view prefix = keyword;
    const auto take = [&prefix](std::string_view letters) {
      if (!prefix.starts_with(letters)) return false;
      prefix.remove_prefix(letters.size());
      return true;
    };
    has_uvs_ = take("ST");
    has_colours_ = take("C");
    has_normals_ = take("N");
    if (prefix == "4OFF" || prefix == "nOFF" || prefix == "4nOFF")
      fail_at_line(lines_.number(), "OFF in other than three dimensions is not supported: {}",
                   quote(keyword));
    if (prefix != "OFF") fail_at_line(lines_.number(), "not an OFF file: it begins with {}", quote(keyword));
    if (words.peek() == "BINARY")
      fail_at_line(lines_.number(), "binary OFF is not supported: write it in ascii");
    return words;
  }

  void read_counts(Words words) {
    if (words.peek().empty()) {
      if (!lines_.next_with_words()) fail_at_line(lines_.number(), "the file ends before the counts");
      words = Words(lines_.line());
    }
    vertices_ = read_count(words.next(), "vertex count");
    faces_ = read_count(words.next(), "face count");
    // A vertex takes at least "0 0 0\n", a face "3 0 0 0\n"; the last line may lack its line feed.
    const std::size_t left = lines_.rest().size() + 1;
    if (vertices_ > left / 6 || faces_ > left / 2)
      fail_at_line(lines_.number(),
                   "the header announces {} vertices and {} faces, the file is too short for that", vertices_,
                   faces_);
    soup_.positions.reserve(vertices_);
    soup_.polygon_ends.reserve(faces_);
  }

  [[nodiscard]] std::size_t read_count(std::string_view word, std::string_view what) const {
    const std::int64_t count = scan::to_integer(word, lines_.number(), what);
    if (count < 0) fail_at_line(lines_.number(), "{} is negative: {}", what, count);
    return static_cast<std::size_t>(count);
  }

  Words next_line(std::string_view what, std::size_t index, std::size_t count) {
    if (!lines_.next_with_words())
      fail_at_line(lines_.number(), "the file ends after {} of {} {}", index, count, what);
    return Words(lines_.line());
  }

  // Position, normal, colour, texture coordinates, in this order.
  void read_vertex(std::size_t vertex) {
    Words words = next_line("vertices", vertex, vertices_);
    const std::size_t line = lines_.number();
    Eigen::Vector3d position;
    for (double& value : position) {
      const std::string_view word = words.next();
      value = scan::to_number(word, line, "coordinate");
      if (std::abs(value) >= cut::largest_coordinate)
        fail_at_line(line, "coordinate is too large: {}", quote(word));
    }
    soup_.positions.push_back(position);
    if (has_normals_) {
      Eigen::Vector3d normal;
      for (double& value : normal) value = scan::to_number(words.next(), line, "normal");
      soup_.normals.push_back(normal);
    }
    if (has_colours_) read_colour(words, line);
    if (has_uvs_) {
      Eigen::Vector2d uv;
      for (double& value : uv) value = scan::to_number(words.next(), line, "texture coordinate");
      soup_.uvs.push_back(uv);
    }
    if (!words.peek().empty())
      fail_at_line(line, "unexpected {} at the end of the vertex", quote(words.peek()));
  }

  // Files have three or four channels, as integers up to 255 or as fractions. The first vertex tells how
  // many, any value that is no integer tells that they are fractions.
  void read_colour(Words& words, std::size_t line) {
    if (channels_ == 0) {
      std::size_t count = 0;
      for (Words rest = words; !rest.next().empty();) ++count;
      channels_ = count >= (has_uvs_ ? 6u : 4u) ? 4 : 3;
    }
    std::array<double, 4> colour{0, 0, 0, 1};
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::string_view word = words.next();
      colour[c] = scan::to_number(word, line, "colour");
      if (word.find_first_not_of("0123456789") != std::string_view::npos) colour_type_ = ScalarType::float64;
    }
    soup_.colours.values.push_back(colour);
  }

  void read_face(std::size_t face) {
    Words words = next_line("faces", face, faces_);
    const std::size_t line = lines_.number();
    std::size_t corners = read_count(words.next(), "number of corners");
    for (; corners > 0; --corners) {
      const std::int64_t index = scan::to_integer(words.next(), line, "vertex index");
      if (index < 0 || index >= static_cast<std::int64_t>(vertices_))
        fail_at_line(line, "vertex index {} is out of range: the file has {} vertices, counted from 0", index,
                     vertices_);
      soup_.corner_positions.push_back(static_cast<std::uint32_t>(index));
    }
    soup_.polygon_ends.push_back(soup_.corner_positions.size());
  }

  scan::Lines lines_;
  PolygonSoup soup_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
  std::size_t channels_ = 0;
  ScalarType colour_type_ = ScalarType::uint8;
  bool has_uvs_ = false;
  bool has_colours_ = false;
  bool has_normals_ = false;
};

}  // namespace

Mesh read_off(std::string_view bytes) { return OffReader(bytes).read(); }

}  // namespace snip

// Reads Wavefront OBJ: text in, triangles with UV and normals by corner out.
#include <algorithm>
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

constexpr std::array<std::string_view, 19> freeform_keywords = {
    "vp",   "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",
    "hole", "scrv",   "sp",  "end",  "con",  "bsp",  "bzp",   "cdc",  "res"};

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : lines_(bytes) {}

  Mesh read() {
    while (lines_.next()) {
      line_ = lines_.number();
      read_statement(statement());
    }
    check_index_ranges();
    if (soup_.polygon_ends.empty()) fail("there is no face in it: a surface needs 'f' lines");
    fill_up(soup_.corner_uvs);
    fill_up(soup_.corner_normals);
    soup_.colours.types.assign(soup_.colours.empty() ? 0 : 3, ScalarType::float64);
    if (!soup_.colours.empty()) soup_.colours.values.resize(soup_.positions.size(), {1, 1, 1, 1});
    return to_mesh(std::move(soup_));
  }

 private:
  // The current line without its comment, joined with the lines that a backslash continues it on.
  std::string_view statement() {
    std::string_view text = scan::without_comment(lines_.line());
    if (!text.ends_with('\\')) return text;
    joined_.clear();
    while (text.ends_with('\\')) {
      joined_.append(text.substr(0, text.size() - 1)).append(" ");
      text = lines_.next() ? scan::without_comment(lines_.line()) : std::string_view{};
    }
    return joined_.append(text);
  }

  void read_statement(std::string_view text) {
    Words words(text);
    const std::string_view keyword = words.next();
    if (keyword.empty()) return;
    if (keyword == "v") return read_position(words);
    if (keyword == "vt") return read_uv(words);
    if (keyword == "vn") return read_normal(words);
    if (keyword == "f" || keyword == "fo") return read_face(words);
    if (std::ranges::find(freeform_keywords, keyword) != freeform_keywords.end())
      fail_at_line(line_, "free-form geometry ({}) is not supported: export polygons", quote(keyword));
    // Anything else is about looks and names; what is not even a word tells that this is another format.
    const auto is_word = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (!std::ranges::all_of(keyword, is_word)) fail_at_line(line_, "{} is no OBJ keyword", quote(keyword));
  }

  void read_position(Words words) {
    std::array<double, 7> numbers{};
    std::size_t count = 0;
    while (count < 3 || !words.peek().empty()) {
      const std::string_view word = words.next();
      if (count == numbers.size()) fail_at_line(line_, "a vertex with more than 7 numbers");
      numbers[count] =
          scan::to_number(word, line_, count < 3 ? "coordinate" : "number behind the coordinates");
      if (count < 3 && std::abs(numbers[count]) >= cut::largest_coordinate)
        fail_at_line(line_, "coordinate is too large: {}", quote(word));
      ++count;
    }
    // x y z, then a weight (4 or 7 numbers; for curves only), then a colour (6 or 7 numbers).
    if (count == 5) fail_at_line(line_, "a vertex with 5 numbers: expected 3, 4, 6 or 7");
    if (count >= 6) {
      soup_.colours.values.resize(soup_.positions.size(), {1, 1, 1, 1});
      soup_.colours.values.push_back({numbers[count - 3], numbers[count - 2], numbers[count - 1], 1});
    }
    soup_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
  }

  void read_uv(Words words) {
    const double u = scan::to_number(words.next(), line_, "texture coordinate");
    const double v = words.peek().empty() ? 0 : scan::to_number(words.next(), line_, "texture coordinate");
    soup_.uvs.emplace_back(u, v);
  }

  void read_normal(Words words) {
    Eigen::Vector3d normal;
    for (double& value : normal) value = scan::to_number(words.next(), line_, "normal");
    soup_.normals.push_back(normal);
  }

  void read_face(Words words) {
    while (!words.peek().empty()) {
      std::string_view corner = words.next();
      const std::string_view whole = corner;
      const std::string_view position = next_index(corner);
      const std::string_view uv = next_index(corner);
      const std::string_view normal = next_index(corner);
      if (!corner.empty()) fail_at_line(line_, "malformed corner {}", quote(whole));
      if (!uv.empty()) append(soup_.corner_uvs, uv, soup_.uvs.size(), texture);
      if (!normal.empty()) append(soup_.corner_normals, normal, soup_.normals.size(), normals);
      soup_.corner_positions.push_back(resolve(position, soup_.positions.size(), vertex));
    }
    soup_.polygon_ends.push_back(soup_.corner_positions.size());
  }

  // Splits the part before the next slash off.
  static std::string_view next_index(std::string_view& corner) {
    const std::size_t slash = corner.find('/');
    const std::string_view part = corner.substr(0, slash);
    corner = slash == std::string_view::npos ? std::string_view{} : corner.substr(slash + 1);
    return part;
  }

  // What an index is about.
  enum Kind : std::size_t { vertex, texture, normals };
  static constexpr std::array<std::string_view, 3> kind_names = {"vertex index", "texture coordinate index",
                                                                 "normal index"};

  // Attributes begin with the first corner that has one; the corners before it have none.
  void append(std::vector<std::uint32_t>& indices, std::string_view word, std::size_t count, Kind kind) {
    indices.resize(soup_.corner_positions.size(), no_index);
    indices.push_back(resolve(word, count, kind));
  }

  void fill_up(std::vector<std::uint32_t>& indices) const {
    if (!indices.empty()) indices.resize(soup_.corner_positions.size(), no_index);
  }

  // Counts from 1, or backwards from the last one so far when negative. What is not defined yet may still
  // come: the highest such index is looked at in the end.
  std::uint32_t resolve(std::string_view word, std::size_t count, Kind kind) {
    const std::int64_t number = scan::to_integer(word, line_, kind_names[kind]);
    if (number == 0) fail_at_line(line_, "{} 0 is out of range: the first is 1", kind_names[kind]);
    if (number < 0) {
      if (-number > static_cast<std::int64_t>(count))
        fail_at_line(line_, "{} {} is out of range: {} defined so far", kind_names[kind], number, count);
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(count) + number);
    }
    if (number > static_cast<std::int64_t>(count) && number > forward_[kind].number)
      forward_[kind] = {number, line_};
    if (number >= static_cast<std::int64_t>(no_index))
      fail_at_line(line_, "{} {} is out of range", kind_names[kind], number);
    return static_cast<std::uint32_t>(number - 1);
  }

  void check_index_ranges() const {
    const std::array<std::size_t, 3> counts = {soup_.positions.size(), soup_.uvs.size(),
                                               soup_.normals.size()};
    for (std::size_t kind = 0; kind < 3; ++kind)
      if (forward_[kind].number > static_cast<std::int64_t>(counts[kind]))
        fail_at_line(forward_[kind].line, "{} {} is out of range: the file has {}", kind_names[kind],
                     forward_[kind].number, counts[kind]);
  }

  struct Reference {
    std::int64_t number = 0;
    std::size_t line = 0;
  };

  scan::Lines lines_;
  std::size_t line_ = 0;
  std::string joined_;
  PolygonSoup soup_;
  std::array<Reference, 3> forward_;
};

}  // namespace

Mesh read_obj(std::string_view bytes) { return ObjReader(bytes).read(); }

}  // namespace snip

// Reads PLY: header in ply_header.hpp, then rows of any elements; vertices and faces are kept.
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/ply_header.hpp"
#include "snip/mesh_file/polygon_soup.hpp"
#include "snip/mesh_file/scalar.hpp"
#include "snip/mesh_file/scan.hpp"

namespace snip {
namespace {

using scan::fail;
using scan::fail_at_byte;
using scan::fail_at_line;

// Values of an ascii body: one row is one line. Blank lines are skipped.
class AsciiRows {
 public:
  AsciiRows(std::string_view bytes, const PlyHeader& header) : lines_(bytes) {
    while (lines_.number() < header.lines) lines_.next();
  }
  void begin_row(const PlyElement& element, std::size_t row) {
    do
      if (!lines_.next())
        fail_at_line(lines_.number(), "the file ends after {} of {} rows of element {}", row, element.count,
                     scan::quote(element.name));
    while (scan::Words(lines_.line()).next().empty());
    words_ = scan::Words(lines_.line());
  }
  void end_row() {
    const std::string_view word = words_.next();
    if (!word.empty()) fail_here("unexpected {} at the end of the line", scan::quote(word));
  }
  void expect_end() {
    while (lines_.next())
      if (const std::string_view word = scan::Words(lines_.line()).next(); !word.empty())
        fail_here("unexpected {}: there are more rows than the header announces", scan::quote(word));
  }
  double next(const PlyProperty& property, ScalarType) {
    return scan::to_number(words_.next(), lines_.number(), property.label);
  }
  // The words of a list are missed when they are read; a list can announce no more than a line can hold.
  void expect_list(std::size_t length, const PlyProperty& property) const {
    if (length > lines_.line().size())
      fail_here("list {} is longer than its line", scan::quote(property.name));
  }
  template <class... Args>
  [[noreturn]] void fail_here(fmt::format_string<Args...> format, Args&&... args) const {
    fail_at_line(lines_.number(), format, std::forward<Args>(args)...);
  }

 private:
  scan::Lines lines_;
  scan::Words words_;
};

// Values of a binary body.
class BinaryRows {
 public:
  BinaryRows(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes),
        offset_(header.bytes),
        big_endian_(header.encoding == PlyHeader::Encoding::big_endian) {}
  void begin_row(const PlyElement& element, std::size_t row) {
    element_ = &element;
    row_ = row;
    row_offset_ = offset_;
  }
  void end_row() const {}
  // Blanks do not matter: some programs end any file with a line feed.
  void expect_end() const {
    const std::size_t extra = bytes_.find_first_not_of(" \t\r\n", offset_);
    if (extra != std::string_view::npos)
      fail_at_byte(offset_, "there are {} bytes more than the header announces", bytes_.size() - offset_);
  }
  double next(const PlyProperty&, ScalarType type) {
    const std::size_t size = size_of(type);
    expect(size);
    const double value = decode(type, bytes_.substr(offset_, size), big_endian_);
    offset_ += size;
    return value;
  }
  void expect_list(std::size_t length, const PlyProperty& property) const {
    expect(length * size_of(property.type));
  }
  template <class... Args>
  [[noreturn]] void fail_here(fmt::format_string<Args...> format, Args&&... args) const {
    fail_at_byte(row_offset_, format, std::forward<Args>(args)...);
  }

 private:
  void expect(std::size_t size) const {
    if (size > bytes_.size() - offset_)
      fail_here("the file ends within row {} of {} of element {}", row_ + 1, element_->count,
                scan::quote(element_->name));
  }

  std::string_view bytes_;
  std::size_t offset_;
  bool big_endian_;
  const PlyElement* element_ = nullptr;
  std::size_t row_ = 0;
  std::size_t row_offset_ = 0;
};

template <class Rows>
std::size_t list_length(Rows& rows, const PlyProperty& property) {
  const double length = rows.next(property, property.count_type);
  if (!(length >= 0) || length != std::floor(length) || length > 4294967295.0)
    rows.fail_here("{} is no length for list {}", length, scan::quote(property.name));
  rows.expect_list(static_cast<std::size_t>(length), property);
  return static_cast<std::size_t>(length);
}

template <class Rows>
void skip(Rows& rows, const PlyProperty& property) {
  std::size_t values = property.is_list ? list_length(rows, property) : 1;
  for (; values > 0; --values) rows.next(property, property.type);
}

// Where a value of a vertex goes.
enum VertexSlot : std::size_t { x, y, z, nx, ny, nz, s, t, red, green, blue, alpha, slot_count };

std::size_t slot_of(const PlyProperty& property) {
  constexpr std::array<std::pair<std::string_view, VertexSlot>, 16> names = {{{"x", x},
                                                                              {"y", y},
                                                                              {"z", z},
                                                                              {"nx", nx},
                                                                              {"ny", ny},
                                                                              {"nz", nz},
                                                                              {"s", s},
                                                                              {"t", t},
                                                                              {"u", s},
                                                                              {"v", t},
                                                                              {"texture_u", s},
                                                                              {"texture_v", t},
                                                                              {"red", red},
                                                                              {"green", green},
                                                                              {"blue", blue},
                                                                              {"alpha", alpha}}};
  if (!property.is_list)
    for (const auto& [name, slot] : names)
      if (property.name == name) return slot;
  return slot_count;
}

template <class Rows>
void read_vertices(Rows& rows, const PlyElement& element, PolygonSoup& soup) {
  std::vector<std::size_t> slots;
  std::array<const PlyProperty*, slot_count + 1> present{};
  for (const PlyProperty& property : element.properties) {
    slots.push_back(slot_of(property));
    present[slots.back()] = &property;
  }
  if (!present[x] || !present[y] || !present[z])
    fail_at_line(element.line, "element 'vertex' lacks a property x, y or z");
  const bool has_normals = present[nx] && present[ny] && present[nz];
  const bool has_uvs = present[s] && present[t];
  if (present[red] && present[green] && present[blue])
    for (const std::size_t channel : {red, green, blue, alpha})
      if (present[channel]) soup.colours.types.push_back(present[channel]->type);

  soup.positions.reserve(element.count);
  std::array<double, slot_count + 1> values{};
  for (std::size_t row = 0; row < element.count; ++row) {
    rows.begin_row(element, row);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (slots[i] == slot_count) {
        skip(rows, property);
        continue;
      }
      const double value = rows.next(property, property.type);
      values[slots[i]] = value;
      if (!std::isfinite(value))
        rows.fail_here("property '{}' of vertex {} is not finite: {}", property.name, row, value);
      if (slots[i] <= z && std::abs(value) >= cut::largest_coordinate)
        rows.fail_here("coordinate '{}' of vertex {} is too large: {}", property.name, row, value);
    }
    rows.end_row();
    soup.positions.emplace_back(values[x], values[y], values[z]);
    if (has_normals) soup.normals.emplace_back(values[nx], values[ny], values[nz]);
    if (has_uvs) soup.uvs.emplace_back(values[s], values[t]);
    if (!soup.colours.types.empty())
      soup.colours.values.push_back({values[red], values[green], values[blue], values[alpha]});
  }
}

// What faces need to know about the vertices, which may come behind them.
struct VertexFacts {
  std::size_t count = 0;
  bool has_normals = false;
  bool has_uvs = false;
};

VertexFacts facts_of(const PlyHeader& header) {
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") {
      std::array<bool, slot_count + 1> present{};
      for (const PlyProperty& property : element.properties) present[slot_of(property)] = true;
      return {element.count, present[nx] && present[ny] && present[nz], present[s] && present[t]};
    }
  return {};
}

template <class Rows>
void read_faces(Rows& rows, const PlyElement& element, const VertexFacts& vertices, PolygonSoup& soup) {
  const PlyProperty* corners = nullptr;
  const PlyProperty* texcoord = nullptr;
  for (const PlyProperty& property : element.properties) {
    if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
      corners = &property;
    if (property.is_list && property.name == "texcoord" && !vertices.has_uvs) texcoord = &property;
  }
  if (!corners) fail_at_line(element.line, "element 'face' lacks a list 'vertex_indices'");

  std::vector<Eigen::Vector2d> uvs;
  soup.polygon_ends.reserve(element.count);
  for (std::size_t row = 0; row < element.count; ++row) {
    rows.begin_row(element, row);
    const std::size_t begin = soup.corner_positions.size();
    for (const PlyProperty& property : element.properties) {
      if (&property == corners) {
        for (std::size_t left = list_length(rows, property); left > 0; --left) {
          const double index = rows.next(property, property.type);
          if (!(index >= 0 && index < static_cast<double>(vertices.count)) || index != std::floor(index))
            rows.fail_here(
                "vertex index {} of face {} is out of range: the file has {} vertices, counted from 0", index,
                row, vertices.count);
          soup.corner_positions.push_back(static_cast<std::uint32_t>(index));
        }
      } else if (&property == texcoord) {
        uvs.clear();
        const std::size_t length = list_length(rows, property);
        for (std::size_t i = 0; i < length; ++i) {
          const double value = rows.next(property, property.type);
          if (!std::isfinite(value)) rows.fail_here("texcoord of face {} is not finite: {}", row, value);
          if (i % 2 == 0)
            uvs.emplace_back(value, 0);
          else
            uvs.back().y() = value;
        }
      } else {
        skip(rows, property);
      }
    }
    rows.end_row();
    soup.polygon_ends.push_back(soup.corner_positions.size());
    if (texcoord && uvs.size() == soup.corner_positions.size() - begin) {
      soup.corner_uvs.resize(begin, no_index);
      for (const Eigen::Vector2d& uv : uvs) {
        soup.corner_uvs.push_back(static_cast<std::uint32_t>(soup.uvs.size()));
        soup.uvs.push_back(uv);
      }
    }
  }
  if (!soup.corner_uvs.empty()) soup.corner_uvs.resize(soup.corner_positions.size(), no_index);
}

template <class Rows>
Mesh read_body(Rows rows, const PlyHeader& header) {
  PolygonSoup soup;
  const VertexFacts vertices = facts_of(header);
  bool vertices_seen = false;
  bool faces_seen = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && !std::exchange(vertices_seen, true)) {
      read_vertices(rows, element, soup);
    } else if (element.name == "face" && !std::exchange(faces_seen, true)) {
      read_faces(rows, element, vertices, soup);
    } else if (element.name == "vertex" || element.name == "face") {
      fail_at_line(element.line, "element '{}' is there twice", element.name);
    } else {
      for (std::size_t row = 0; row < element.count; ++row) {
        rows.begin_row(element, row);
        for (const PlyProperty& property : element.properties) skip(rows, property);
        rows.end_row();
      }
    }
  }
  rows.expect_end();
  if (soup.positions.empty()) fail("there is no vertex in it");
  if (soup.polygon_ends.empty()) fail("there is no face in it: a surface needs an element 'face'");
  if (vertices.has_normals) soup.corner_normals = soup.corner_positions;
  if (vertices.has_uvs) soup.corner_uvs = soup.corner_positions;
  return to_mesh(std::move(soup));
}

}  // namespace

Mesh read_ply(std::string_view bytes) {
  const PlyHeader header = read_ply_header(bytes);
  if (header.encoding == PlyHeader::Encoding::ascii) return read_body(AsciiRows(bytes, header), header);
  return read_body(BinaryRows(bytes, header), header);
}

}  // namespace snip

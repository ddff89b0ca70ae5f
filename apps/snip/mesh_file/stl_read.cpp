// Reads STL, binary or ascii: loose corners in, points shared by exact equality out.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/polygon_soup.hpp"
#include "snip/mesh_file/scalar.hpp"
#include "snip/mesh_file/scan.hpp"

namespace snip {
namespace {

using scan::fail;
using scan::fail_at_byte;
using scan::fail_at_line;
using scan::quote;

// Corners are copies of the same number in the file, so exact equality tells which are the same point, and
// no distance has to be guessed.
class CornerWelder {
 public:
  void add(const Eigen::Vector3d& corner) {
    const Eigen::Vector3d key = corner + Eigen::Vector3d::Zero();  // turns -0 into 0, which is equal to it
    const auto [entry, is_new] = index_of_.try_emplace({key.x(), key.y(), key.z()}, soup.positions.size());
    if (is_new) soup.positions.push_back(corner);
    soup.corner_positions.push_back(static_cast<std::uint32_t>(entry->second));
    if (soup.corner_positions.size() % 3 == 0) soup.polygon_ends.push_back(soup.corner_positions.size());
  }

  PolygonSoup soup;

 private:
  struct Hash {
    std::size_t operator()(const std::array<double, 3>& key) const {
      std::uint64_t hash = 0;
      for (const double value : key) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
      }
      return hash;
    }
  };
  std::unordered_map<std::array<double, 3>, std::size_t, Hash> index_of_;
};

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

std::size_t announced_facets(std::string_view bytes) {
  return static_cast<std::size_t>(decode(ScalarType::uint32, bytes.substr(80, 4), false));
}

Mesh read_binary(std::string_view bytes) {
  if (bytes.size() < header_size)
    fail(
        "not an STL file: neither ascii ('solid') nor long enough for the header of a binary one ({} of {} "
        "bytes)",
        bytes.size(), header_size);
  const std::size_t facets = announced_facets(bytes);
  const std::size_t expected = header_size + facets * facet_size;
  if (bytes.size() != expected)
    fail_at_byte(
        80, "the header announces {} facets, which take {} bytes, but the file has {}: truncated or no STL",
        facets, expected, bytes.size());
  if (facets == 0) fail("there is no facet in it");
  CornerWelder corners;
  for (std::size_t facet = 0; facet < facets; ++facet)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t offset = header_size + facet * facet_size + 12 * (corner + 1);
      Eigen::Vector3d position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = decode(ScalarType::float32, bytes.substr(offset + 4 * axis, 4), false);
        if (!std::isfinite(value))
          fail_at_byte(offset, "a coordinate of facet {} is not finite: {}", facet, value);
        position[static_cast<Eigen::Index>(axis)] = value;
      }
      corners.add(position);
    }
  return to_mesh(std::move(corners.soup));
}

// Keywords of ascii STL are lower case; some programs write upper case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(
      word, keyword, {}, [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
}

// Ascii STL is one statement in each line; the words that carry nothing are checked all the same, because
// they are all that tells an STL from another text.
class AsciiReader {
 public:
  explicit AsciiReader(std::string_view bytes) : lines_(bytes) {}

  Mesh read() {
    while (lines_.next_with_words()) {
      expect({"solid"});
      read_solid();
    }
    if (corners_.soup.polygon_ends.empty()) fail("there is no facet in it");
    return to_mesh(std::move(corners_.soup));
  }

 private:
  void read_solid() {
    while (true) {
      advance();
      if (is_keyword(scan::Words(lines_.line()).peek(), "endsolid")) return;
      expect({"facet", "normal"});
      advance();
      expect({"outer", "loop"});
      for (int corner = 0; corner < 3; ++corner) {
        advance();
        scan::Words words = expect({"vertex"});
        Eigen::Vector3d position;
        for (double& value : position) {
          const std::string_view word = words.next();
          value = scan::to_number(word, lines_.number(), "coordinate");
          if (std::abs(value) >= cut::largest_coordinate)
            fail_at_line(lines_.number(), "coordinate is too large: {}", quote(word));
        }
        corners_.add(position);
      }
      advance();
      expect({"endloop"});
      advance();
      expect({"endfacet"});
    }
  }

  void advance() {
    if (!lines_.next_with_words())
      fail_at_line(lines_.number(), "the file ends within a solid: 'endsolid' is missing");
  }

  scan::Words expect(std::initializer_list<std::string_view> keywords) const {
    scan::Words words(lines_.line());
    for (const std::string_view keyword : keywords) {
      const std::string_view word = words.next();
      if (!is_keyword(word, keyword))
        fail_at_line(lines_.number(), "expected '{}', found {}", keyword, quote(word));
    }
    return words;
  }

  scan::Lines lines_;
  CornerWelder corners_;
};

}  // namespace

Mesh read_stl(std::string_view bytes) {
  // Some programs begin binary files with "solid" too: the size decides.
  const bool has_binary_size =
      bytes.size() >= header_size && bytes.size() == header_size + announced_facets(bytes) * facet_size;
  scan::Lines lines(bytes);
  const bool is_ascii = lines.next_with_words() && is_keyword(scan::Words(lines.line()).peek(), "solid");
  if (has_binary_size || !is_ascii) return read_binary(bytes);
  return AsciiReader(bytes).read();
}

}  // namespace snip

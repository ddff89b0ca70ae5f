// Reading STL.
#include <algorithm>
#include <cctype>

#include "mesh_testing.hpp"
#include "snip/mesh_file/scalar.hpp"

using mesh_testing::parsed;
using snip::ScalarType;
using snip::Triangle;
constexpr auto stl = snip::MeshFormat::stl;

namespace {

std::string refusal(std::string_view text) { return mesh_testing::refusal(text, stl); }

std::string facet(std::string_view a, std::string_view b, std::string_view c) {
  std::string text = "facet normal 0 0 nan\n outer loop\n";
  for (const std::string_view corner : {a, b, c}) text.append("  vertex ").append(corner).append("\n");
  return text + " endloop\nendfacet\n";
}

std::string binary(std::string_view header, const std::vector<std::array<double, 9>>& facets) {
  std::string bytes(header);
  bytes.resize(80);
  snip::encode(ScalarType::uint32, static_cast<double>(facets.size()), bytes);
  for (const auto& corners : facets) {
    bytes.append(12, '\0');
    for (const double value : corners) snip::encode(ScalarType::float32, value, bytes);
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::vector<std::array<double, 9>> square = {{0, 0, 0, 1, 0, 0, 1, 1, 0},
                                                   {1, 1, 0, 0, 1, 0, -0.0, 0, 0}};

void check_square(const snip::Mesh& mesh) {
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});
}

}  // namespace

TEST_CASE("stl: corners of equal coordinates are one point, -0 and 0 included") {
  check_square(parsed(
      "solid a b\n" + facet("0 0 0", "1 0 0", "1 1 0") + facet("1 1 0", "0 1 0", "-0 0 0") + "endsolid a b\n",
      stl));
  check_square(parsed(binary("made by hand", square), stl));
}

TEST_CASE("stl: a binary file that begins with 'solid' is told by its size") {
  check_square(parsed(binary("solid but binary", square), stl));
}

TEST_CASE("stl: ascii in upper case, behind blank lines") {
  std::string text =
      "\n\tsolid a\n" + facet("0 0 0", "1 0 0", "1 1 0") + facet("1 1 0", "0 1 0", "0 0 0") + "endsolid a\n";
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  check_square(parsed(text, stl));
}

TEST_CASE("stl: nearly equal corners stay apart") {
  const snip::Mesh mesh = parsed(
      "solid\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("0 1e-12 0", "0 1 0", "1 0 0") + "endsolid", stl);
  CHECK(mesh.positions.size() == 4);
}

TEST_CASE("stl: several solids are one mesh, their common corners one point") {
  check_square(parsed("solid a\r\n" + facet("0 0 0", "1 0 0", "1 1 0") + "endsolid a\r\n\r\nsolid b\n" +
                          facet("1 1 0", "0 1 0", "0 0 0") + "endsolid b\n",
                      stl));
}

TEST_CASE("stl: what is wrong with a binary file is named with its byte") {
  const std::string good = binary("", square);
  CHECK(refusal("rubbish") ==
        "input: not an STL file: neither ascii ('solid') nor long enough for the header of a binary one "
        "(7 of 84 bytes)");
  CHECK(refusal(good.substr(0, 150)) ==
        "input: byte 80: the header announces 2 facets, which take 184 bytes, but the file has 150: "
        "truncated or no STL");
  CHECK(refusal(good + "x").find("input: byte 80:") == 0);
  CHECK(refusal(binary("", {})) == "input: there is no facet in it");
  CHECK(refusal(std::string(84, '\xff')) ==
        "input: byte 80: the header announces 4294967295 facets, which take 214748364834 bytes, but the file "
        "has "
        "84: truncated or no STL");
  auto bad = square;
  bad[1][5] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(binary("", bad)) == "input: byte 158: a coordinate of facet 1 is not finite: nan");
}

TEST_CASE("stl: what is wrong with an ascii file is named with its line") {
  const std::string one = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0");
  CHECK(refusal("solids\n").find("input: not an STL file") == 0);
  CHECK(refusal("solid\nendsolid\n") == "input: there is no facet in it");
  CHECK(refusal(one) == "input:8: the file ends within a solid: 'endsolid' is missing");
  CHECK(refusal("solid\n" + facet("0 0", "1 0 0", "0 1 0")) == "input:4: coordinate is missing");
  CHECK(refusal("solid\n" + facet("0 0 inf", "1 0 0", "0 1 0")) ==
        "input:4: coordinate is not finite: 'inf'");
  CHECK(refusal("solid\n" + facet("0 0 1e99", "1 0 0", "0 1 0")) ==
        "input:4: coordinate is too large: '1e99'");
  CHECK(refusal("solid\nfacet\n") == "input:2: expected 'normal', found ''");
  CHECK(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n") ==
        "input:5: expected 'vertex', found 'endloop'");
  CHECK(refusal(one + "endsolid\nmore\n") == "input:10: expected 'solid', found 'more'");
}

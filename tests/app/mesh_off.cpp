// Reading OFF.
#include "mesh_testing.hpp"
#include "snip/mesh_file/formats.hpp"

using mesh_testing::parsed;
using snip::ScalarType;
using snip::Triangle;
constexpr auto off = snip::MeshFormat::off;

namespace {
std::string refusal(std::string_view text) { return mesh_testing::refusal(text, off); }
}  // namespace

TEST_CASE("off: points, polygons, comments, colours of faces left out") {
  const snip::Mesh mesh = parsed(
      "# cube side\nOFF # comment\n4 2 0\n\n0 0 0\n1 0 0 # one\r\n1 1 0\n0.1 1 0\n4 0 1 2 3 255 0 0\n2 0 1\n",
      off);
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.1, 1, 0}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
  CHECK(mesh.polygon_count == 2);
  CHECK(mesh.colours.empty());
}

TEST_CASE("off: counts in the first line, the third one missing") {
  CHECK(parsed("OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", off).triangles == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("off: attributes of vertices") {
  const snip::Mesh mesh = parsed(
      "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 1 7 0 0\n1 0 0 0 0 1 2 3 4 8 1 0\n0 1 0 0 0 1 5 6 7 9 0 1\n3 2 1 "
      "0\n",
      off);
  CHECK(mesh.colours.types == std::vector<ScalarType>(4, ScalarType::uint8));
  CHECK(mesh.colours.values[0] == std::array<double, 4>{255, 0, 1, 7});
  CHECK(mesh.normals[2] == Eigen::Vector3d(0, 0, 1));
  CHECK(mesh.uvs == std::vector<Eigen::Vector2d>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(mesh.uv_triangles == mesh.triangles);
  CHECK(mesh.normal_triangles == mesh.triangles);
  const snip::Mesh fractions = parsed("COFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 1 .5 0\n0 1 0 0 0 0\n3 2 1 0\n", off);
  CHECK(fractions.colours.types == std::vector<ScalarType>(3, ScalarType::float64));
  CHECK(fractions.colours.values[1] == std::array<double, 4>{1, 0.5, 0, 1});
}

TEST_CASE("off: fractional colours that are whole stay fractions when written") {
  snip::Mesh mesh = parsed("COFF\n3 1 0\n0 0 0 1 1 1 1.0\n1 0 0 1 1 1 1\n0 1 0 0 0 0 1\n3 2 1 0\n", off);
  std::string text;
  snip::write_off(mesh, text);
  const snip::Mesh again = parsed(text, off);
  CHECK(again.colours.types == mesh.colours.types);
  CHECK(again.colours.values == mesh.colours.values);
}

TEST_CASE("off: what is wrong is named with its line") {
  const std::string points = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  CHECK(refusal("\n# only this\n") == "input: the file is empty");
  CHECK(refusal("solid\n") == "input:1: not an OFF file: it begins with 'solid'");
  CHECK(refusal("OFF BINARY\n") == "input:1: binary OFF is not supported: write it in ascii");
  CHECK(refusal("4OFF\n") == "input:1: OFF in other than three dimensions is not supported: '4OFF'");
  CHECK(refusal("OFF\n") == "input:1: the file ends before the counts");
  CHECK(refusal("OFF\n3 x 0\n") == "input:2: face count is not an integer: 'x'");
  CHECK(refusal("OFF\n-3 1 0\n") == "input:2: vertex count is negative: -3");
  CHECK(refusal("OFF\n4000000000 1 0\n0 0 0\n") ==
        "input:2: the header announces 4000000000 vertices and 1 faces, the file is too short for that");
  CHECK(refusal("OFF\n3 9223372036854775807 0\n0 0 0\n1 0 0\n0 1 0\n") ==
        "input:2: the header announces 3 vertices and 9223372036854775807 faces, the file is too short for "
        "that");
  CHECK(refusal("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n") == "input: there is no face in it");
  CHECK(refusal(points) == "input:5: the file ends after 0 of 1 faces");
  CHECK(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n#2345678\n") == "input:5: the file ends after 2 of 3 vertices");
  CHECK(refusal(points + "3 0 1 3\n") ==
        "input:6: vertex index 3 is out of range: the file has 3 vertices, counted from 0");
  CHECK(refusal(points + "3 0 1 -1\n") ==
        "input:6: vertex index -1 is out of range: the file has 3 vertices, counted from 0");
  CHECK(refusal(points + "3 0 1\n") == "input:6: vertex index is missing");
  CHECK(refusal(points + "99999999999 0 1\n") == "input:6: vertex index is missing");
  CHECK(refusal(points + "3 0 1 2\n# more\n3 2 1 0\n") ==
        "input:8: unexpected '3': there are more lines than the header announces");
  CHECK(refusal(points + "3 0 1 2\n# the end\n\n") == "accepted");
  CHECK(refusal("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n") == "input:4: coordinate is not finite: 'inf'");
  CHECK(refusal("OFF\n3 1 0\n0 0 0\n1 -1e51 0\n0 1 0\n") == "input:4: coordinate is too large: '-1e51'");
  CHECK(refusal("OFF\n3 1 0\n0 0 0\n1 0 0 255 0 0\n0 1 0\n") ==
        "input:4: unexpected '255' at the end of the vertex");
}

// Reading Wavefront OBJ.
#include "mesh_testing.hpp"

using mesh_testing::parsed;
using snip::no_index;
using snip::Triangle;
constexpr auto obj = snip::MeshFormat::obj;

namespace {
std::string refusal(std::string_view text) { return mesh_testing::refusal(text, obj); }
}  // namespace

TEST_CASE("obj: points keep their order and every bit") {
  const snip::Mesh mesh = parsed("v 0.1 -0 1e-300\nv +1 2.5e3 3\nv .5 5. 1e-400\nv 9 9 9\nf 3 1 2\n", obj);
  REQUIRE(mesh.positions.size() == 4);
  CHECK(mesh.positions[0] == Eigen::Vector3d(0.1, 0, 1e-300));
  CHECK(std::signbit(mesh.positions[0].y()));
  CHECK(mesh.positions[1] == Eigen::Vector3d(1, 2500, 3));
  CHECK(mesh.positions[2] == Eigen::Vector3d(0.5, 5, 0));
  CHECK(mesh.triangles == std::vector<Triangle>{{2, 0, 1}});
  CHECK(mesh.uv_triangles.empty());
  CHECK(mesh.normal_triangles.empty());
  CHECK(mesh.colours.empty());
}

TEST_CASE("obj: polygons, and which triangle is of which") {
  const snip::Mesh mesh =
      parsed("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 2 0\nf 1 2 3 4\nf 4 3 5\nf 1 2\n", obj);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 4}});
  CHECK(mesh.polygon_of_triangle == std::vector<std::uint32_t>{0, 0, 1});
  CHECK(mesh.polygon_count == 3);
}

TEST_CASE("obj: attributes by corner, some corners without") {
  const snip::Mesh mesh = parsed(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt .5 .25 9\nvt 1\nvn 0 0 1\nvn 0 1 0\n"
      "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//2 3//1\nf 1/3/2 2/2/1 3/1/2\nf 1/ 2// 3\n",
      obj);
  CHECK(mesh.uvs == std::vector<Eigen::Vector2d>{{0, 0}, {0.5, 0.25}, {1, 0}});
  CHECK(mesh.normals == std::vector<Eigen::Vector3d>{{0, 0, 1}, {0, 1, 0}});
  const Triangle none{no_index, no_index, no_index};
  CHECK(mesh.uv_triangles == std::vector<Triangle>{none, {0, 1, 2}, none, {2, 1, 0}, none});
  CHECK(mesh.normal_triangles == std::vector<Triangle>{none, none, {0, 1, 0}, {1, 0, 1}, none});
}

TEST_CASE("obj: attributes follow their corner through triangulation") {
  const snip::Mesh mesh = parsed(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nvt 0 0\nvt 2 0\nvt 2 2\nvt 1 .5\nvt 0 2\n"
      "f 1/1 2/2 3/3 4/4 5/5\n",
      obj);
  REQUIRE(mesh.triangles.size() == 3);
  CHECK(mesh.uv_triangles == mesh.triangles);
}

TEST_CASE("obj: negative indices count back from the statement, positive ones may look ahead") {
  const snip::Mesh mesh =
      parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 1 2 4\nv 0 0 1\nf -1 -2 -4\n", obj);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 3}, {3, 2, 0}});
}

TEST_CASE("obj: CRLF, tabs, comments, continued lines, no last line feed") {
  const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3";
  const std::string odd =
      "\xef\xbb\xbf# made by hand\r\n\r\no thing\r\nmtllib a b.mtl\r\nv\t0 0\\\r\n 0\r\n  v 1 0 0 # "
      "second\r\n"
      "v 0 1 0\r\ng a\r\ns off\r\nusemtl m\r\nl 1 2\r\np 1\r\nf 1 \\\r\n2 \\\r\n3\r\n";
  CHECK(parsed(odd, obj).positions == parsed(plain, obj).positions);
  CHECK(parsed(odd, obj).triangles == parsed(plain, obj).triangles);
}

TEST_CASE("obj: weights are no colours, colours may begin late") {
  const snip::Mesh mesh = parsed("v 0 0 0 1\nv 1 0 0 .1 .2 .3\nv 0 1 0 1 .4 .5 .6\nv 2 2 2\nf 1 2 3\n", obj);
  REQUIRE(mesh.colours.values.size() == 4);
  CHECK(mesh.colours.types == std::vector<snip::ScalarType>(3, snip::ScalarType::float64));
  CHECK(mesh.colours.values[0] == std::array<double, 4>{1, 1, 1, 1});
  CHECK(mesh.colours.values[1] == std::array<double, 4>{0.1, 0.2, 0.3, 1});
  CHECK(mesh.colours.values[2] == std::array<double, 4>{0.4, 0.5, 0.6, 1});
  CHECK(mesh.colours.values[3] == std::array<double, 4>{1, 1, 1, 1});
}

TEST_CASE("obj: what is wrong is named with its line") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  CHECK(refusal("") == "input: the file is empty");
  CHECK(refusal("# nothing\n") == "input: there is no face in it: a surface needs 'f' lines");
  CHECK(refusal(points) == "input: there is no face in it: a surface needs 'f' lines");
  CHECK(refusal(points + "f 1 2 4\nf 1 2 9\nf 1 2 3\n") ==
        "input:5: vertex index 9 is out of range: the file has 3");
  CHECK(refusal(points + "f 1 2 0\n") == "input:4: vertex index 0 is out of range: the first is 1");
  CHECK(refusal(points + "f 1 2 -4\n") == "input:4: vertex index -4 is out of range: 3 defined so far");
  CHECK(refusal(points + "vt 0 0\nf 1/1 2/2 3/1\n") ==
        "input:5: texture coordinate index 2 is out of range: the file has 1");
  CHECK(refusal(points + "f 1//1 2//1 3//1\n") == "input:4: normal index 1 is out of range: the file has 0");
  CHECK(refusal(points + "f 1 2 4294967296\n") == "input:4: vertex index 4294967296 is out of range");
  CHECK(refusal(points + "f 1 2 99999999999999999999\n") ==
        "input:4: vertex index is too large: '99999999999999999999'");
  CHECK(refusal(points + "f 1 2 x\n") == "input:4: vertex index is not an integer: 'x'");
  CHECK(refusal(points + "f 1 2 /1\n") == "input:4: vertex index is missing");
  CHECK(refusal(points + "f 1 2 3/1/1/1\n") == "input:4: malformed corner '3/1/1/1'");
  CHECK(refusal("v 0 0\n") == "input:1: coordinate is missing");
  CHECK(refusal("v 0 0 0,5\n") == "input:1: coordinate is not a number: '0,5'");
  CHECK(refusal("\nv 0 nan 0\n") == "input:2: coordinate is not finite: 'nan'");
  CHECK(refusal("v 0 -inf 0\n") == "input:1: coordinate is not finite: '-inf'");
  CHECK(refusal("v 0 1e999 0\n") == "input:1: coordinate is too large: '1e999'");
  CHECK(refusal("v 0 1e50 0\n") == "input:1: coordinate is too large: '1e50'");  // as libcut has it
  CHECK(refusal("v 0 -2e50 0\n") == "input:1: coordinate is too large: '-2e50'");
  CHECK(refusal("v 0 0 0 0 0\n") == "input:1: a vertex with 5 numbers: expected 3, 4, 6 or 7");
  CHECK(refusal("v 0 0 0 0 0 0 0 0\n") == "input:1: a vertex with more than 7 numbers");
  CHECK(refusal("vn 0 0\n") == "input:1: normal is missing");
  CHECK(refusal("vt\n") == "input:1: texture coordinate is missing");
  CHECK(refusal("cstype bezier\n") ==
        "input:1: free-form geometry ('cstype') is not supported: export polygons");
}

TEST_CASE("obj: bytes that are no text are refused in their first line, and shown in ascii") {
  CHECK(refusal(std::string_view("\x7f"
                                 "ELF\x02\x01\x00\x00",
                                 8)) == "input:1: '\\x7fELF\\x02\\x01\\x00\\x00' is no OBJ keyword");
  CHECK(refusal("{\"mesh\": 1}") == "input:1: '{\"mesh\":' is no OBJ keyword");
}

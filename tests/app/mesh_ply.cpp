// Reading and writing PLY.
#include "mesh_testing.hpp"
#include "snip/mesh_file/formats.hpp"
#include "snip/mesh_file/scalar.hpp"

using mesh_testing::parsed;
using snip::ScalarType;
using snip::Triangle;
constexpr auto ply = snip::MeshFormat::ply;

namespace {

std::string refusal(std::string_view text) { return mesh_testing::refusal(text, ply); }

// A quadrilateral with everything that PLY files tend to carry along.
constexpr std::string_view elements =
    "comment made by hand\nobj_info none\nelement camera 1\nproperty float fov\nproperty list uint8 int8 "
    "path\n"
    "element vertex 4\nproperty double x\nproperty float y\nproperty int16 z\nproperty float nx\n"
    "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property uchar alpha\nproperty float confidence\nproperty double s\nproperty double t\n"
    "element face 2\nproperty uchar flags\nproperty list uchar uint vertex_indices\nend_header\n";

std::string ascii_file() {
  return "ply\nformat ascii 1.0\n" + std::string(elements) +
         "35 3 1 2 -3\n"
         "0.1 0 0 0 0 1 255 0 7 128 0.5 0 0\n"
         "1 0 0 0 0 1 0 1 2 3 0.5 1 0\n\n"
         "1 1 0 0 0 1 4 5 6 7 0.5 1 1\n"
         "0 1 -2 0 0 1 8 9 10 11 0.5 0 1\n"
         "1 3 0 1 2\n0 3 2 3 0\n";
}

// The same file in binary; encode() writes little endian, big endian is that reversed value by value.
std::string binary_file(bool big_endian) {
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
                    std::string(elements);
  const auto put = [&](ScalarType type, double value) {
    std::string bytes;
    snip::encode(type, value, bytes);
    out += big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  };
  put(ScalarType::float32, 35);
  put(ScalarType::uint8, 3);
  for (const double value : {1, 2, -3}) put(ScalarType::int8, value);
  const double rows[4][13] = {{0.1, 0, 0, 0, 0, 1, 255, 0, 7, 128, 0.5, 0, 0},
                              {1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 0.5, 1, 0},
                              {1, 1, 0, 0, 0, 1, 4, 5, 6, 7, 0.5, 1, 1},
                              {0, 1, -2, 0, 0, 1, 8, 9, 10, 11, 0.5, 0, 1}};
  using enum ScalarType;
  const ScalarType types[13] = {float64, float32, int16, float32, float32, float32, uint8,
                                uint8,   uint8,   uint8, float32, float64, float64};
  for (const auto& row : rows)
    for (int i = 0; i < 13; ++i) put(types[i], row[i]);
  const double faces[2][5] = {{1, 3, 0, 1, 2}, {0, 3, 2, 3, 0}};
  for (const auto& face : faces)
    for (int i = 0; i < 5; ++i) put(i < 2 ? uint8 : uint32, face[i]);
  return out;
}

void check_quadrilateral(const snip::Mesh& mesh) {
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{{0.1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, -2}});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});
  CHECK(mesh.normal_triangles == mesh.triangles);
  CHECK(mesh.normals == std::vector<Eigen::Vector3d>(4, {0, 0, 1}));
  CHECK(mesh.uv_triangles == mesh.triangles);
  CHECK(mesh.uvs == std::vector<Eigen::Vector2d>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  CHECK(mesh.colours.types == std::vector<ScalarType>(4, ScalarType::uint8));
  REQUIRE(mesh.colours.values.size() == 4);
  CHECK(mesh.colours.values[0] == std::array<double, 4>{255, 0, 7, 128});
  CHECK(mesh.colours.values[3] == std::array<double, 4>{8, 9, 10, 11});
}

std::string small(std::string_view vertices, std::string_view faces, std::string_view body) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::string(faces) +
         "\nproperty list uchar int vertex_index\nend_header\n" + std::string(body);
}

}  // namespace

TEST_CASE("ply: the same mesh in ascii and in both binary forms") {
  check_quadrilateral(parsed(ascii_file(), ply));
  check_quadrilateral(parsed(binary_file(false), ply));
  check_quadrilateral(parsed(binary_file(true), ply));
}

TEST_CASE("ply: CRLF in an ascii file") {
  std::string text;
  for (const char c : ascii_file()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check_quadrilateral(parsed(text, ply));
}

TEST_CASE("ply: faces may come before vertices, and carry texture coordinates by corner") {
  const snip::Mesh mesh = parsed(
      "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n3 0 1 2 0\n3 2 1 0 6 0 0 1 0 1 0.5\n0 0 0\n1 0 0\n0 1 0\n",
      ply);
  const std::uint32_t none = snip::no_index;
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}});
  CHECK(mesh.uv_triangles == std::vector<Triangle>{{none, none, none}, {0, 1, 2}});
  CHECK(mesh.uvs == std::vector<Eigen::Vector2d>{{0, 0}, {1, 0}, {1, 0.5}});
}

TEST_CASE("ply: writing what was read gives the same mesh, colours in their own type") {
  const snip::Mesh mesh = parsed(ascii_file(), ply);
  std::string bytes;
  snip::write_ply(mesh, bytes);
  CHECK(bytes.find("property uchar alpha") != std::string::npos);
  check_quadrilateral(parsed(bytes, ply));
}

TEST_CASE("ply: interpolated colours are rounded and kept in range") {
  snip::Mesh mesh = parsed(ascii_file(), ply);
  mesh.colours.values[0] = {254.5, -3, 300, 127.4};
  std::string bytes;
  snip::write_ply(mesh, bytes);
  CHECK(parsed(bytes, ply).colours.values[0] == std::array<double, 4>{255, 0, 255, 127});
}

TEST_CASE("ply: a mistake in the header is named with its line") {
  CHECK(refusal("plx\n") == "input:1: not a PLY file: it must begin with 'ply'");
  CHECK(refusal("ply\nformat ascii 1.0\n") == "input:2: the header ends without 'end_header'");
  CHECK(refusal("ply\nend_header\n") == "input:2: the header has no 'format' line");
  CHECK(refusal("ply\nformat ascii 2.0\n") == "input:2: unknown PLY version '2.0': expected 1.0");
  CHECK(refusal("ply\nformat utf8 1.0\n") == "input:2: unknown PLY format 'utf8'");
  CHECK(refusal("ply\nvertices 3\n") == "input:2: 'vertices' is no PLY keyword");
  CHECK(refusal("ply\nproperty float x\n") == "input:2: property before the first element");
  CHECK(refusal("ply\nelement vertex 1\nproperty real x\n") == "input:3: unknown property type 'real'");
  CHECK(refusal("ply\nelement vertex 1\nproperty list float int x\n") ==
        "input:3: the length of a list must be an integer");
  CHECK(refusal("ply\nelement vertex 1\nproperty float x\nproperty int x\n") ==
        "input:4: property 'x' is there twice");
  CHECK(refusal("ply\nelement vertex -1\n") == "input:2: element count is negative: -1");
  CHECK(refusal("ply\nelement vertex many\n") == "input:2: element count is not an integer: 'many'");
  CHECK(refusal("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n") ==
        "input:3: element 'vertex' has no properties");
  CHECK(
      refusal(
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n") ==
      "input:3: element 'vertex' lacks a property x, y or z");
  CHECK(refusal(
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty int vertex_indices\nend_header\n0 0 0\n0\n") ==
        "input:7: element 'face' lacks a list 'vertex_indices'");
}

TEST_CASE("ply: a header that lies about counts is refused before anything is allocated") {
  CHECK(refusal(small("4000000000", "1", "0 0 0\n")) ==
        "input:3: the header announces 4000000000 of element 'vertex', the file is too short for that");
  CHECK(
      refusal(small("1", "9223372036854775807", "0 0 0\n3 0 0 0\n")) ==
      "input:7: the header announces 9223372036854775807 of element 'face', the file is too short for that");
}

TEST_CASE("ply: a mistake in an ascii body is named with its line") {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(refusal(small("0", "0", "")) == "input: there is no vertex in it");
  CHECK(refusal(small("3", "0", points)) ==
        "input: there is no face in it: a surface needs an element 'face'");
  CHECK(refusal(small("3", "1", points + "3 0 1 3\n")) ==
        "input:13: vertex index 3 of face 0 is out of range: the file has 3 vertices, counted from 0");
  CHECK(refusal(small("3", "1", points + "3 0 1 -1\n")) ==
        "input:13: vertex index -1 of face 0 is out of range: the file has 3 vertices, counted from 0");
  CHECK(refusal(small("3", "1", points + "3 0 1 1.5\n")) ==
        "input:13: vertex index 1.5 of face 0 is out of range: the file has 3 vertices, counted from 0");
  CHECK(refusal(small("3", "1", points + "3 0 1\n")) == "input:13: property 'vertex_index' is missing");
  CHECK(refusal(small("3", "1", points + "-3 0 1 2\n")) ==
        "input:13: -3 is no length for list 'vertex_index'");
  CHECK(refusal(small("3", "1", points + "3e9 0 1 2\n")) ==
        "input:13: list 'vertex_index' is longer than its line");
  CHECK(refusal(small("3", "1", points + "3 0 1 2 1\n")) ==
        "input:13: unexpected '1' at the end of the line");
  CHECK(refusal(small("3", "2", points + "3 0 1 2\n")) ==
        "input:13: the file ends after 1 of 2 rows of element 'face'");
  CHECK(refusal(small("3", "1", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")) ==
        "input:11: property 'y' is not finite: 'nan'");
  CHECK(refusal(small("3", "1", "0 0 0\n1 1e60 0\n0 1 0\n3 0 1 2\n")) ==
        "input:11: coordinate 'y' of vertex 1 is too large: 1e+60");
}

TEST_CASE("ply: every truncation of a binary file is refused, with the place") {
  const std::string whole = binary_file(false);
  const std::size_t body = whole.find("end_header\n") + 11;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string text = refusal(whole.substr(0, size));
    CHECK_MESSAGE(text != "accepted", size);
  }
  CHECK(refusal(whole.substr(0, whole.size() - 1)) ==
        "input: byte " + std::to_string(whole.size() - 14) +
            ": the file ends within row 2 of 2 of element 'face'");
  CHECK(refusal(whole.substr(0, body + 4)) ==
        "input:5: the header announces 1 of element 'camera', the file is too short for that");
}

TEST_CASE("ply: what follows the rows that the header announces is refused, unless it is blank") {
  const std::string text = ascii_file();
  CHECK(refusal(text + "\r\n \n") == "accepted");
  CHECK(refusal(text + "\n1 3 0 2 3\n") ==
        "input:35: unexpected '1': there are more rows than the header announces");
  for (const bool big_endian : {false, true}) {
    const std::string binary = binary_file(big_endian);
    CHECK(refusal(binary + "\r\n") == "accepted");
    CHECK(refusal(binary + std::string(14, '\0')) ==
          "input: byte " + std::to_string(binary.size()) +
              ": there are 14 bytes more than the header announces");
  }
}

TEST_CASE("ply: bad values in a binary body") {
  std::string file = binary_file(false);
  const std::size_t vertices = file.find("end_header\n") + 11 + 8;
  const auto overwrite = [&](std::size_t at, ScalarType type, double value) {
    std::string bytes, copy = file;
    snip::encode(type, value, bytes);
    copy.replace(at, bytes.size(), bytes);
    return copy;
  };
  const std::string where = "input: byte " + std::to_string(vertices) + ": ";
  CHECK(refusal(overwrite(vertices, ScalarType::float64, std::nan(""))) ==
        where + "property 'x' of vertex 0 is not finite: nan");
  CHECK(refusal(overwrite(vertices, ScalarType::float64, 1e60)) ==
        where + "coordinate 'x' of vertex 0 is too large: 1e+60");
  CHECK(refusal(overwrite(file.size() - 4, ScalarType::uint32, 4)) ==
        "input: byte " + std::to_string(file.size() - 14) +
            ": vertex index 4 of face 1 is out of range: the file has 4 vertices, counted from 0");
  CHECK(refusal(overwrite(file.size() - 13, ScalarType::uint8, 255)) ==
        "input: byte " + std::to_string(file.size() - 14) +
            ": the file ends within row 2 of 2 of element 'face'");
}

TEST_CASE("ply: names that are not printable are escaped in errors") {
  CHECK(refusal("ply\nformat ascii 1.0\nelement a 1\nproperty float \x10\nend_header\nx y\n") ==
        "input:6: property '\\x10' is not a number: 'x'");
  CHECK(refusal("ply\nformat ascii 1.0\nelement a 1\nproperty list char int \x10\nend_header\n-1\n") ==
        "input:6: -1 is no length for list '\\x10'");
}

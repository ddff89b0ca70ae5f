// Writing a mesh and reading it again gives the same bits, in every format that can hold them.
#include <rapidcheck.h>

#include <random>

#include "mesh_testing.hpp"
#include "snip/mesh_file/formats.hpp"

using mesh_testing::parsed;
using snip::Mesh;
using snip::MeshFormat;
using snip::Triangle;

namespace {

bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (Eigen::Index i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

bool same_bits(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  return std::ranges::equal(a, b, [](const auto& p, const auto& q) { return same_bits(p, q); });
}

// Doubles over the whole range of exponents that readers accept, denormals included.
double random_coordinate(std::mt19937_64& random) {
  while (true) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value) && std::abs(value) < 1e50) return value;
  }
}

// Random points and triangles that name all of them, in a random order.
Mesh random_mesh(std::uint64_t seed, std::size_t triangle_count) {
  std::mt19937_64 random(seed);
  Mesh mesh;
  for (std::size_t i = 0; i < triangle_count + 2; ++i)
    mesh.positions.emplace_back(random_coordinate(random), random_coordinate(random),
                                random_coordinate(random));
  for (std::uint32_t t = 0; t < triangle_count; ++t) mesh.triangles.push_back({t, t + 1, t + 2});
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

void add_attributes(Mesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < 7; ++i) {
    mesh.uvs.emplace_back(random_coordinate(random), random_coordinate(random));
    mesh.normals.emplace_back(random_coordinate(random), random_coordinate(random),
                              random_coordinate(random));
  }
  const auto index = [&random] { return static_cast<std::uint32_t>(random() % 7); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool bare = random() % 4 == 0;
    mesh.uv_triangles.push_back(bare ? Triangle{snip::no_index, snip::no_index, snip::no_index}
                                     : Triangle{index(), index(), index()});
    mesh.normal_triangles.push_back({index(), index(), index()});
  }
}

std::string obj_text(const Mesh& mesh) {
  std::string text;
  snip::write_obj(mesh, {}, text);
  return text;
}

}  // namespace

TEST_CASE("round trip: obj keeps points, triangles, UV and normals to the bit") {
  CHECK(rc::check([](std::uint64_t seed) {
    Mesh mesh = random_mesh(seed, 1 + seed % 20);
    add_attributes(mesh, seed);
    const Mesh again = parsed(obj_text(mesh), MeshFormat::obj);
    RC_ASSERT(same_bits(again.positions, mesh.positions));
    RC_ASSERT(again.triangles == mesh.triangles);
    RC_ASSERT(again.uvs == mesh.uvs);
    RC_ASSERT(same_bits(again.normals, mesh.normals));
    RC_ASSERT(again.normal_triangles == mesh.normal_triangles);
    // UV that no corner has are none at all.
    const bool has_uv =
        std::ranges::any_of(mesh.uv_triangles, [](const Triangle& t) { return t[0] != snip::no_index; });
    RC_ASSERT(again.uv_triangles == (has_uv ? mesh.uv_triangles : std::vector<Triangle>{}));
    RC_ASSERT(obj_text(again) == obj_text(mesh));
  }));
}

TEST_CASE("round trip: ply keeps points, triangles and attributes of vertices to the bit") {
  CHECK(rc::check([](std::uint64_t seed) {
    Mesh mesh = random_mesh(seed, 1 + seed % 20);
    std::mt19937_64 random(seed);
    mesh.colours.types = {snip::ScalarType::uint8, snip::ScalarType::float64, snip::ScalarType::uint16};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.normals.push_back(mesh.positions[v].reverse());
      mesh.uvs.emplace_back(random_coordinate(random), random_coordinate(random));
      mesh.colours.values.push_back({static_cast<double>(random() % 256), random_coordinate(random),
                                     static_cast<double>(random() % 65536), 0});
    }
    mesh.normal_triangles = mesh.uv_triangles = mesh.triangles;
    std::string bytes;
    snip::write_ply(mesh, bytes);
    const Mesh again = parsed(bytes, MeshFormat::ply);
    RC_ASSERT(same_bits(again.positions, mesh.positions));
    RC_ASSERT(again.triangles == mesh.triangles);
    RC_ASSERT(again.uvs == mesh.uvs);
    RC_ASSERT(again.uv_triangles == mesh.triangles);
    RC_ASSERT(same_bits(again.normals, mesh.normals));
    RC_ASSERT(again.colours.types == mesh.colours.types);
    RC_ASSERT(again.colours.values == mesh.colours.values);
  }));
}

TEST_CASE("round trip: ply keeps UV of corners") {
  CHECK(rc::check([](std::uint64_t seed) {
    Mesh mesh = random_mesh(seed, 2 + seed % 20);
    add_attributes(mesh, seed);
    mesh.uv_triangles[0] = {0, 1, 2};
    mesh.uv_triangles[1] = {snip::no_index, snip::no_index, snip::no_index};
    std::string bytes;
    snip::write_ply(mesh, bytes);
    const Mesh again = parsed(bytes, MeshFormat::ply);
    REQUIRE(again.uv_triangles.size() == mesh.uv_triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t want = mesh.uv_triangles[t][k];
        const std::uint32_t have = again.uv_triangles[t][k];
        RC_ASSERT((want == snip::no_index) == (have == snip::no_index));
        if (want != snip::no_index) RC_ASSERT(again.uvs[have] == mesh.uvs[want]);
      }
  }));
}

TEST_CASE("round trip: off and stl keep points and triangles to the bit") {
  CHECK(rc::check([](std::uint64_t seed) {
    const Mesh mesh = random_mesh(seed, 1 + seed % 20);
    std::string text;
    snip::write_off(mesh, text);
    const Mesh off = parsed(text, MeshFormat::off);
    RC_ASSERT(same_bits(off.positions, mesh.positions));
    RC_ASSERT(off.triangles == mesh.triangles);

    text.clear();
    snip::write_stl(mesh, {}, text);
    const Mesh stl = parsed(text, MeshFormat::stl);
    RC_ASSERT(stl.triangles.size() == mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        RC_ASSERT(same_bits(stl.positions[stl.triangles[t][k]], mesh.positions[mesh.triangles[t][k]]));
  }));
}

TEST_CASE("round trip: pieces become groups of an obj and solids of an stl") {
  const Mesh mesh = random_mesh(1, 3);
  const std::vector<std::size_t> piece_begin = {0, 2};
  std::string obj;
  snip::write_obj(mesh, piece_begin, obj);
  CHECK(obj.find("g piece_0\nf ") != std::string::npos);
  CHECK(obj.find("g piece_1\nf ") > obj.find("g piece_0\nf "));
  CHECK(obj.find("g piece_2") == std::string::npos);
  std::string stl;
  snip::write_stl(mesh, piece_begin, stl);
  CHECK(stl.starts_with("solid piece_0\nfacet"));
  CHECK(stl.find("endsolid piece_0\nsolid piece_1\nfacet") != std::string::npos);
  CHECK(stl.ends_with("endsolid piece_1\n"));
}

TEST_CASE("round trip: numbers have 17 significant digits and a point, whatever the locale") {
  Mesh mesh;
  mesh.positions = {{0.1, 1.0 / 3, 1e22}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  CHECK(obj_text(mesh).starts_with("v 0.10000000000000001 0.33333333333333331 1e+22\n"));
}

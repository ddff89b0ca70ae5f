// Connected pieces of a triangle list, and cleaning.
#include "snip/pieces.hpp"

#include <rapidcheck.h>

#include <cmath>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>
#include <scenes/random.hpp>
#include <scenes/surfaces.hpp>
#include <set>
#include <tuple>

#include "cut/cutter.hpp"
#include "cut/pieces.hpp"
#include "mesh_testing.hpp"
#include "snip/clean.hpp"
#include "snip/rendered_mesh.hpp"

using snip::Mesh;
using snip::Triangle;

namespace {

// An n by m grid of unit squares, two triangles each; `wrap_x`, `wrap_y` glue opposite sides, `twist` turns
// the seam over.
Mesh grid(std::uint32_t n, std::uint32_t m, bool wrap_x = false, bool wrap_y = false, bool twist = false) {
  Mesh mesh;
  const std::uint32_t columns = wrap_x ? n : n + 1;
  const std::uint32_t rows = wrap_y ? m : m + 1;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) mesh.positions.emplace_back(x, y, 0);
  const auto at = [&](std::uint32_t x, std::uint32_t y) {
    if (wrap_x && x == n) {
      x = 0;
      if (twist) y = m - y;
    }
    if (wrap_y && y == m) y = 0;
    return y * columns + x;
  };
  for (std::uint32_t y = 0; y < m; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  mesh.polygon_count = mesh.triangles.size();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.polygon_of_triangle.push_back(t);
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.polygon_of_triangle.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
}

snip::Piece only_piece(const Mesh& mesh) {
  const snip::Pieces pieces = snip::find_pieces(mesh.positions, mesh.triangles);
  REQUIRE(pieces.pieces.size() == 1);
  CHECK(pieces.pieces[0].triangles == mesh.triangles.size());
  return pieces.pieces[0];
}

void drop_square(Mesh& mesh, std::uint32_t n, std::uint32_t x, std::uint32_t y) {
  const auto first = mesh.triangles.begin() + 2 * (y * n + x);
  mesh.triangles.erase(first, first + 2);
}

}  // namespace

TEST_CASE("pieces: the topology of plain surfaces") {
  CHECK(only_piece(grid(3, 4)).boundary_loops == 1);
  CHECK(only_piece(grid(3, 4)).euler_characteristic == 1);
  CHECK(only_piece(grid(3, 4)).area == 12);
  CHECK(only_piece(grid(5, 2, true)).boundary_loops == 2);
  CHECK(only_piece(grid(5, 2, true)).euler_characteristic == 0);
  CHECK(only_piece(grid(5, 4, true, true)).boundary_loops == 0);
  CHECK(only_piece(grid(5, 4, true, true)).euler_characteristic == 0);
  CHECK(only_piece(grid(5, 2, true, false, true)).boundary_loops == 1);
  CHECK(only_piece(grid(5, 2, true, false, true)).euler_characteristic == 0);
  Mesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  CHECK(only_piece(tetrahedron).boundary_loops == 0);
  CHECK(only_piece(tetrahedron).euler_characteristic == 2);
}

TEST_CASE("pieces: holes; where two meet in a vertex, the walk passes from one into the other") {
  Mesh mesh = grid(5, 5);
  drop_square(mesh, 5, 1, 1);
  CHECK(only_piece(mesh).boundary_loops == 2);
  CHECK(only_piece(mesh).euler_characteristic == 0);
  mesh = grid(5, 5);
  drop_square(mesh, 5, 2, 2);
  drop_square(mesh, 5, 1, 1);
  CHECK(only_piece(mesh).boundary_loops == 2);
  CHECK(only_piece(mesh).euler_characteristic == -1);
}

TEST_CASE("pieces: two triangles that share a vertex only are one piece with two loops") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  CHECK(only_piece(mesh).boundary_loops == 2);
  CHECK(only_piece(mesh).euler_characteristic == 1);
}

TEST_CASE("pieces: areas of very small and very large triangles are exact to rounding") {
  for (const double side : {1e-100, 1e-80, 1e40}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}};
    mesh.triangles = {{0, 1, 2}};
    CHECK(only_piece(mesh).area / (side * side / 2) == doctest::Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("pieces: three triangles at one edge, whatever their winding") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  CHECK(only_piece(mesh).boundary_loops == 1);
  CHECK(only_piece(mesh).euler_characteristic == 1);
}

TEST_CASE("pieces: largest first, equal ones by their first triangle; triangles sorted by piece") {
  Mesh mesh = grid(1, 1);
  append(mesh, grid(3, 3));
  append(mesh, grid(1, 1));
  append(mesh, grid(2, 1));
  // The last triangle goes first, so that pieces are not in one block each.
  std::rotate(mesh.triangles.begin(), mesh.triangles.end() - 1, mesh.triangles.end());
  mesh.uv_triangles = mesh.triangles;
  const snip::Pieces pieces = snip::find_pieces(mesh.positions, mesh.triangles);
  std::vector<double> areas;
  for (const snip::Piece& piece : pieces.pieces) areas.push_back(piece.area);
  CHECK(areas == std::vector<double>{9, 2, 1, 1});
  CHECK(pieces.piece_of_triangle.front() == 1);
  CHECK(pieces.piece_of_triangle[1] == 2);
  CHECK(pieces.piece_of_triangle.back() == 1);
  const std::vector<std::size_t> begin = snip::sort_by_piece(mesh, pieces);
  CHECK(begin == std::vector<std::size_t>{0, 18, 22, 24});
  CHECK(mesh.uv_triangles == mesh.triangles);
  for (std::size_t t = 0; t < 18; ++t) CHECK(mesh.triangles[t][0] >= 4);
}

TEST_CASE("pieces: the render mesh has the pieces that libcut counts, loop by loop") {
  CHECK(rc::check([](std::uint64_t seed) {
    scenes::Random random(seed);
    std::vector<cut::TriangleMesh> cloths{scenes::grid(4, 4), scenes::random_sheet(4, 4, 1, seed),
                                          scenes::moebius_strip(8, 2), scenes::torus(6, 5),
                                          scenes::fan(7, 2)};
    cloths.push_back(scenes::joined({cloths[0], scenes::moved(cloths[4], {9, 9, 0})}));
    Mesh input;
    const cut::TriangleMesh& cloth = cloths[random.below(cloths.size())];
    input.positions = cloth.positions;
    input.triangles = cloth.triangles;
    input.polygon_of_triangle.resize(input.triangles.size());
    auto hybrid = cut::HybridMesh::build(cloth);
    RC_ASSERT(hybrid.has_value());
    cut::Cutter cutter(cut::default_merge_distances(*hybrid));
    const auto point = [&] { return Eigen::Vector3d(random.between(-2, 5), random.between(-2, 5), 0); };
    for (std::uint64_t cuts = random.below(8); cuts > 0; --cuts) {
      // Walls between any points, through nodes of the grid, and rings.
      const auto a = point(), b = point();
      const Eigen::Vector3d high(0, 0, 8);
      const std::uint64_t kind = random.below(3);
      const auto wall = kind == 0 ? scenes::ribbon({a, b}, high)
                        : kind == 1
                            ? scenes::ribbon({a.array().round().matrix(), b.array().round().matrix()}, high)
                            : scenes::tube({a, b, point()}, high);
      RC_ASSERT(cutter.cut(*hybrid, wall).has_value());
    }
    const Mesh output = snip::rendered_mesh(input, *hybrid);
    const auto ours = snip::find_pieces(output.positions, output.triangles).pieces;
    const auto theirs = cut::pieces(*hybrid).list;
    RC_ASSERT(ours.size() == theirs.size());
    // Sorted by areas that are added up in another way: equal ones may be in another order.
    using Key = std::tuple<std::size_t, std::size_t, std::int64_t>;
    std::multiset<Key> our_keys, their_keys;
    for (std::size_t p = 0; p < ours.size(); ++p) {
      our_keys.emplace(ours[p].triangles, ours[p].boundary_loops, ours[p].euler_characteristic);
      their_keys.emplace(theirs[p].triangles, theirs[p].boundary_loops, theirs[p].euler_characteristic);
      RC_ASSERT(std::abs(ours[p].area - theirs[p].area) < 1e-9);
    }
    RC_ASSERT(our_keys == their_keys);
  }));
}

TEST_CASE("clean: degenerate and repeated triangles go, with their attributes") {
  Mesh mesh = grid(1, 1);
  const Mesh good = mesh;
  mesh.positions.emplace_back(2, 2, 0);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.triangles.push_back({0, 3, 4});  // collinear
  mesh.triangles.push_back(
      {good.triangles[0][1], good.triangles[0][0], good.triangles[0][2]});  // turned over
  mesh.polygon_of_triangle = {0, 1, 2, 3, 4};
  mesh.polygon_count = 6;  // one polygon had too few corners for a triangle
  mesh.uv_triangles = mesh.normal_triangles = mesh.triangles;
  const auto report = snip::clean(mesh, "name");
  REQUIRE(report);
  CHECK(report->degenerate == 3);
  CHECK(report->duplicates == 1);
  CHECK(mesh.triangles == good.triangles);
  CHECK(mesh.uv_triangles == good.triangles);
  CHECK(mesh.normal_triangles == good.triangles);
  CHECK(mesh.polygon_of_triangle == std::vector<std::uint32_t>{1, 2});
  CHECK(snip::describe(*report, "name") == "name: dropped triangles: 3 without area, 1 repeated");
  CHECK(snip::describe({}, "name").empty());
}

TEST_CASE("clean: collinear to rounding is degenerate, a needle is not") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0.1, 0.1, 0.3}, {0.3, 0.3, 0.9}, {1, 0, 0}, {1, 1e-12, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  mesh.polygon_of_triangle = {0, 1};
  mesh.polygon_count = 2;
  REQUIRE(snip::clean(mesh, "name"));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 3, 4}});
}

TEST_CASE("clean: what is kept has area for libcut too, what is dropped has none") {
  // A needle beside a good triangle, from none to wide enough, near the limit in small steps.
  for (double height = 1e-17; height < 1e-12; height *= 1.1) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, -height, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    mesh.polygon_of_triangle = {0, 1};
    mesh.polygon_count = 2;
    const auto report = snip::clean(mesh, "name");
    REQUIRE(report);
    const bool wide = cut::has_area({0, 0, 0}, {0.3, -height, 0}, {1, 0, 0});
    CHECK(report->degenerate == (wide ? 0 : 1));
    CHECK(cut::HybridMesh::build(snip::to_triangle_mesh(mesh)).has_value());
  }
}

TEST_CASE("clean: an error when nothing is left") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 0}};
  mesh.polygon_of_triangle = {0};
  mesh.polygon_count = 1;
  const auto report = snip::clean(mesh, "name");
  REQUIRE_FALSE(report);
  CHECK(report.error().message == "name: no triangle is left: 1 without area");
}

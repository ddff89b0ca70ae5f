// Connected pieces of a triangle list, and cleaning.
#include "snip/pieces.hpp"

#include "mesh_testing.hpp"
#include "snip/clean.hpp"

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

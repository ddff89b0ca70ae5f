/// @file
/// Flat cloths in the plane z = 0, wound counterclockwise seen from +z. Used by the app, tests and
/// benchmarks. Every function gives the same bits on every compiler and machine.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cut/triangle_mesh.hpp>

namespace scenes {

/// The paper's test patch (§6): 12 equilateral triangles. Three rows of four nodes, the middle row shifted by
/// half a side, so that the patch is three and a half sides wide and √3 sides high. Nodes 0 4 8 are the left
/// of the two short sides, nodes 3 7 11 the right one; (0, 0, 0) is node 0.
cut::TriangleMesh twelve_triangles(double side = 1);

/// How the cells of a grid are split into two triangles.
enum class Diagonals {
  uniform,     ///< all from lower left to upper right
  alternating  ///< as on a chequered board, so that no direction is preferred
};

/// columns × rows square cells with a corner at (0, 0, 0): 2 · columns · rows triangles. Node
/// `row * (columns + 1) + column` lies at (column, row) · spacing.
cut::TriangleMesh grid(std::size_t columns, std::size_t rows, double spacing = 1,
                       Diagonals diagonals = Diagonals::uniform);

/// A regular hexagon round (0, 0, 0) with 6 · rings² equilateral triangles. @pre rings > 0
cut::TriangleMesh hexagon(std::size_t rings, double side = 1);

/// `count` triangles round node 0 at (0, 0, 0); the others lie on a circle. @pre count > 2
cut::TriangleMesh fan(std::size_t count, double radius = 1);

/// A rectangle of columns × rows cells with inner nodes moved at random and edges flipped at random: node
/// degrees from 3 upwards, triangles of very different shape, all wound counterclockwise with at least 2 % of
/// the area of half a cell. The border keeps its place, so the area is that of the grid.
cut::TriangleMesh random_sheet(std::size_t columns, std::size_t rows, double spacing, std::uint64_t seed);

}  // namespace scenes

/// @file
/// The connected pieces of a triangle list, with their areas and their topology. In: points and triangles as
/// files have them. Out: pieces.
///
/// `cut::pieces` wants a hybrid mesh. That is not to be had here: `weld` works on meshes that cannot be cut
/// (three triangles at an edge), `validate` and the statistics speak of the mesh as it is in the file, where
/// triangles that share a vertex only are one piece, and the writers sort the triangles of a file by piece.
/// Of the render mesh both say the same; a test compares them.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "snip/mesh_file/mesh.hpp"

namespace snip {

/// Triangles that hang together by shared vertices.
struct Piece {
  double area = 0;
  std::size_t triangles = 0;
  /// Closed walks along edges that have one triangle only. At a vertex the walk goes on around the fan of
  /// triangles that it came along: where two fans meet in a vertex only, walks do not cross over.
  std::size_t boundary_loops = 0;
  /// Vertices - edges + triangles: 1 for a disc, 0 for an annulus or a torus, 2 for a sphere.
  std::int64_t euler_characteristic = 0;
};

struct Pieces {
  std::vector<Piece> pieces;  ///< largest area first; equal ones by their first triangle
  std::vector<std::uint32_t> piece_of_triangle;
};

/// Finds the pieces. Complexity: O(n log n).
/// @pre the triangles name existing positions and have three different corners
Pieces find_pieces(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles);

/// Sorts the triangles of the mesh by piece, keeping their order within each.
/// @return where each piece begins, as the writers take it
std::vector<std::size_t> sort_by_piece(Mesh& mesh, const Pieces& pieces);

}  // namespace snip

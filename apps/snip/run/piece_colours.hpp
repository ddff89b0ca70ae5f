/// @file
/// A colour for each piece that stays the same while pieces come apart: the largest of the pieces that
/// something falls into keeps its colour.
#pragma once
#include <cstddef>
#include <cut/changes.hpp>
#include <cut/hybrid_mesh.hpp>
#include <cut/pieces.hpp>
#include <vector>

namespace snip {

class PieceColours {
 public:
  /// @param pieces those of `mesh`
  PieceColours(const cut::HybridMesh& mesh, const cut::Pieces& pieces);
  /// Tells about a cut: copies of physics triangles begin with the colour of their source.
  void add_copies(const cut::Changes& changes);
  /// Tells what pieces there are after one cut or several. O(mesh).
  void update(const cut::HybridMesh& mesh, const cut::Pieces& pieces);
  /// The number of a colour, per physics triangle, as piece_colour takes it.
  [[nodiscard]] std::size_t of(cut::TriangleId triangle) const { return of_triangle_[triangle.index()]; }

 private:
  std::vector<std::size_t> of_triangle_;
  std::size_t count_ = 0;  // colours given out so far
};

}  // namespace snip

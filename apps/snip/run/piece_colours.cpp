// Colours of pieces, see piece_colours.hpp.
#include "snip/run/piece_colours.hpp"

#include <map>
#include <set>

namespace snip {

PieceColours::PieceColours(const cut::HybridMesh& mesh, const cut::Pieces& pieces)
    : of_triangle_(mesh.buffers.triangles.size()), count_(pieces.list.size()) {
  for (std::size_t t = 0; t < mesh.buffers.render_triangles.size(); ++t)
    if (const auto& triangle = mesh.buffers.render_triangles[t]; triangle.triangle.valid())
      of_triangle_[triangle.triangle.index()] = pieces.of_triangle[t];
}

void PieceColours::add_copies(const cut::Changes& changes) {
  of_triangle_.resize(changes.triangles.size_after);
  for (const cut::TriangleCopy& copy : changes.triangle_copies)
    of_triangle_[copy.triangle.index()] = of_triangle_[copy.source.index()];
}

void PieceColours::update(const cut::HybridMesh& mesh, const cut::Pieces& pieces) {
  // How many render triangles of each piece have which colour so far.
  std::vector<std::map<std::size_t, std::size_t>> votes(pieces.list.size());
  for (std::size_t t = 0; t < mesh.buffers.render_triangles.size(); ++t)
    if (const auto& triangle = mesh.buffers.render_triangles[t]; triangle.triangle.valid())
      ++votes[pieces.of_triangle[t]][of_triangle_[triangle.triangle.index()]];
  std::set<std::size_t> taken;
  std::vector<std::size_t> colour_of_piece;
  for (const auto& votes_of_piece : votes) {
    std::size_t colour = 0, most = 0;
    for (const auto& [candidate, count] : votes_of_piece)
      if (count > most) colour = candidate, most = count;
    if (!taken.insert(colour).second) colour = *taken.insert(count_++).first;
    colour_of_piece.push_back(colour);
  }
  for (std::size_t t = 0; t < mesh.buffers.render_triangles.size(); ++t)
    if (const auto& triangle = mesh.buffers.render_triangles[t]; triangle.triangle.valid())
      of_triangle_[triangle.triangle.index()] = colour_of_piece[pieces.of_triangle[t]];
}

}  // namespace snip

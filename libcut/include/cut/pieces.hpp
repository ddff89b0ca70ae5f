/// @file
/// The pieces that cuts left: connected components of the render mesh, with what tells them apart.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cut/hybrid_mesh.hpp"

namespace cut {

/// One connected component of the render mesh.
struct Piece {
  double rest_area = 0;                   ///< tension-free, in squared units of the rest positions
  double area = 0;                        ///< in space, as things are now
  std::size_t triangles = 0;              ///< render triangles
  std::size_t boundary_loops = 0;         ///< closed curves of sides that have one render triangle
  std::int64_t euler_characteristic = 0;  ///< vertices - sides + triangles: 1 for a disc, 0 for a ring
};

struct Pieces {
  std::vector<Piece> list;  ///< by rest area, largest first; equal ones by their first triangle
  std::vector<std::uint32_t> of_triangle;  ///< per render triangle: index into `list`; free entries: `none`
  std::vector<std::uint32_t> of_vertex;    ///< per render vertex

  static constexpr std::uint32_t none = 0xffffffffu;
};

/// Triangles belong to one piece when a chain of common render vertices joins them. A cut that opens nothing
/// yet (it ends inside of a physics triangle, or it runs along one physics edge whose ends still hold) does
/// not show in the render mesh and so not here. O(n log n) for n render triangles.
/// @pre `validate` finds nothing
[[nodiscard]] Pieces pieces(const HybridMesh& mesh);

}  // namespace cut

/// @file
/// The faces of a planar graph inside a triangle (§4.9): half-edge walks with exact angular order, and the
/// nearest-edge rule that tells in which face a loose component lies.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cut/lattice_point.hpp"

namespace cut::lattice {

/// An edge of the graph. Half-edge 2i runs from → to, half-edge 2i + 1 runs back.
struct FaceEdge {
  std::uint32_t from;
  std::uint32_t to;
};

/// A face: its hull counterclockwise, its holes clockwise. A face may touch itself in a node, which then
/// occurs once for each angle that the face has there. Edges with the face on both sides (§3.2: internal
/// edges) are left out.
struct Face {
  std::vector<std::uint32_t> corners;    ///< nodes of all loops, hull first
  std::vector<std::uint32_t> loop_ends;  ///< end of each loop in `corners`
};

struct Faces {
  std::vector<Face> faces;  ///< by the smallest half-edge of their hulls' walks
  std::vector<std::uint32_t>
      face_of_half_edge;  ///< of the face on its left; for 2i + 1 of a border edge: no_face
  static constexpr std::uint32_t no_face = 0xffffffffu;
};

/// @param points positions of the nodes
/// @param border the sides of the triangle, counterclockwise, split at their nodes; half-edge 2i of border
/// edge i has
///        the triangle on its left
/// @param inner the other edges; they follow the border's in the numbering of half-edges
/// @pre planar, no edge twice. O(n log n) for n edges, and O(n) more for each loose component.
Faces find_faces(std::span<const LatticePoint> points, std::span<const FaceEdge> border,
                 std::span<const FaceEdge> inner);

}  // namespace cut::lattice

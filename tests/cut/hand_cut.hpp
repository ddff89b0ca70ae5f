/// @file
/// Cut meshes put together by hand, so that `validate` can be tested without the code that cuts: the test
/// says which polygons a triangle has, and the rest follows by the slowest method there is.
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cut/hybrid_mesh.hpp"

namespace hand {

/// Boundary nodes of the edge between two input nodes, and whether each section is cut.
struct Edge {
  std::array<std::uint32_t, 2> ends;  ///< in the direction of the ancestor edge
  std::vector<std::int32_t> nodes;
  std::vector<std::uint8_t> cut;
};

struct Polygon {
  std::vector<std::vector<std::uint32_t>> loops;        ///< of nodes: the hull first
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of positions in all loops, one after the other
};

/// An arrangement. Its boundary nodes come from the edges.
struct Triangle {
  std::uint32_t ancestor;
  std::vector<cut::LatticePoint> inner;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts;  ///< from < to, sorted
  std::vector<Polygon> polygons;
  std::uint32_t slits_in = 0;  ///< the polygon that cuts run in which are no side of any
};

/// The mesh after these cuts. It has one free entry in each of the render arrays.
cut::HybridMesh cut_by_hand(const cut::TriangleMesh& cloth, const std::vector<Edge>& edges,
                            const std::vector<Triangle>& triangles);

/// A square of two triangles cut in two from its lower to its upper side.
cut::HybridMesh square_cut_in_two();

/// A hexagon of six triangles: one has a triangular island cut out and a slit that touches nothing; another a
/// drop that touches the centre; the edge between two more is cut up to its middle.
cut::HybridMesh hexagon_with_cuts();

/// A Möbius strip with a cut across one of its triangles.
cut::HybridMesh moebius_with_cut();

}  // namespace hand

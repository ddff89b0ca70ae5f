/// @file
/// Triangles of one render polygon of a cut physics triangle (§4.10).
///
/// In: the corners of a polygon with holes, as lattice points. Out: triples of corner indices. Decisions are
/// exact; the tension-free metric only chooses between triangulations that are all valid.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cut/lattice_point.hpp"
#include "lattice/metric.hpp"

namespace cut::lattice {

/// Working memory of `triangulate`. Reusing one for many polygons saves the allocations; it carries no state
/// from one call to the next.
struct TriangulationScratch {
  /// A corner of a ring that has still to be cut into triangles. Joining a hole to its hull doubles the two
  /// corners at the joint, so a corner of the polygon can have several.
  struct Node {
    LatticePoint at;
    std::uint32_t corner;
    std::uint32_t previous;
    std::uint32_t next;
    std::uint32_t ticket;     // the one entry of `queue` that counts for this node
    std::uint32_t reflex_at;  // where `reflex` lists this node
    std::uint32_t beyond;     // half-edge on the other side of the edge to `next`
    std::uint32_t joint;      // node whose edge is the other side of the edge to `next`
  };
  /// An edge seen from one of its ends.
  struct Spoke {
    Vector direction;
    bool incoming;
    std::uint32_t node;
  };
  std::vector<Node> nodes;
  std::vector<std::uint32_t> order, queue, reflex, hulls, holes, twins;
  std::vector<Spoke> spokes;
};

/// Triangulates one polygon and replaces the content of `triangles` by the result.
///
/// @param points     the corners of all loops, one loop after another.
/// @param loop_ends  for each loop, the index behind its last corner.
/// @pre One loop is the hull (counterclockwise), the others are holes (clockwise). Loops do not cross; they
///      may touch themselves and each other where both have a corner. Corners may be straight. No edge has
///      length zero, none occurs twice, except once in each direction (a slit). Coordinates are in [0, N].
/// @return true when the polygon is covered. The triangles then have positive area and disjoint interiors,
///      each edge of the polygon belongs to one triangle, and there are n + 2h - 2 of them for n corners and
///      h holes (holes count once if they touch each other, and not at all if they touch the hull). When a
///      precondition is broken the answer may be false and the triangles may cover a part only; it never
///      crashes or hangs.
///
/// Where several corners share a position, a triangle refers to the one whose wedge it lies in. Where loops
/// given as separate touch, the wedge of a corner is the one that begins at the edge leaving that corner.
/// Every edge that is not on the polygon is then flipped while that enlarges the smaller of the smallest
/// angles of its two triangles, measured with `metric`. The result is the same to the bit on every machine.
///
/// O(n (r + h)) for n corners, r of them not strictly convex, and h holes.
bool triangulate(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop_ends,
                 const Metric& metric, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 TriangulationScratch& scratch);

/// The same without reuse of working memory.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const LatticePoint> points,
                                                      std::span<const std::uint32_t> loop_ends,
                                                      const Metric& metric);

}  // namespace cut::lattice

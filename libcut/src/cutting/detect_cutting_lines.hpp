/// @file
/// Step 1, Detect Cutting Lines (§4.1). In: the mesh where it is now, the cutter, pairs of triangles whose
/// boxes meet. Out: one TriangleWork for each ancestor that is cut, with its cutting lines; and these lines
/// as they were before they were clipped, by which a cut that is made again is known.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/triangle_mesh.hpp"
#include "cutting/intersect_triangles.hpp"
#include "cutting/state.hpp"

namespace cut {

/// A physics triangle and a cutter triangle that may intersect.
struct CandidatePair {
  AncestorId ancestor;  ///< of the physics triangle
  TriangleId triangle;
  std::uint32_t cutter_triangle;
  auto operator<=>(const CandidatePair&) const = default;
};

/// A physics triangle where it is now.
PhysicsFace physics_face(const HybridMesh& mesh, const PhysicsTriangle& triangle);

/// How far features of cloth and cutter may miss each other in space and still count as touching. Everything
/// that lies within it is far inside the merge distances, so it decides nothing but that no contact is lost
/// to rounding.
double contact_slack(const MergeDistances& distances, const TriangleMesh& cutter);

/// The largest coordinate that a corner of the cutter may have: beyond it the slack that its rounding needs
/// comes near δe.
double farthest_corner(const MergeDistances& distances);

/// Where the cutter meets an ancestor's plane, whatever cuts there are in it.
struct DetectedLine {
  AncestorId ancestor;
  LatticePoint a;
  LatticePoint b;
  auto operator<=>(const DetectedLine&) const = default;
};

struct Detection {
  std::vector<TriangleWork> works;  ///< sorted by ancestor, lines within a work as well
  std::vector<DetectedLine> lines;  ///< sorted, each once
};

/// The result does not depend on the order of `candidates`. O(candidates · log).
Detection detect_cutting_lines(const HybridMesh& mesh, const TriangleMesh& cutter,
                               std::span<const CandidatePair> candidates, double slack,
                               const MergeDistances& distances, const Executor& executor);

}  // namespace cut

/// @file
/// Which physics triangles a cutter may meet: the boxes of all physics triangles in a BBTT (§5.1), kept
/// between cuts.
#pragma once
#include <cstdint>
#include <vector>

#include "cut/changes.hpp"
#include "cut/error.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "spatial/bounding_box_ternary_tree.hpp"

namespace cut {

class BroadPhase {
 public:
  /// Brings the boxes to where the mesh is now. O(1) when nothing has moved since the last call, else
  /// O(triangles).
  /// @return false, and `error`, when a position is not finite
  bool update(const HybridMesh& mesh, Error& error);

  /// Adds the physics triangles that a cut has made. Those that it changed lie where they were.
  void add(const HybridMesh& mesh, const std::vector<TriangleCopy>& copies);

  /// All pairs whose boxes are within `slack` of each other.
  [[nodiscard]] std::vector<CandidatePair> candidates(const TriangleMesh& cutter, double slack) const;

 private:
  using Tree = spatial::BoundingBoxTernaryTree<TriangleId, double, 3>;
  Tree tree_;
  std::vector<spatial::Handle> handles_;  ///< per physics triangle
  bool filled_ = false;
  std::uint64_t position_version_ = 0;
};

}  // namespace cut

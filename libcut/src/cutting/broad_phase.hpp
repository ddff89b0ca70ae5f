/// @file
/// Which physics triangles a cutter may meet, found with a BBTT (§5.1): that of the cloth's triangles, kept
/// between cuts, while the cloth stands still; that of the cutter's triangles when the cloth has moved, since
/// each of the cloth's boxes is then looked at only once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cut/changes.hpp"
#include "cut/error.hpp"
#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cutting/detect_cutting_lines.hpp"
#include "spatial/bounding_box_ternary_tree.hpp"

namespace cut {

class BroadPhase {
 public:
  /// Whether the mesh is as the last call left it. O(1).
  [[nodiscard]] bool knows(const HybridMesh& mesh) const { return state_ == mesh.state; }

  /// Finds out whether the mesh is as it was after the last call, this Cutter's own cuts left out. O(1) when
  /// it is, except O(triangles) for the first time, when the tree is built; else O(nodes).
  /// @return false, and `error`, when a position is not finite
  bool update(const HybridMesh& mesh, Error& error);

  /// Takes note of a cut: adds the physics triangles that it has made. Those that it changed lie where they
  /// were.
  void add(const HybridMesh& mesh, const std::vector<TriangleCopy>& copies);

  /// All pairs whose boxes are within `slack` of each other, in no particular order, but sorted where the
  /// mesh is uncut and moves. Also for a mesh that `update` has not seen yet. Complexity: by the size of the
  /// cutter and the result; O(triangles) in addition when there is no tree of the mesh as it is.
  [[nodiscard]] std::vector<CandidatePair> candidates(const HybridMesh& mesh, const TriangleMesh& cutter,
                                                      double slack, const Executor& executor = {}) const;

 private:
  spatial::BoundingBoxTernaryTree<TriangleId, double, 3> tree_;  ///< empty until the mesh stands still
  bool has_tree_ = false;
  std::uint64_t state_ = 0;  ///< of the mesh when last seen; 0: never
};

}  // namespace cut

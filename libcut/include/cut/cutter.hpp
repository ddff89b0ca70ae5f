/// @file
/// Cuts a hybrid mesh with a triangle mesh (§4). docs/cutting.md explains the steps.
#pragma once
#include <cstdint>
#include <memory>

#include "cut/changes.hpp"
#include "cut/error.hpp"
#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/merge_distances.hpp"
#include "cut/triangle_mesh.hpp"

namespace cut {

/// Milliseconds that the steps of the last cut took.
struct StepTimings {
  double broad_phase = 0;      ///< looking whether the mesh has moved; building the tree of the cloth's boxes
  double detect = 0;           ///< §4.1, the search for candidates in the broad phase's tree included
  double merge_endpoints = 0;  ///< §4.2, nodes on physics edges included
  double arrange = 0;          ///< §4.3 to §4.5, §4.7, §4.9: each triangle by itself
  double reconnect = 0;        ///< §4.6, §4.8, §4.10
  double publish = 0;          ///< render triangles and the change set
};

/// Cuts one hybrid mesh, again and again. Remembers between calls which nodes its last cut was part of (δc,
/// §4.2) and, while the mesh stands still, where the triangles are (a tree of their boxes). Use one Cutter
/// for each blade; for one that moves while the cloth does, a Blade (cut/blade.hpp).
class Cutter {
 public:
  /// Runs what triangles are cut by themselves. Results are the same to the bit whatever it does.
  Executor executor;

  /// @param distances as returned by `checked` or `default_merge_distances`
  explicit Cutter(const MergeDistances& distances);
  Cutter(Cutter&&) noexcept;
  Cutter& operator=(Cutter&&) noexcept;
  ~Cutter();

  /// Cuts `mesh`, where it is now, with all triangles of `cutter` at once. The order of the cutter's
  /// triangles does not matter; triangles without area cut nothing. The same cut made again by this Cutter,
  /// while nothing has moved, changes nothing. Returns what changed. Errors (the mesh is then as it was):
  /// index_out_of_range, not_finite, too_far (a corner beyond 2^40 δe) in `cutter`; not_finite positions of
  /// the cloth.
  /// @pre always called with the same mesh
  /// Complexity: by the number of triangles that the cutter meets. In addition O(triangles · log) when the
  /// mesh has moved or was cut by another Cutter, and in the next call after that, which builds the tree.
  Result<Changes> cut(HybridMesh& mesh, const TriangleMesh& cutter);

  [[nodiscard]] const MergeDistances& distances() const;
  [[nodiscard]] const StepTimings& timings() const;

 private:
  friend class Blade;
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace cut

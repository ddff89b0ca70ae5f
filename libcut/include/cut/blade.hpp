/// @file
/// A blade that is led through cloth while the cloth moves. Cloth moves between two calls, so the end of the
/// last cut is no longer where the blade's sweep begins (§6, "Discontinuous Cutting Lines"). A Blade
/// remembers in the material where it pierces the cloth, and its next cut starts there.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cut/changes.hpp"
#include "cut/cutter.hpp"
#include "cut/error.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/merge_distances.hpp"

namespace cut {

/// A polyline that cuts what it sweeps, relative to the moving cloth.
class Blade {
 public:
  /// @param distances as returned by `checked` or `default_merge_distances`
  explicit Blade(const MergeDistances& distances) : cutter_(distances) {}

  /// Leads the blade to `edge`, point by point, and cuts what it sweeps on the way. Where the blade pierced
  /// the cloth after the last call, the sweep begins at that point of the material, wherever it is now;
  /// between two such points, and beyond them, the old blade is carried along with them. The first call, and
  /// the first after `lift`, only puts the blade into its place. Returns what changed. Errors (nothing
  /// changes then): bad_parameter for fewer than two points or another number of points than before; those of
  /// `Cutter::cut`.
  /// @pre always called with the same mesh, which others may have cut and moved meanwhile
  /// Complexity: as `Cutter::cut`, and O(triangles) to find where the blade pierces cloth that has moved.
  Result<Changes> cut_to(HybridMesh& mesh, const std::vector<Eigen::Vector3d>& edge);

  /// Takes the blade out of the cloth: it does not cut on the way to its next place.
  void lift();

  /// Whether the blade has been put into a place, and not been lifted since.
  [[nodiscard]] bool placed() const { return !edge_.empty(); }
  [[nodiscard]] const Cutter& cutter() const { return cutter_; }
  [[nodiscard]] Cutter& cutter() { return cutter_; }

  /// A place where the blade pierces the cloth.
  struct Tip {
    std::uint32_t segment = 0;  ///< from point `segment` of the blade to the next
    double parameter = 0;       ///< where on this segment, 0 to 1
    TriangleId triangle;        ///< the physics triangle that renders the place
    LatticePoint point;         ///< where on this triangle
  };
  /// After the last call, along the blade.
  [[nodiscard]] const std::vector<Tip>& tips() const { return tips_; }

 private:
  Cutter cutter_;
  std::vector<Eigen::Vector3d> edge_;  ///< where the blade is; empty: lifted
  std::vector<Tip> tips_;
  std::vector<Eigen::Vector3d> positions_;  ///< of the cloth at the last call
};

}  // namespace cut

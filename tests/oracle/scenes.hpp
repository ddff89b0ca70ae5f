/// @file
/// Random scenes for the comparison with the oracles, and the pieces that the cutter under test makes of
/// them.
#pragma once
#include <scenes/cutters.hpp>
#include <scenes/random.hpp>
#include <vector>

#include "cut/hybrid_mesh.hpp"
#include "cut/merge_distances.hpp"
#include "cut/triangle_mesh.hpp"

namespace oracle {

/// A path to cut along; flat paths lie in z = 0.
struct Stroke {
  scenes::Path points;
  bool closed = false;
  std::size_t call = 0;  ///< strokes of one call cut at once
};

/// Cutters in calls: all cutters of one call cut at once.
using Calls = std::vector<std::vector<cut::TriangleMesh>>;

/// Areas of the pieces that `Cutter` makes, largest first. Fails the running test when `validate` finds
/// anything after any call. @param merge all three merge distances, as a fraction of the mean edge length
std::vector<double> cut_pieces(const cut::TriangleMesh& cloth, const Calls& calls, double merge);

/// The point moved by at most `distance` in each coordinate.
Eigen::Vector3d shaken(const Eigen::Vector3d& point, double distance, scenes::Random& random);

/// Same number of pieces, and areas that differ by at most `tolerance`.
bool same_pieces(const std::vector<double>& a, const std::vector<double>& b, double tolerance);

}  // namespace oracle

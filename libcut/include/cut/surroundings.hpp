/// @file
/// What acts on a simulated cloth as a whole, and how the simulation goes on in time: gravity, air, obstacles
/// and the integrator (§3.1; docs/simulation.md). Plain values, read by `Simulation::step`.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cut {

/// From velocities v and forces f to the next ones. All are of first order in the time step.
enum class Integrator : std::uint8_t {
  forward_euler,        ///< equations 5 and 6: positions move on with the old velocity
  semi_implicit_euler,  ///< positions move on with the new velocity: conserves energy far better
  /// Forces are those at the end of the step, linearised at its start: one linear system for each step.
  /// Stable for any time step, and damps what swings faster than the step can follow.
  implicit_euler
};

/// What no node goes into: {x : (x − point)·normal < 0}. It moves evenly.
struct HalfSpace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< out of the obstacle; any length but zero
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double friction = 0;  ///< Coulomb's coefficient, >= 0
};

/// A ball that no node goes into. It moves evenly and does not turn.
struct Sphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 1;  ///< > 0
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double friction = 0;  ///< Coulomb's coefficient, >= 0
};

/// May change between any two steps.
struct Surroundings {
  Integrator integrator = Integrator::semi_implicit_euler;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration [m/s²]
  /// Force per area and speed relative to the air [N·s/m³], >= 0, whichever way the cloth faces.
  double air_drag = 0;
  /// The same for motion across the cloth: per triangle, against the speed along its normal. >= 0.
  double normal_drag = 0;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  ///< velocity of the air [m/s]
  /// Obstacles. Steps move them on by their velocities.
  std::vector<HalfSpace> half_spaces;
  std::vector<Sphere> spheres;
  /// The longest way that a node may go in one step along x, y or z [m], >= 0, < 1e50; more is a blow-up. 0:
  /// the diagonal of the tension-free mesh's bounding box. Cloth that falls for long needs a longer one when
  /// steps are long.
  double longest_way = 0;
  /// An implicit step solves its system until the residual is this part of what it was, in at most so many
  /// iterations: hundreds for stiff cloth of a thousand nodes that obstacles hold, and twice as many for
  /// edges of half the length.
  double tolerance = 1e-6;
  std::size_t most_iterations = 10000;
};

}  // namespace cut

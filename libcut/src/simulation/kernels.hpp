/// @file
/// The three loops of one step of the simulation (§3.1), each in a portable version and in one for processors
/// with AVX2. Both give the same bits: every sum has one fixed order, (x + y) + z, and products are never
/// fused with sums.
#pragma once
#include <cstddef>
#include <limits>
#include <span>

#include "cut/simulation.hpp"

namespace cut {

/// What makes a new velocity of an old one and a force.
struct VelocityUpdate {
  double time_step;
  PaddedVector acceleration;  ///< of every free node: gravity and wind
  double drag;                ///< acceleration against the velocity, per speed [1/s]
  double speed_limit;         ///< for the amount of each component
};

/// Nodes closer than the root of this are at the same place: the direction of the spring is undefined, and no
/// force is taken. The smallest normal number, whose inverse is finite.
inline constexpr double smallest_squared_length = std::numeric_limits<double>::min();

struct Kernels {
  /// Equations 1 to 3: adds the forces of springs and dampers to `forces`. Springs in order of index; their
  /// number is a multiple of 4.
  void (*add_spring_forces)(const SpringArrays& springs, const PaddedVector* positions,
                            const PaddedVector* velocities, PaddedVector* forces);
  /// The same for the first node of each spring only.
  void (*add_forces_at_first_node)(const SpringArrays& springs, const PaddedVector* positions,
                                   const PaddedVector* velocities, PaddedVector* forces);
  /// Equations 4 and 5: replaces each force by the node's next velocity. Returns whether all of them are
  /// within the speed limit, which none that is NaN or infinite is.
  bool (*replace_by_velocities)(const VelocityUpdate& update, std::span<const double> inverse_mass,
                                const PaddedVector* velocities, PaddedVector* forces);
  /// Equation 6, with the old or the new velocities.
  void (*move)(double time_step, std::span<PaddedVector> positions, const PaddedVector* velocities);
};

/// Plain C++.
[[nodiscard]] const Kernels& portable_kernels();
/// The fastest that this processor has.
[[nodiscard]] const Kernels& best_kernels();

}  // namespace cut

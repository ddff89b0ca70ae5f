/// @file
/// The loops of one step of the simulation (§3.1), each in a portable version and in one for processors
/// with AVX2. Both give the same bits: every sum has one fixed order, (x + y) + z, and products are never
/// fused with sums.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "cut/simulation.hpp"

namespace cut {

/// What makes a new velocity of an old one and a force.
struct VelocityUpdate {
  double time_step;
  PaddedVector acceleration;  ///< of every free node: gravity and wind
  double drag;                ///< acceleration against the velocity, per speed [1/s]
  double speed_limit;         ///< for the amount of each component
  bool old_first = false;     ///< nodes move on with their old velocity

  [[nodiscard]] double next(double force, double inverse_mass, double velocity, double pull) const {
    const double a = force * inverse_mass + (pull - drag * velocity);
    return inverse_mass > 0 ? velocity + a * time_step : velocity;
  }
};

/// x, y and z of nodes in an array each.
using ColumnArrays = std::array<double*, 3>;

/// What a step goes through: columns of the first nodes, whose springs can stand in diagonals, and vectors by
/// slot of the others and of what lists name.
struct NodeArrays {
  std::size_t in_columns;
  ColumnArrays position_columns, velocity_columns, next_position_columns, next_velocity_columns;
  PaddedVector* positions;
  PaddedVector* velocities;
  PaddedVector* forces;  ///< become the next velocities
  PaddedVector* next_positions;
  const double* inverse_mass;     ///< of nodes in columns
  double* inverse_mass_at_slots;  ///< of the others
  bool moves;                     ///< whether next positions are wanted

  /// What is next becomes what is.
  void step_on() {
    std::swap(velocities, forces);
    std::swap(velocity_columns, next_velocity_columns);
    if (!moves) return;
    std::swap(positions, next_positions);
    std::swap(position_columns, next_position_columns);
  }
};

/// Nodes next to each other whose springs stand in diagonals.
struct NodeRange {
  std::span<const SpringDiagonal> diagonals;
  std::size_t first, last;     ///< from a multiple of 4 to before any number
  const ColumnArrays* given;   ///< other forces; or null
  const std::uint32_t* fours;  ///< where in `given` those of four nodes begin, from node `first` on
};

class ForceWindow;

/// Nodes closer than the root of this are at the same place: the direction of the spring is undefined, and no
/// force is taken. The smallest normal number, whose inverse is finite.
inline constexpr double smallest_squared_length = std::numeric_limits<double>::min();

/// Equations 1 to 3: the force of a spring and a damper on its first node, over the vector along it.
/// @param d,u  differences of position and velocity
inline double force_per_length(const std::array<double, 3>& d, const std::array<double, 3>& u,
                               double rest_length, double stiffness, double damping) {
  const double squared = (d[0] * d[0] + d[1] * d[1]) + d[2] * d[2];
  const double length = std::sqrt(squared);
  // Root and quotient do not wait for each other.
  const double inverse_squared = squared >= smallest_squared_length ? 1 / squared : 0;
  const double stretch = stiffness * (length - rest_length);
  const double rate = damping * ((u[0] * d[0] + u[1] * d[1]) + u[2] * d[2]);
  return (stretch * length + rate) * inverse_squared;
}

struct Kernels {
  /// Equations 1 to 3: adds the forces of springs and dampers to `forces`, in their order.
  void (*add_spring_forces)(std::span<const ListedSprings> springs, const PaddedVector* positions,
                            const PaddedVector* velocities, PaddedVector* forces);
  /// The same for the first node of each spring only.
  void (*add_forces_at_first_node)(std::span<const ListedSprings> springs, const PaddedVector* positions,
                                   const PaddedVector* velocities, PaddedVector* forces);
  /// Equations 4 to 6 for slots [first, last) and then for others: replaces each force by the node's next
  /// velocity, and finds next positions if they are wanted. Returns whether all velocities are within the
  /// speed limit, which none that is NaN or infinite is.
  bool (*advance_nodes)(const VelocityUpdate& update, const NodeArrays& nodes, std::size_t first,
                        std::size_t last, std::span<const SlottedNode> others);
  /// Equation 6: from `positions` to `moved`, which may be the same.
  void (*move)(double time_step, std::span<const PaddedVector> positions, const PaddedVector* velocities,
               PaddedVector* moved);
  /// All equations, in columns. Without an update leaves the sums of forces in place of the next velocities.
  /// Returns what `advance_nodes` does.
  bool (*advance_range)(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                        ForceWindow& window);
  /// Takes vectors of nodes apart, and puts them together.
  void (*to_columns)(const PaddedVector* vectors, std::size_t first, std::size_t last,
                     const ColumnArrays& to);
  void (*from_columns)(const ColumnArrays& columns, std::size_t first, std::size_t last, PaddedVector* to);
  /// Copies position and velocity of nodes in columns to their slots, where no force acts yet.
  void (*gather)(std::span<const SlottedNode> held, const NodeArrays& nodes);
  /// Adds the forces at these slots to what is given. The four entries after those of the range take what
  /// acts on nodes beyond.
  void (*scatter)(std::span<const SlottedNode> held, const PaddedVector* forces, const NodeRange& range);
};

/// Plain C++.
[[nodiscard]] const Kernels& portable_kernels();
/// The fastest that this processor has.
[[nodiscard]] const Kernels& best_kernels();

}  // namespace cut

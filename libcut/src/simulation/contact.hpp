/// @file
/// How nodes meet obstacles (docs/simulation.md, "Contact"). In: where a node is and the velocity with which
/// it is about to move. Out: the velocity with which it does not go in.
#pragma once
#include <optional>
#include <vector>

#include "cut/error.hpp"
#include "cut/simulation.hpp"

namespace cut {

/// Where a node would be in an obstacle, both moved on by a step.
struct Meeting {
  Eigen::Vector3d normal;    ///< out of the obstacle, of length 1
  double depth;              ///< > 0
  Eigen::Vector3d velocity;  ///< of the obstacle
  double friction;
};

/// What friction leaves of a velocity: it takes up to `most` from the speed along the surface of an obstacle
/// that moves with `obstacle`, never more than there is.
Eigen::Vector3d braked(const Eigen::Vector3d& velocity, const Eigen::Vector3d& obstacle,
                       const Eigen::Vector3d& normal, double most);

/// Obstacles as a step of length h sees them.
class Obstacles {
 public:
  /// @param slack  depths up to this are none
  Obstacles(const Surroundings& surroundings, double time_step, double slack);

  [[nodiscard]] bool empty() const {
    return surroundings_->half_spaces.empty() && surroundings_->spheres.empty();
  }
  [[nodiscard]] double time_step() const { return time_step_; }
  /// The obstacle that a node at `position` with `velocity` will be in deepest after the step.
  [[nodiscard]] std::optional<Meeting> deepest(const Eigen::Vector3d& position,
                                               const Eigen::Vector3d& velocity) const;
  /// The velocity after the impulses of obstacles: each just keeps the node out, and friction takes from the
  /// speed along its surface what Coulomb's law allows, never more than there is. Several obstacles act in
  /// turn, deepest first, and at most 8 times.
  [[nodiscard]] Eigen::Vector3d kept_out(const Eigen::Vector3d& position, Eigen::Vector3d velocity,
                                         bool with_friction) const;
  /// The nearest place on the surface for a node that is in an obstacle before the step.
  [[nodiscard]] Eigen::Vector3d put_out(Eigen::Vector3d position) const;

 private:
  const Surroundings* surroundings_;
  double time_step_;
  double slack_;
};

/// Moves all obstacles on.
void move_obstacles(Surroundings& surroundings, double time_step);

}  // namespace cut

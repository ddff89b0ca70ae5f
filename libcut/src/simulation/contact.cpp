// How nodes meet obstacles, see contact.hpp.
#include "simulation/contact.hpp"

#include "mesh/vector3.hpp"

namespace cut {
namespace {

/// Contact with one obstacle may push a node into another one.
constexpr int most_rounds = 8;

}  // namespace

Eigen::Vector3d braked(const Eigen::Vector3d& velocity, const Eigen::Vector3d& obstacle,
                       const Eigen::Vector3d& normal, double most) {
  const Eigen::Vector3d relative = velocity - obstacle;
  const Eigen::Vector3d along = relative - dot(relative, normal) * normal;
  const double speed = length(along);
  return velocity - (speed > most ? most / speed : 1.0) * along;
}

Obstacles::Obstacles(const Surroundings& surroundings, double time_step, double slack)
    : surroundings_(&surroundings), time_step_(time_step), slack_(slack) {}

std::optional<Meeting> Obstacles::deepest(const Eigen::Vector3d& position,
                                          const Eigen::Vector3d& velocity) const {
  std::optional<Meeting> found;
  const auto consider = [&](const Eigen::Vector3d& normal, double depth, const auto& obstacle) {
    if (depth > (found ? found->depth : slack_))
      found = Meeting{normal, depth, obstacle.velocity, obstacle.friction};
  };
  const auto offset = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& own) -> Eigen::Vector3d {
    return (position - origin) + time_step_ * (velocity - own);
  };
  for (const HalfSpace& o : surroundings_->half_spaces) {
    const Eigen::Vector3d normal = o.normal / length(o.normal);
    consider(normal, -dot(normal, offset(o.point, o.velocity)), o);
  }
  for (const Sphere& o : surroundings_->spheres) {
    const Eigen::Vector3d from_centre = offset(o.centre, o.velocity);
    const double distance = length(from_centre);
    // In the centre itself every way out is as long as any other.
    const Eigen::Vector3d normal =
        distance > 0 ? Eigen::Vector3d(from_centre / distance) : Eigen::Vector3d::UnitZ();
    consider(normal, o.radius - distance, o);
  }
  return found;
}

Eigen::Vector3d Obstacles::kept_out(const Eigen::Vector3d& position, Eigen::Vector3d velocity,
                                    bool with_friction) const {
  for (int round = 0; round < most_rounds; ++round) {
    const auto met = deepest(position, velocity);
    if (!met) break;
    const double push = met->depth / time_step_;
    velocity += push * met->normal;
    if (with_friction) velocity = braked(velocity, met->velocity, met->normal, met->friction * push);
  }
  return velocity;
}

Eigen::Vector3d Obstacles::put_out(Eigen::Vector3d position) const {
  for (int round = 0; round < most_rounds; ++round) {
    const Obstacles still(*surroundings_, 0, slack_);
    const auto met = still.deepest(position, Eigen::Vector3d::Zero());
    if (!met) break;
    position += met->depth * met->normal;
  }
  return position;
}

void move_obstacles(Surroundings& surroundings, double time_step) {
  for (HalfSpace& o : surroundings.half_spaces) o.point += time_step * o.velocity;
  for (Sphere& o : surroundings.spheres) o.centre += time_step * o.velocity;
}

}  // namespace cut

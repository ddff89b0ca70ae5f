// One step of the simulation (§3.1). In: the mesh's positions. Out: the same, moved on. The next velocities
// are computed beside the old ones and looked at before anything is overwritten, so that a blow-up leaves the
// last good state.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/contact.hpp"
#include "simulation/drag.hpp"
#include "simulation/kernels.hpp"
#include "simulation/padded.hpp"

namespace cut {
namespace {

bool within(const PaddedVector& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

/// The first vector with a component beyond the limit, or that is not a number.
std::size_t first_beyond(const std::vector<PaddedVector>& vectors, double limit) {
  const auto beyond = [&](const PaddedVector& v) { return !within(v, limit); };
  return static_cast<std::size_t>(std::find_if(vectors.begin(), vectors.end(), beyond) - vectors.begin());
}

Error blow_up(std::uint64_t step, std::size_t node, const std::string& what) {
  return {Error::Kind::unstable,
          "the simulation blew up in step " + std::to_string(step) + ": node " + std::to_string(node) + " " +
              what + "; the state before that step is kept (is the time step below stable_time_step()?)",
          node};
}

/// What is wrong with the surroundings, or nothing.
std::optional<Error> fault_of(const Surroundings& s, double time_step, double way) {
  const auto wrong = [](const std::string& message, std::size_t element = 0) {
    return Error{Error::Kind::bad_parameter, message, element};
  };
  const auto not_negative = [](double v) { return v >= 0 && std::isfinite(v); };
  if (!(time_step > 0 && std::isfinite(time_step))) return wrong("the time step must be positive and finite");
  if (!s.gravity.allFinite() || !s.wind.allFinite()) return wrong("gravity and wind must be finite");
  if (!not_negative(s.air_drag) || !not_negative(s.normal_drag))
    return wrong("drag must be finite and not negative");
  if (!(s.tolerance > 0 && s.tolerance < 1)) return wrong("the tolerance must be between 0 and 1");
  if (!(s.longest_way >= 0 && s.longest_way < largest_coordinate))
    return wrong("the longest way must be not negative and less than 1e50");
  const auto fault_of_obstacle = [&](const auto& o, const Eigen::Vector3d& place, bool shape,
                                     const std::string& name, std::size_t i) -> std::optional<Error> {
    const std::string which = name + " " + std::to_string(i);
    if (!shape || !place.allFinite()) return wrong(which + " has no sound shape or place", i);
    if (!not_negative(o.friction))
      return wrong("the friction of " + which + " must be finite and not negative", i);
    if (!(o.velocity.allFinite() && o.velocity.cwiseAbs().maxCoeff() * time_step <= way))
      return wrong(which + " goes further in one step than a node may", i);
    return std::nullopt;
  };
  for (std::size_t i = 0; i < s.half_spaces.size(); ++i) {
    const HalfSpace& o = s.half_spaces[i];
    const double size = length(o.normal);
    if (auto error = fault_of_obstacle(o, o.point, size > 0 && std::isfinite(size), "half-space", i))
      return error;
  }
  for (std::size_t i = 0; i < s.spheres.size(); ++i) {
    const Sphere& o = s.spheres[i];
    if (auto error = fault_of_obstacle(o, o.centre, o.radius > 0 && std::isfinite(o.radius), "sphere", i))
      return error;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> Simulation::step(HybridMesh& mesh, double time_step, std::size_t count) {
  const double way = surroundings.longest_way > 0 ? surroundings.longest_way : diagonal_;
  if (auto error = fault_of(surroundings, time_step, way)) return error;
  if (mesh.topology_version != topology_version_ || mesh.positions.size() != mass_.size())
    return Error{Error::Kind::bad_parameter, "the mesh has cuts that the simulation was not told of", 0};
  for_each_run([&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) positions_[n] = padded(mesh.positions[n]);
  });
  if (const std::size_t n = first_beyond(positions_, largest_coordinate); n < positions_.size())
    return blow_up(updates_ + 1, n, "has a position that is not finite or too large");

  const Obstacles obstacles(surroundings, time_step, contact_slack());
  const bool forward = surroundings.integrator == Integrator::forward_euler;
  if (!obstacles.empty()) {
    for (std::size_t n = 0; n < positions_.size(); ++n)
      if (inverse_mass_[n] > 0) positions_[n] = padded(obstacles.put_out(plain(positions_[n])));
    if (forward) keep_out(obstacles, velocities_);
  }
  const std::uint64_t before = updates_;
  std::optional<Error> error;
  if (surroundings.integrator != Integrator::implicit_euler && obstacles.empty() &&
      surroundings.normal_drag == 0)
    error = step_free(time_step, way / time_step, count);
  else
    for (std::size_t i = 0; i < count && !error; ++i) {
      error = surroundings.integrator == Integrator::implicit_euler
                  ? implicit_velocities(mesh, time_step, way / time_step, obstacles)
                  : explicit_velocities(mesh, time_step, way / time_step);
      if (error) break;
      if (!forward && !obstacles.empty()) keep_out(obstacles, forces_);
      const PaddedVector* velocities = forward ? velocities_.data() : forces_.data();
      for_each_run([&](std::size_t first, std::size_t last) {
        best_kernels().move(time_step, {&positions_[first], last - first}, velocities + first,
                            &positions_[first]);
      });
      velocities_.swap(forces_);
      move_obstacles(surroundings, time_step);
      if (forward && !obstacles.empty()) keep_out(obstacles, velocities_);
      ++updates_;
    }
  if (updates_ == before) return error;
  for_each_run([&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) mesh.positions[n] = plain(positions_[n]);
  });
  mesh.moved();
  return error;
}

double Simulation::contact_slack() const { return 1e-12 * diagonal_; }

/// Leaves in `air_forces_` external forces and those of air across the cloth.
void Simulation::find_air_forces(const HybridMesh& mesh) {
  if (external_forces_.empty())
    air_forces_.assign(mass_.size(), {});
  else
    air_forces_ = external_forces_;
  for_each_dragged_corner(mesh.buffers, positions_, weights_, surroundings.normal_drag,
                          [&](std::size_t n, const Eigen::Vector3d& normal, double c) {
                            const double speed = dot(plain(velocities_[n]) - surroundings.wind, normal);
                            air_forces_[n] = air_forces_[n] - padded(c * speed * normal);
                          });
}

/// Loops over nodes alone run over nodes in their order, a run for each block.
void Simulation::for_each_run(const std::function<void(std::size_t first, std::size_t last)>& body) const {
  const std::size_t runs = blocks_.blocks().size(), run = (positions_.size() + runs - 1) / runs;
  executor.for_each(runs, [&](std::size_t b) {
    const std::size_t first = std::min(positions_.size(), b * run);
    const std::size_t last = std::min(positions_.size(), first + run);
    if (first < last) body(first, last);
  });
}

VelocityUpdate Simulation::velocity_update(double time_step, double speed_limit) const {
  const double drag = surroundings.air_drag / material_.density;
  return {time_step, padded(surroundings.gravity + drag * surroundings.wind), drag, speed_limit,
          surroundings.integrator == Integrator::forward_euler};
}

/// As `go_through_blocks` for one step that leaves nodes where they are, from `positions_` and `velocities_`
/// to `forces_`.
bool Simulation::find_forces(const VelocityUpdate* update) {
  const NodeArrays nodes = node_arrays(false);
  load(nodes);
  const bool sound = go_through_blocks(update, nodes, 1);
  take_next_velocities(nodes);
  return sound;
}

/// Leaves in `forces_` the next velocities.
std::optional<Error> Simulation::explicit_velocities(const HybridMesh& mesh, double time_step,
                                                     double speed_limit) {
  const VelocityUpdate update = velocity_update(time_step, speed_limit);
  if (surroundings.normal_drag > 0) find_air_forces(mesh);
  return find_forces(&update) ? std::nullopt : unsound_velocity(speed_limit);
}

/// Explicit steps of a cloth that meets nothing: positions and velocities go from array to array, and only
/// when all steps are done back to `positions_` and `velocities_`.
std::optional<Error> Simulation::step_free(double time_step, double speed_limit, std::size_t count) {
  const VelocityUpdate update = velocity_update(time_step, speed_limit);
  NodeArrays nodes = node_arrays(true);
  std::optional<Error> error;
  std::size_t at_once = steps_at_once(), sound = count;
  load(nodes);
  for (std::size_t done = 0; done < count && !error;) {
    // Which of several steps went wrong, and from where, is found by going there again.
    const std::size_t steps = done < sound ? std::min(at_once, sound - done) : 1;
    if (go_through_blocks(&update, nodes, steps)) {
      if (steps % 2 == 1) nodes.step_on();
      done += steps;
    } else if (steps == 1) {
      take_next_velocities(nodes);
      updates_ += done;
      error = unsound_velocity(speed_limit);
      count = done;
    } else {
      sound = std::exchange(done, 0);
      load(nodes);
    }
  }
  if (!error) updates_ += count;
  if (count > 0) store(nodes);
  return error;
}

/// Names the first node whose next velocity is beyond the limit, if there is one.
std::optional<Error> Simulation::unsound_velocity(double speed_limit) const {
  const std::size_t node = first_beyond(forces_, speed_limit);
  if (node == forces_.size()) return std::nullopt;
  const bool finite = within(forces_[node], std::numeric_limits<double>::max());
  return blow_up(updates_ + 1, node,
                 finite ? "went further in it than longest_way" : "has a velocity that is not finite");
}

/// Names the first node with a force or velocity that is not finite: of these an implicit step would make
/// velocities that all are not.
std::optional<Error> Simulation::unsound_forces() const {
  const double most = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    if (!within(velocities_[n], most)) return blow_up(updates_ + 1, n, "has a velocity that is not finite");
    if (inverse_mass_[n] > 0 && !within(forces_[n], most))
      return blow_up(updates_ + 1, n, "has a force that is not finite");
  }
  return std::nullopt;
}

/// Takes from the velocities of free nodes what would lead into an obstacle, and what friction takes. An
/// implicit step has dealt with friction.
void Simulation::keep_out(const Obstacles& obstacles, std::vector<PaddedVector>& velocities) const {
  const bool with_friction = surroundings.integrator != Integrator::implicit_euler;
  for (std::size_t n = 0; n < velocities.size(); ++n)
    if (inverse_mass_[n] > 0)
      velocities[n] = padded(obstacles.kept_out(plain(positions_[n]), plain(velocities[n]), with_friction));
}

}  // namespace cut

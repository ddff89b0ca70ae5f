// One step of the simulation (§3.1). In: the mesh's positions. Out: the same, moved on. The next velocities
// are computed beside the old ones and looked at before anything is overwritten, so that a blow-up leaves the
// last good state.
#include <cmath>
#include <string>

#include "cut/simulation.hpp"
#include "simulation/kernels.hpp"

namespace cut {
namespace {

/// The first node whose velocity is beyond the limit. @pre there is one
std::size_t first_unsound(const std::vector<PaddedVector>& velocities, double limit) {
  const auto sound = [&](double v) { return std::abs(v) <= limit; };
  std::size_t n = 0;
  while (sound(velocities[n].x) && sound(velocities[n].y) && sound(velocities[n].z)) ++n;
  return n;
}

Error blow_up(std::uint64_t step, std::size_t node, bool finite) {
  return {Error::Kind::unstable,
          "the simulation blew up in step " + std::to_string(step) + ": node " + std::to_string(node) +
              (finite ? " went too far" : " has a velocity that is not finite") +
              "; the state before that step is kept (is the time step below stable_time_step()?)",
          node};
}

}  // namespace

std::optional<Error> Simulation::step(HybridMesh& mesh, double time_step, std::size_t count) {
  if (!(time_step > 0 && std::isfinite(time_step)))
    return Error{Error::Kind::bad_parameter, "the time step must be positive and finite", 0};
  if (mesh.topology_version != topology_version_ || mesh.positions.size() != mass_.size())
    return Error{Error::Kind::bad_parameter, "the mesh has cuts that the simulation was not told of", 0};

  const double drag = surroundings.air_drag / material_.density;
  const Eigen::Vector3d acceleration = surroundings.gravity + drag * surroundings.wind;
  const double way = surroundings.longest_way > 0 ? surroundings.longest_way : diagonal_;
  const VelocityUpdate update{
      time_step, {acceleration.x(), acceleration.y(), acceleration.z(), 0}, drag, way / time_step};
  const bool forward = surroundings.integrator == Integrator::forward_euler;
  const Kernels& kernels = best_kernels();

  for (std::size_t n = 0; n < positions_.size(); ++n)
    positions_[n] = {mesh.positions[n].x(), mesh.positions[n].y(), mesh.positions[n].z(), 0};
  std::optional<Error> error;
  for (std::size_t i = 0; i < count && !error; ++i) {
    if (external_forces_.empty())
      std::fill(forces_.begin(), forces_.end(), PaddedVector{});
    else
      std::copy(external_forces_.begin(), external_forces_.end(), forces_.begin());
    kernels.add_spring_forces(springs_, positions_.data(), velocities_.data(), forces_.data());
    if (kernels.replace_by_velocities(update, inverse_mass_, velocities_.data(), forces_.data())) {
      kernels.move(time_step, positions_, forward ? velocities_.data() : forces_.data());
      velocities_.swap(forces_);
      ++updates_;
    } else {
      const std::size_t node = first_unsound(forces_, update.speed_limit);
      const PaddedVector& v = forces_[node];
      error = blow_up(updates_ + 1, node, std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    }
  }
  for (std::size_t n = 0; n < positions_.size(); ++n)
    mesh.positions[n] = {positions_[n].x, positions_[n].y, positions_[n].z};
  mesh.moved();
  return error;
}

}  // namespace cut

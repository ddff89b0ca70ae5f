// One step of the simulation (§3.1). In: the mesh's positions. Out: the same, moved on. The next velocities
// are computed beside the old ones and looked at before anything is overwritten, so that a blow-up leaves the
// last good state.
#include <algorithm>
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

/// Leaves the next velocities in `forces_`, one block of nodes after the other or at the same time.
bool Simulation::add_forces_and_replace_by_velocities(const VelocityUpdate& update) {
  const Kernels& kernels = best_kernels();
  const std::vector<SpringBlock>& blocks = blocks_.blocks();
  executor.for_each(blocks.size(), [&](std::size_t b) {
    const SpringBlock& block = blocks[b];
    const auto for_each_part = [&](const auto& visit) {
      visit(block.first, block.last - block.first);
      for (const std::uint32_t copy : block.copies) visit(copy, 1u);
    };
    for_each_part([&](std::uint32_t first, std::uint32_t count) {
      if (external_forces_.empty())
        std::fill_n(forces_.begin() + first, count, PaddedVector{});
      else
        std::copy_n(external_forces_.begin() + first, count, forces_.begin() + first);
    });
    kernels.add_spring_forces(block.inner, positions_.data(), velocities_.data(), forces_.data());
    kernels.add_forces_at_first_node(block.outer, positions_.data(), velocities_.data(), forces_.data());
    bool sound = true;
    for_each_part([&](std::uint32_t first, std::uint32_t count) {
      sound &= kernels.replace_by_velocities(update, {&inverse_mass_[first], count}, &velocities_[first],
                                             &forces_[first]);
    });
    sound_[b] = sound ? 1 : 0;
  });
  return std::find(sound_.begin(), sound_.end(), 0) == sound_.end();
}

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
  // Loops over nodes alone run over nodes in their order, a run for each block.
  const std::size_t runs = blocks_.blocks().size(), run = (positions_.size() + runs - 1) / runs;
  const auto for_each_run = [&](const auto& body) {
    executor.for_each(runs, [&](std::size_t b) {
      const std::size_t first = std::min(positions_.size(), b * run);
      const std::size_t last = std::min(positions_.size(), first + run);
      if (first < last) body(first, last);
    });
  };

  for_each_run([&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n)
      positions_[n] = {mesh.positions[n].x(), mesh.positions[n].y(), mesh.positions[n].z(), 0};
  });
  std::optional<Error> error;
  for (std::size_t i = 0; i < count && !error; ++i) {
    if (add_forces_and_replace_by_velocities(update)) {
      const PaddedVector* velocities = forward ? velocities_.data() : forces_.data();
      for_each_run([&](std::size_t first, std::size_t last) {
        kernels.move(time_step, {&positions_[first], last - first}, velocities + first);
      });
      velocities_.swap(forces_);
      ++updates_;
    } else {
      const std::size_t node = first_unsound(forces_, update.speed_limit);
      const PaddedVector& v = forces_[node];
      error = blow_up(updates_ + 1, node, std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    }
  }
  for_each_run([&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n)
      mesh.positions[n] = {positions_[n].x, positions_[n].y, positions_[n].z};
  });
  mesh.moved();
  return error;
}

}  // namespace cut

// The loops of one step in plain C++. In and out: the padded arrays of Simulation::step.
#include "simulation/kernels.hpp"

#include <cmath>

#include "simulation/diagonals.hpp"

namespace cut {
namespace {

template <bool BothNodes>
void add_spring_forces(const SpringArrays& springs, const PaddedVector* positions,
                       const PaddedVector* velocities, PaddedVector* forces) {
  for (std::size_t i = 0; i < springs.nodes.size(); ++i) {
    const auto [a, b] = springs.nodes[i];
    const PaddedVector& pa = positions[a];
    const PaddedVector& pb = positions[b];
    const PaddedVector& va = velocities[a];
    const PaddedVector& vb = velocities[b];
    const double dx = pb.x - pa.x, dy = pb.y - pa.y, dz = pb.z - pa.z;
    const double ux = vb.x - va.x, uy = vb.y - va.y, uz = vb.z - va.z;
    const double squared = (dx * dx + dy * dy) + dz * dz;
    const double length = std::sqrt(squared);
    // Root and quotient do not wait for each other.
    const double inverse_squared = squared >= smallest_squared_length ? 1 / squared : 0;
    const double stretch = springs.stiffness[i] * (length - springs.rest_length[i]);
    const double rate = springs.damping[i] * ((ux * dx + uy * dy) + uz * dz);
    const double scale = (stretch * length + rate) * inverse_squared;
    const double fx = dx * scale, fy = dy * scale, fz = dz * scale;
    forces[a].x += fx;
    forces[a].y += fy;
    forces[a].z += fz;
    if constexpr (!BothNodes) continue;
    forces[b].x -= fx;
    forces[b].y -= fy;
    forces[b].z -= fz;
  }
}

bool replace_by_velocities(const VelocityUpdate& update, std::span<const double> inverse_mass,
                           const PaddedVector* velocities, PaddedVector* forces) {
  bool sound = true;
  const auto next = [&](double force, double inverse, double velocity, double acceleration) {
    const double result = update.next(force, inverse, velocity, acceleration);
    sound &= std::abs(result) <= update.speed_limit;
    return result;
  };
  for (std::size_t n = 0; n < inverse_mass.size(); ++n) {
    const double inverse = inverse_mass[n];
    const PaddedVector& v = velocities[n];
    PaddedVector& f = forces[n];
    f.x = next(f.x, inverse, v.x, update.acceleration.x);
    f.y = next(f.y, inverse, v.y, update.acceleration.y);
    f.z = next(f.z, inverse, v.z, update.acceleration.z);
  }
  return sound;
}

void move(double time_step, std::span<const PaddedVector> positions, const PaddedVector* velocities,
          PaddedVector* moved) {
  for (std::size_t n = 0; n < positions.size(); ++n) {
    moved[n].x = positions[n].x + velocities[n].x * time_step;
    moved[n].y = positions[n].y + velocities[n].y * time_step;
    moved[n].z = positions[n].z + velocities[n].z * time_step;
  }
}

bool advance_nodes(std::span<const std::uint32_t> which, const VelocityUpdate& update,
                   const NodeArrays& nodes) {
  bool sound = true;
  for (const std::uint32_t n : which) {
    sound &=
        replace_by_velocities(update, {nodes.inverse_mass + n, 1}, nodes.velocities + n, nodes.forces + n);
    if (nodes.moves)
      move(update.time_step, {nodes.positions + n, 1},
           (update.old_first ? nodes.velocities : nodes.forces) + n, nodes.next_positions + n);
  }
  return sound;
}

void to_columns(const PaddedVector* vectors, std::size_t first, std::size_t last, const ColumnArrays& to) {
  for (std::size_t n = first; n < last; ++n) {
    to[0][n] = vectors[n].x;
    to[1][n] = vectors[n].y;
    to[2][n] = vectors[n].z;
  }
}

void from_columns(const ColumnArrays& columns, std::size_t first, std::size_t last, PaddedVector* to) {
  for (std::size_t n = first; n < last; ++n) to[n] = {columns[0][n], columns[1][n], columns[2][n], 0};
}

}  // namespace

const Kernels& portable_kernels() {
  static constexpr Kernels kernels{add_spring_forces<true>,
                                   add_spring_forces<false>,
                                   replace_by_velocities,
                                   move,
                                   advance_nodes,
                                   advance_block_portable,
                                   to_columns,
                                   from_columns};
  return kernels;
}

}  // namespace cut

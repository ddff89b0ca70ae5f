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
    const std::array<double, 3> d{pb.x - pa.x, pb.y - pa.y, pb.z - pa.z};
    const double scale = force_per_length(d, {vb.x - va.x, vb.y - va.y, vb.z - va.z}, springs.rest_length[i],
                                          springs.stiffness[i], springs.damping[i]);
    const double fx = d[0] * scale, fy = d[1] * scale, fz = d[2] * scale;
    forces[a].x += fx;
    forces[a].y += fy;
    forces[a].z += fz;
    if constexpr (!BothNodes) continue;
    forces[b].x -= fx;
    forces[b].y -= fy;
    forces[b].z -= fz;
  }
}

bool advance_nodes(const VelocityUpdate& update, const NodeArrays& nodes, std::size_t first, std::size_t last,
                   std::span<const std::uint32_t> others) {
  const double* const inverse_mass = nodes.inverse_mass + nodes.in_columns;
  bool sound = true;
  const auto advance = [&](std::size_t n) {
    const auto component = [&](double PaddedVector::* c) {
      const double v = nodes.velocities[n].*c;
      const double next = update.next(nodes.forces[n].*c, inverse_mass[n], v, update.acceleration.*c);
      sound &= std::abs(next) <= update.speed_limit;
      nodes.forces[n].*c = next;
      if (nodes.moves)
        nodes.next_positions[n].*c = nodes.positions[n].*c + (update.old_first ? v : next) * update.time_step;
    };
    component(&PaddedVector::x);
    component(&PaddedVector::y);
    component(&PaddedVector::z);
  };
  for (std::size_t n = first; n < last; ++n) advance(n);
  for (const std::uint32_t n : others) advance(n);
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

void gather(std::span<const std::uint32_t> entries, const ColumnArrays& columns, PaddedVector* to) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t n = entries[i];
    to[2 * i] = {columns[0][n], columns[1][n], columns[2][n], 0};
  }
}

}  // namespace

const Kernels& portable_kernels() {
  static constexpr Kernels kernels{add_spring_forces<true>,
                                   add_spring_forces<false>,
                                   advance_nodes,
                                   move,
                                   advance_range_portable,
                                   to_columns,
                                   from_columns,
                                   gather};
  return kernels;
}

}  // namespace cut

// The loops of one step in plain C++. In and out: the padded arrays of Simulation::step.
#include "simulation/kernels.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/diagonals.hpp"

namespace cut {
namespace {

template <bool BothNodes>
void add_spring_forces(std::span<const ListedSprings> springs, const PaddedVector* positions,
                       const PaddedVector* velocities, PaddedVector* forces) {
  for (std::size_t i = 0; i < 4 * springs.size(); ++i) {
    const auto [a, b] = springs[i / 4].nodes[i % 4];
    const FourSprings& four = springs[i / 4].springs;
    const PaddedVector& pa = positions[a];
    const PaddedVector& pb = positions[b];
    const PaddedVector& va = velocities[a];
    const PaddedVector& vb = velocities[b];
    const std::array<double, 3> d{pb.x - pa.x, pb.y - pa.y, pb.z - pa.z};
    const double scale = force_per_length(d, {vb.x - va.x, vb.y - va.y, vb.z - va.z}, four.rest_length[i % 4],
                                          four.stiffness[i % 4], four.damping[i % 4]);
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
                   std::span<const SlottedNode> others) {
  const double* const inverse_mass = nodes.inverse_mass_at_slots;
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
  for (const SlottedNode& n : others) advance(n.slot);
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

void gather(std::span<const SlottedNode> held, const NodeArrays& nodes) {
  const ColumnArrays &p = nodes.position_columns, &v = nodes.velocity_columns;
  for (const auto [n, slot] : held) {
    nodes.positions[slot] = {p[0][n], p[1][n], p[2][n], 0};
    nodes.velocities[slot] = {v[0][n], v[1][n], v[2][n], 0};
    nodes.forces[slot] = {};
  }
}

void scatter(std::span<const SlottedNode> held, const PaddedVector* forces, const NodeRange& range) {
  const ColumnArrays& sums = *range.given;
  const std::size_t size = (range.last - range.first + 3) / 4 * 4;
  for (const auto [node, slot] : held) {
    const std::size_t n = std::min(node - range.first, size), entry = range.fours[n / 4] + n % 4;
    sums[0][entry] += forces[slot].x;
    sums[1][entry] += forces[slot].y;
    sums[2][entry] += forces[slot].z;
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
                                   gather,
                                   scatter};
  return kernels;
}

}  // namespace cut

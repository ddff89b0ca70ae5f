// Springs in diagonals, in plain C++.
#include "simulation/diagonals.hpp"

#include <cmath>

namespace cut {
namespace {

struct Loops {
  /// Of the springs that start at nodes [from, to). @pre from and to are multiples of 4
  static void find_forces(const SpringDiagonal& d, std::size_t from, std::size_t to, const NodeArrays& nodes,
                          std::ptrdiff_t shift, const ColumnArrays& forces) {
    const ColumnArrays &p = nodes.position_columns, &v = nodes.velocity_columns;
    for (std::size_t a = from; a < to; ++a) {
      const std::size_t b = a + d.offset, entry = a - d.first;
      const FourSprings& four = d.springs[entry / 4];
      const std::array<double, 3> along{p[0][b] - p[0][a], p[1][b] - p[1][a], p[2][b] - p[2][a]};
      const double scale =
          force_per_length(along, {v[0][b] - v[0][a], v[1][b] - v[1][a], v[2][b] - v[2][a]},
                           four.rest_length[entry % 4], four.stiffness[entry % 4], four.damping[entry % 4]);
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(a) + shift;
      for (std::size_t k = 0; k < 3; ++k) forces[k][i] = along[k] * scale;
    }
  }

  /// Equations 4 to 6. @pre from is a multiple of 4
  static bool finish(const VelocityUpdate* update, bool begun, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes) {
    bool sound = true;
    for (std::size_t n = from; n < to; ++n) {
      const std::ptrdiff_t i = forces.at(n);
      const auto component = [&](std::size_t k, double PaddedVector::* c) {
        double& force = nodes.forces[n].*c;
        double sum = 0;
        for (std::size_t d = 0; d < forces.count; ++d) {
          const double* const f = forces.columns[d][k];
          const double both = f[i] - f[i - forces.offsets[d]];
          sum = d == 0 ? both : sum + both;
        }
        if (begun) sum = force + sum;
        if (update == nullptr) {
          force = sum;
          return;
        }
        const double v = nodes.velocity_columns[k][n];
        const double next = update->next(sum, nodes.inverse_mass[n], v, update->acceleration.*c);
        sound &= std::abs(next) <= update->speed_limit;
        nodes.next_velocity_columns[k][n] = next;
        if (nodes.padded) force = next;
        if (!nodes.moves) return;
        const double moved =
            nodes.position_columns[k][n] + (update->old_first ? v : next) * update->time_step;
        nodes.next_position_columns[k][n] = moved;
        if (nodes.padded) nodes.next_positions[n].*c = moved;
      };
      component(0, &PaddedVector::x);
      component(1, &PaddedVector::y);
      component(2, &PaddedVector::z);
    }
    return sound;
  }
};

}  // namespace

bool finish_portable(const VelocityUpdate* update, bool begun, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes) {
  return Loops::finish(update, begun, from, to, forces, nodes);
}

bool advance_block_portable(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                            const NodeArrays& nodes) {
  return advance_block<Loops>(block, update, begun, nodes);
}

}  // namespace cut

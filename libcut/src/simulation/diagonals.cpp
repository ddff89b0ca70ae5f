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
      const std::size_t b = a + d.offset;
      const FourSprings& four = d.springs[a / 4];
      const std::array<double, 3> along{p[0][b] - p[0][a], p[1][b] - p[1][a], p[2][b] - p[2][a]};
      const double scale =
          force_per_length(along, {v[0][b] - v[0][a], v[1][b] - v[1][a], v[2][b] - v[2][a]},
                           four.rest_length[a % 4], four.stiffness[a % 4], four.damping[a % 4]);
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(a) + shift;
      for (std::size_t k = 0; k < 3; ++k) forces[k][i] = along[k] * scale;
    }
  }

  /// Equations 4 to 6. @pre from is a multiple of 4
  static bool finish(const NodeRange& range, const VelocityUpdate* update, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes) {
    bool sound = true;
    for (std::size_t n = from; n < to; ++n) {
      const auto i = static_cast<std::ptrdiff_t>(n);
      const auto component = [&](std::size_t k, double pull) {
        double force = 0;
        for (std::size_t d = 0; d < forces.count; ++d) {
          const double* const f = forces.columns[d][k];
          const double both = f[i + forces.starting] - f[i + forces.ending[d]];
          force = d == 0 ? both : force + both;
        }
        if (range.given != nullptr)
          force = (*range.given)[k][range.fours[(n - range.first) / 4] + n % 4] + force;
        double& next = nodes.next_velocity_columns[k][n];
        if (update == nullptr) {
          next = force;
          return;
        }
        const double v = nodes.velocity_columns[k][n];
        next = update->next(force, nodes.inverse_mass[n], v, pull);
        sound &= std::abs(next) <= update->speed_limit;
        if (nodes.moves)
          nodes.next_position_columns[k][n] =
              nodes.position_columns[k][n] + (update->old_first ? v : next) * update->time_step;
      };
      component(0, update != nullptr ? update->acceleration.x : 0);
      component(1, update != nullptr ? update->acceleration.y : 0);
      component(2, update != nullptr ? update->acceleration.z : 0);
    }
    return sound;
  }
};

}  // namespace

bool finish_portable(const NodeRange& range, const VelocityUpdate* update, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes) {
  return Loops::finish(range, update, from, to, forces, nodes);
}

bool advance_range_portable(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                            ForceWindow& window) {
  return advance_range<Loops>(range, update, nodes, window);
}

}  // namespace cut

// Springs in diagonals, for x86 processors with AVX2. The order of every sum is that of diagonals.cpp.
#if defined(__x86_64__)
#include "simulation/avx2.hpp"
#include "simulation/diagonals.hpp"

namespace cut {
namespace {

SNIP_AVX2 inline Columns load(const ColumnArrays& c, std::ptrdiff_t i) {
  return {_mm256_loadu_pd(c[0] + i), _mm256_loadu_pd(c[1] + i), _mm256_loadu_pd(c[2] + i)};
}
SNIP_AVX2 inline void store(const ColumnArrays& c, std::ptrdiff_t i, const Columns& value) {
  _mm256_storeu_pd(c[0] + i, value.x);
  _mm256_storeu_pd(c[1] + i, value.y);
  _mm256_storeu_pd(c[2] + i, value.z);
}
SNIP_AVX2 inline Columns subtract(const Columns& a, const Columns& b) {
  return {_mm256_sub_pd(a.x, b.x), _mm256_sub_pd(a.y, b.y), _mm256_sub_pd(a.z, b.z)};
}

struct Loops {
  SNIP_AVX2 static void find_forces(const SpringDiagonal& d, std::size_t from, std::size_t to,
                                    const NodeArrays& nodes, std::ptrdiff_t shift,
                                    const ColumnArrays& forces) {
    const ColumnArrays p = nodes.position_columns, v = nodes.velocity_columns;
    const ColumnArrays f{forces[0] + shift, forces[1] + shift, forces[2] + shift};
    const auto offset = static_cast<std::ptrdiff_t>(d.offset);
    const FourSprings* springs = d.springs.data() + from / 4;
    const auto end = static_cast<std::ptrdiff_t>(to);
    for (auto i = static_cast<std::ptrdiff_t>(from); i < end; i += 4, ++springs) {
      const Columns along = subtract(load(p, i + offset), load(p, i));
      const Columns rates = subtract(load(v, i + offset), load(v, i));
      const __m256d scale = forces_per_length(
          along, rates, {springs->rest_length.data(), springs->stiffness.data(), springs->damping.data()});
      store(f, i,
            {_mm256_mul_pd(along.x, scale), _mm256_mul_pd(along.y, scale), _mm256_mul_pd(along.z, scale)});
    }
  }

  SNIP_AVX2 static bool finish(const NodeRange& range, const VelocityUpdate* update, std::size_t from,
                               std::size_t to, const BlockForces& forces, const NodeArrays& nodes) {
    if (update == nullptr) return finish_portable(range, update, from, to, forces, nodes);
    const std::size_t fours = to / 4 * 4;
    const double acceleration[] = {update->acceleration.x, update->acceleration.y, update->acceleration.z};
    bool sound = true;
    for (std::size_t k = 0; k < 3; ++k) {
      // Sheets without and with bending springs.
      const auto component = forces.count == 3 ? finish<3> : forces.count == 6 ? finish<6> : finish<0>;
      sound &= component(*update, acceleration[k], range, from, fours, k, forces, nodes);
    }
    return (fours == to || finish_portable(range, update, fours, to, forces, nodes)) && sound;
  }

  /// One component. @tparam Count  of diagonals; 0 for any
  template <std::size_t Count>
  SNIP_AVX2 static bool finish(const VelocityUpdate& update, double acceleration, const NodeRange& range,
                               std::size_t from, std::size_t to, std::size_t component,
                               const BlockForces& forces, const NodeArrays& nodes) {
    const __m256d time_step = _mm256_set1_pd(update.time_step), drag = _mm256_set1_pd(update.drag),
                  limit = _mm256_set1_pd(update.speed_limit), pull = _mm256_set1_pd(acceleration);
    const bool old_first = update.old_first, moves = nodes.moves;
    const double *const p = nodes.position_columns[component], *const v = nodes.velocity_columns[component],
                        *const inverse_mass = nodes.inverse_mass;
    double *const next_p = nodes.next_position_columns[component], *const next_v =
                                                                       nodes.next_velocity_columns[component];
    std::array<const double*, most_diagonals> out{}, in{};
    const std::size_t count = Count > 0 ? Count : forces.count;
    for (std::size_t k = 0; k < count; ++k) {
      out[k] = forces.columns[k][component] + forces.starting;
      in[k] = forces.columns[k][component] + forces.ending[k];
    }
    const double* const given = range.given != nullptr ? (*range.given)[component] : nullptr;
    const std::uint32_t* four = range.fours + (given != nullptr ? (from - range.first) / 4 : 0);
    __m256d sound = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    for (std::size_t n = from; n < to; n += 4) {
      __m256d force = _mm256_sub_pd(_mm256_loadu_pd(out[0] + n), _mm256_loadu_pd(in[0] + n));
      for (std::size_t k = 1; k < count; ++k)
        force = _mm256_add_pd(force, _mm256_sub_pd(_mm256_loadu_pd(out[k] + n), _mm256_loadu_pd(in[k] + n)));
      if (given != nullptr) force = _mm256_add_pd(_mm256_loadu_pd(given + *four++), force);
      const __m256d inverse = _mm256_loadu_pd(inverse_mass + n), old = _mm256_loadu_pd(v + n);
      const __m256d free = _mm256_cmp_pd(inverse, _mm256_setzero_pd(), _CMP_GT_OQ);
      const __m256d a =
          _mm256_add_pd(_mm256_mul_pd(force, inverse), _mm256_sub_pd(pull, _mm256_mul_pd(drag, old)));
      const __m256d next = _mm256_blendv_pd(old, _mm256_add_pd(old, _mm256_mul_pd(a, time_step)), free);
      sound = _mm256_and_pd(sound, _mm256_cmp_pd(amount(next), limit, _CMP_LE_OQ));
      _mm256_storeu_pd(next_v + n, next);
      if (moves)
        _mm256_storeu_pd(next_p + n, _mm256_add_pd(_mm256_loadu_pd(p + n),
                                                   _mm256_mul_pd(old_first ? old : next, time_step)));
    }
    return _mm256_movemask_pd(sound) == 0b1111;
  }
};

}  // namespace

bool advance_range_avx2(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                        ForceWindow& window) {
  return advance_range<Loops>(range, update, nodes, window);
}

}  // namespace cut
#endif

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
SNIP_AVX2 inline Columns add(const Columns& a, const Columns& b) {
  return {_mm256_add_pd(a.x, b.x), _mm256_add_pd(a.y, b.y), _mm256_add_pd(a.z, b.z)};
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
    const auto offset = static_cast<std::ptrdiff_t>(d.offset), first = static_cast<std::ptrdiff_t>(d.first);
    const double *rest_length = d.rest_length.data() - first, *stiffness = d.stiffness.data() - first,
                 *damping = d.damping.data() - first;
    const auto end = static_cast<std::ptrdiff_t>(to);
    for (auto i = static_cast<std::ptrdiff_t>(from); i < end; i += 4) {
      const Columns along = subtract(load(p, i + offset), load(p, i));
      const Columns rates = subtract(load(v, i + offset), load(v, i));
      const __m256d scale = forces_per_length(along, rates, {rest_length + i, stiffness + i, damping + i});
      store(f, i,
            {_mm256_mul_pd(along.x, scale), _mm256_mul_pd(along.y, scale), _mm256_mul_pd(along.z, scale)});
    }
  }

  SNIP_AVX2 static void sum_up(bool first, std::size_t offset, std::ptrdiff_t from, std::ptrdiff_t to,
                               const ColumnArrays& forces, const ColumnArrays& sums) {
    const ColumnArrays out = forces, in{out[0] - offset, out[1] - offset, out[2] - offset}, sum = sums;
    if (first)
      for (std::ptrdiff_t i = from; i < to; i += 4) store(sum, i, subtract(load(out, i), load(in, i)));
    else
      for (std::ptrdiff_t i = from; i < to; i += 4)
        store(sum, i, add(load(sum, i), subtract(load(out, i), load(in, i))));
  }

  SNIP_AVX2 static bool finish(const VelocityUpdate* update, bool begun, std::size_t from, std::size_t to,
                               const ColumnArrays& sums, std::ptrdiff_t shift, const NodeArrays& nodes) {
    if (update == nullptr) return finish_portable(update, begun, from, to, sums, shift, nodes);
    const __m256d time_step = _mm256_set1_pd(update->time_step), drag = _mm256_set1_pd(update->drag);
    const __m256d limit = _mm256_set1_pd(update->speed_limit);
    const bool old_first = update->old_first, moves = nodes.moves, padded = nodes.padded;
    const ColumnArrays sum{sums[0] + shift, sums[1] + shift, sums[2] + shift},
        p = nodes.position_columns, v = nodes.velocity_columns, next_p = nodes.next_position_columns,
        next_v = nodes.next_velocity_columns;
    __m256d sound = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    const auto four = [&](std::ptrdiff_t n) SNIP_AVX2 {
      Columns force = load(sum, n);
      if (begun) force = add(cut::columns(nodes.forces + n), force);
      const __m256d inverse = _mm256_loadu_pd(nodes.inverse_mass + n);
      const __m256d free = _mm256_cmp_pd(inverse, _mm256_setzero_pd(), _CMP_GT_OQ);
      const auto velocity = [&](__m256d f, __m256d old, double acceleration) SNIP_AVX2 {
        const __m256d a = _mm256_add_pd(
            _mm256_mul_pd(f, inverse), _mm256_sub_pd(_mm256_set1_pd(acceleration), _mm256_mul_pd(drag, old)));
        const __m256d result = _mm256_blendv_pd(old, _mm256_add_pd(old, _mm256_mul_pd(a, time_step)), free);
        sound = _mm256_and_pd(sound, _mm256_cmp_pd(amount(result), limit, _CMP_LE_OQ));
        return result;
      };
      const __m256d old_x = _mm256_loadu_pd(v[0] + n), old_y = _mm256_loadu_pd(v[1] + n),
                    old_z = _mm256_loadu_pd(v[2] + n);
      const __m256d x = velocity(force.x, old_x, update->acceleration.x),
                    y = velocity(force.y, old_y, update->acceleration.y),
                    z = velocity(force.z, old_z, update->acceleration.z);
      if (padded) store(nodes.forces + n, {x, y, z});
      if (!moves) return;
      store(next_v, n, {x, y, z});
      const auto moved = [&](std::size_t k, __m256d old, __m256d next) SNIP_AVX2 {
        return _mm256_add_pd(_mm256_loadu_pd(p[k] + n), _mm256_mul_pd(old_first ? old : next, time_step));
      };
      const __m256d px = moved(0, old_x, x), py = moved(1, old_y, y), pz = moved(2, old_z, z);
      store(next_p, n, {px, py, pz});
      if (padded) store(nodes.next_positions + n, {px, py, pz});
    };
    const auto end = static_cast<std::ptrdiff_t>(to);
    auto n = static_cast<std::ptrdiff_t>(from);
    for (; n + 4 <= end; n += 4) four(n);
    bool rest = true;
    if (n < end) rest = finish_portable(update, begun, static_cast<std::size_t>(n), to, sums, shift, nodes);
    return _mm256_movemask_pd(sound) == 0b1111 && rest;
  }
};

}  // namespace

bool advance_block_avx2(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                        const NodeArrays& nodes) {
  return advance_block<Loops>(block, update, begun, nodes);
}

}  // namespace cut
#endif

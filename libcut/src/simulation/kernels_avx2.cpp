// The loops of one step for x86 processors with AVX2, which are looked for at run time: one node's vector is
// one register, and the lengths of four springs are found side by side. The order of every sum is that of
// kernels.cpp. Elsewhere the plain version is the best there is.
#include "simulation/kernels.hpp"

#if defined(__x86_64__)
#include "simulation/avx2.hpp"
#include "simulation/diagonals.hpp"

namespace cut {
namespace {

template <bool BothNodes>
SNIP_AVX2 void add_spring_forces(const SpringArrays& springs, const PaddedVector* positions,
                                 const PaddedVector* velocities, PaddedVector* forces) {
  for (std::size_t i = 0; i < springs.nodes.size(); i += 4) {
    const auto* const nodes = &springs.nodes[i];
    const auto along = [&](std::size_t k) SNIP_AVX2 {
      return _mm256_sub_pd(load(positions[nodes[k][1]]), load(positions[nodes[k][0]]));
    };
    const auto rate_of = [&](std::size_t k) SNIP_AVX2 {
      return _mm256_sub_pd(load(velocities[nodes[k][1]]), load(velocities[nodes[k][0]]));
    };
    const __m256d d0 = along(0), d1 = along(1), d2 = along(2), d3 = along(3);
    const Columns rates = columns(rate_of(0), rate_of(1), rate_of(2), rate_of(3));
    const __m256d scale =
        forces_per_length(columns(d0, d1, d2, d3), rates,
                          {&springs.rest_length[i], &springs.stiffness[i], &springs.damping[i]});
    const auto add = [&](std::size_t k, __m256d force) SNIP_AVX2 {
      PaddedVector& a = forces[nodes[k][0]];
      store(a, _mm256_add_pd(load(a), force));
      if constexpr (!BothNodes) return;
      PaddedVector& b = forces[nodes[k][1]];
      store(b, _mm256_sub_pd(load(b), force));
    };
    add(0, _mm256_mul_pd(d0, _mm256_permute4x64_pd(scale, 0x00)));
    add(1, _mm256_mul_pd(d1, _mm256_permute4x64_pd(scale, 0x55)));
    add(2, _mm256_mul_pd(d2, _mm256_permute4x64_pd(scale, 0xaa)));
    add(3, _mm256_mul_pd(d3, _mm256_permute4x64_pd(scale, 0xff)));
  }
}

SNIP_AVX2 bool replace_by_velocities(const VelocityUpdate& update, std::span<const double> inverse_mass,
                                     const PaddedVector* velocities, PaddedVector* forces) {
  const __m256d time_step = _mm256_set1_pd(update.time_step);
  const __m256d acceleration = load(update.acceleration);
  const __m256d drag = _mm256_set1_pd(update.drag);
  const __m256d limit = _mm256_set1_pd(update.speed_limit);
  const __m256d zero = _mm256_setzero_pd();
  __m256d sound = _mm256_cmp_pd(zero, zero, _CMP_EQ_OQ);
  for (std::size_t n = 0; n < inverse_mass.size(); ++n) {
    const __m256d inverse = _mm256_broadcast_sd(&inverse_mass[n]);
    const __m256d v = load(velocities[n]);
    const __m256d a = _mm256_add_pd(_mm256_mul_pd(load(forces[n]), inverse),
                                    _mm256_sub_pd(acceleration, _mm256_mul_pd(drag, v)));
    const __m256d free = _mm256_cmp_pd(inverse, zero, _CMP_GT_OQ);
    const __m256d next = _mm256_blendv_pd(v, _mm256_add_pd(v, _mm256_mul_pd(a, time_step)), free);
    sound = _mm256_and_pd(sound, _mm256_cmp_pd(amount(next), limit, _CMP_LE_OQ));
    store(forces[n], next);
  }
  return _mm256_movemask_pd(sound) == 0b1111;
}

SNIP_AVX2 void move(double time_step, std::span<const PaddedVector> positions, const PaddedVector* velocities,
                    PaddedVector* moved) {
  const __m256d factor = _mm256_set1_pd(time_step);
  for (std::size_t n = 0; n < positions.size(); ++n)
    store(moved[n], _mm256_add_pd(load(positions[n]), _mm256_mul_pd(load(velocities[n]), factor)));
}

SNIP_AVX2 void to_columns(const PaddedVector* vectors, std::size_t first, std::size_t last,
                          const ColumnArrays& to) {
  std::size_t n = first;
  for (; n + 4 <= last; n += 4) {
    const Columns c = columns(vectors + n);
    _mm256_storeu_pd(to[0] + n, c.x);
    _mm256_storeu_pd(to[1] + n, c.y);
    _mm256_storeu_pd(to[2] + n, c.z);
  }
  portable_kernels().to_columns(vectors, n, last, to);
}

SNIP_AVX2 void from_columns(const ColumnArrays& from, std::size_t first, std::size_t last, PaddedVector* to) {
  std::size_t n = first;
  for (; n + 4 <= last; n += 4)
    store(to + n, {_mm256_loadu_pd(from[0] + n), _mm256_loadu_pd(from[1] + n), _mm256_loadu_pd(from[2] + n)});
  portable_kernels().from_columns(from, n, last, to);
}

}  // namespace

const Kernels& best_kernels() {
  static constexpr Kernels kernels{add_spring_forces<true>,
                                   add_spring_forces<false>,
                                   replace_by_velocities,
                                   move,
                                   advance_block_avx2,
                                   to_columns,
                                   from_columns};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? kernels : portable_kernels();
}

}  // namespace cut
#else
namespace cut {
const Kernels& best_kernels() { return portable_kernels(); }
}  // namespace cut
#endif

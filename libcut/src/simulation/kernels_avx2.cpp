// The loops of one step for x86 processors with AVX2, which are looked for at run time: one node's vector is
// one register, and the lengths of four springs are found side by side. The order of every sum is that of
// kernels.cpp. Elsewhere the plain version is the best there is.
#include "simulation/kernels.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

#define SNIP_AVX2 __attribute__((target("avx2")))

namespace cut {
namespace {

SNIP_AVX2 inline __m256d load(const PaddedVector& v) { return _mm256_load_pd(&v.x); }
SNIP_AVX2 inline void store(PaddedVector& v, __m256d value) { _mm256_store_pd(&v.x, value); }

/// The components of four vectors side by side.
struct Columns {
  __m256d x, y, z;
};

SNIP_AVX2 inline Columns columns(__m256d a, __m256d b, __m256d c, __m256d d) {
  const __m256d ab_xz = _mm256_unpacklo_pd(a, b), cd_xz = _mm256_unpacklo_pd(c, d);
  const __m256d ab_yw = _mm256_unpackhi_pd(a, b), cd_yw = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(ab_xz, cd_xz, 0x20), _mm256_permute2f128_pd(ab_yw, cd_yw, 0x20),
          _mm256_permute2f128_pd(ab_xz, cd_xz, 0x31)};
}

/// (x + y) + z of the products.
SNIP_AVX2 inline __m256d products(const Columns& a, const Columns& b) {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)),
                       _mm256_mul_pd(a.z, b.z));
}

template <bool BothNodes>
SNIP_AVX2 void add_spring_forces(const SpringArrays& springs, const PaddedVector* positions,
                                 const PaddedVector* velocities, PaddedVector* forces) {
  const __m256d one = _mm256_set1_pd(1);
  const __m256d smallest = _mm256_set1_pd(smallest_squared_length);
  for (std::size_t i = 0; i < springs.nodes.size(); i += 4) {
    const auto* const nodes = &springs.nodes[i];
    const auto along = [&](std::size_t k) SNIP_AVX2 {
      return _mm256_sub_pd(load(positions[nodes[k][1]]), load(positions[nodes[k][0]]));
    };
    const auto rate_of = [&](std::size_t k) SNIP_AVX2 {
      return _mm256_sub_pd(load(velocities[nodes[k][1]]), load(velocities[nodes[k][0]]));
    };
    const __m256d d0 = along(0), d1 = along(1), d2 = along(2), d3 = along(3);
    const Columns d = columns(d0, d1, d2, d3);
    const __m256d squared = products(d, d);
    const __m256d length = _mm256_sqrt_pd(squared);
    const __m256d inverse_squared =
        _mm256_and_pd(_mm256_div_pd(one, squared), _mm256_cmp_pd(squared, smallest, _CMP_GE_OQ));
    const __m256d stretch = _mm256_mul_pd(_mm256_loadu_pd(&springs.stiffness[i]),
                                          _mm256_sub_pd(length, _mm256_loadu_pd(&springs.rest_length[i])));
    const Columns u = columns(rate_of(0), rate_of(1), rate_of(2), rate_of(3));
    const __m256d rate = _mm256_mul_pd(_mm256_loadu_pd(&springs.damping[i]), products(u, d));
    const __m256d scale = _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(stretch, length), rate), inverse_squared);
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
  const __m256d amount = _mm256_castsi256_pd(_mm256_set1_epi64x(0x7fffffffffffffff));
  __m256d sound = _mm256_cmp_pd(zero, zero, _CMP_EQ_OQ);
  for (std::size_t n = 0; n < inverse_mass.size(); ++n) {
    const __m256d inverse = _mm256_broadcast_sd(&inverse_mass[n]);
    const __m256d v = load(velocities[n]);
    const __m256d a = _mm256_add_pd(_mm256_mul_pd(load(forces[n]), inverse),
                                    _mm256_sub_pd(acceleration, _mm256_mul_pd(drag, v)));
    const __m256d free = _mm256_cmp_pd(inverse, zero, _CMP_GT_OQ);
    const __m256d next = _mm256_blendv_pd(v, _mm256_add_pd(v, _mm256_mul_pd(a, time_step)), free);
    sound = _mm256_and_pd(sound, _mm256_cmp_pd(_mm256_and_pd(next, amount), limit, _CMP_LE_OQ));
    store(forces[n], next);
  }
  return _mm256_movemask_pd(sound) == 0b1111;
}

SNIP_AVX2 void move(double time_step, std::span<PaddedVector> positions, const PaddedVector* velocities) {
  const __m256d factor = _mm256_set1_pd(time_step);
  for (std::size_t n = 0; n < positions.size(); ++n)
    store(positions[n], _mm256_add_pd(load(positions[n]), _mm256_mul_pd(load(velocities[n]), factor)));
}

}  // namespace

const Kernels& best_kernels() {
  static constexpr Kernels kernels{add_spring_forces<true>, add_spring_forces<false>, replace_by_velocities,
                                   move};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? kernels : portable_kernels();
}

}  // namespace cut
#else
namespace cut {
const Kernels& best_kernels() { return portable_kernels(); }
}  // namespace cut
#endif

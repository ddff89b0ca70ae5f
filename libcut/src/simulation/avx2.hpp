/// @file
/// What the loops for processors with AVX2 share: one node's vector in one register, or the same component of
/// four vectors side by side. Every sum is (x + y) + z, as in plain C++. For x86 only.
#pragma once
#include <immintrin.h>

#include "simulation/kernels.hpp"

#define SNIP_AVX2 __attribute__((target("avx2")))

namespace cut {

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

/// Four vectors one after the other.
SNIP_AVX2 inline Columns columns(const PaddedVector* v) {
  return columns(load(v[0]), load(v[1]), load(v[2]), load(v[3]));
}
SNIP_AVX2 inline void store(PaddedVector* to, const Columns& c) {
  const __m256d w = _mm256_setzero_pd();
  const __m256d xy02 = _mm256_unpacklo_pd(c.x, c.y), xy13 = _mm256_unpackhi_pd(c.x, c.y);
  const __m256d zw02 = _mm256_unpacklo_pd(c.z, w), zw13 = _mm256_unpackhi_pd(c.z, w);
  store(to[0], _mm256_permute2f128_pd(xy02, zw02, 0x20));
  store(to[1], _mm256_permute2f128_pd(xy13, zw13, 0x20));
  store(to[2], _mm256_permute2f128_pd(xy02, zw02, 0x31));
  store(to[3], _mm256_permute2f128_pd(xy13, zw13, 0x31));
}

/// (x + y) + z of the products.
SNIP_AVX2 inline __m256d products(const Columns& a, const Columns& b) {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)),
                       _mm256_mul_pd(a.z, b.z));
}

/// What the constants of four springs are read from.
struct SpringConstants {
  const double *rest_length, *stiffness, *damping;
};

/// The forces of four springs over the vectors along them.
SNIP_AVX2 inline __m256d forces_per_length(const Columns& along, const Columns& rates,
                                           const SpringConstants& springs) {
  const __m256d one = _mm256_set1_pd(1), smallest = _mm256_set1_pd(smallest_squared_length);
  const __m256d squared = products(along, along);
  const __m256d length = _mm256_sqrt_pd(squared);
  const __m256d inverse_squared =
      _mm256_and_pd(_mm256_div_pd(one, squared), _mm256_cmp_pd(squared, smallest, _CMP_GE_OQ));
  const __m256d stretch = _mm256_mul_pd(_mm256_loadu_pd(springs.stiffness),
                                        _mm256_sub_pd(length, _mm256_loadu_pd(springs.rest_length)));
  const __m256d rate = _mm256_mul_pd(_mm256_loadu_pd(springs.damping), products(rates, along));
  return _mm256_mul_pd(_mm256_add_pd(_mm256_mul_pd(stretch, length), rate), inverse_squared);
}

/// The bits of |x|.
SNIP_AVX2 inline __m256d amount(__m256d x) {
  return _mm256_and_pd(x, _mm256_castsi256_pd(_mm256_set1_epi64x(0x7fffffffffffffff)));
}

}  // namespace cut

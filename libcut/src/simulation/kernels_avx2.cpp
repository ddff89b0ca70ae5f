// The loops of one step for x86 processors with AVX2, which are looked for at run time: one node's vector is
// one register, and the lengths of four springs are found side by side. The order of every sum is that of
// kernels.cpp. Elsewhere the plain version is the best there is.
#include "simulation/kernels.hpp"

#include <algorithm>

#if defined(__x86_64__)
#include "simulation/avx2.hpp"
#include "simulation/diagonals.hpp"

namespace cut {
namespace {

SNIP_AVX2 inline __m256d between(const PaddedVector* vectors, std::size_t a, std::size_t b) {
  return _mm256_sub_pd(load(vectors[b]), load(vectors[a]));
}

template <bool BothNodes>
SNIP_AVX2 void add_spring_forces(std::span<const ListedSprings> springs, const PaddedVector* positions,
                                 const PaddedVector* velocities, PaddedVector* forces) {
  for (const auto& [nodes, four] : springs) {
    // Each index is read and multiplied once: a good part of the loop are indices.
    const std::size_t a0 = nodes[0][0], a1 = nodes[1][0], a2 = nodes[2][0], a3 = nodes[3][0];
    const std::size_t b0 = nodes[0][1], b1 = nodes[1][1], b2 = nodes[2][1], b3 = nodes[3][1];
    const __m256d d0 = between(positions, a0, b0), d1 = between(positions, a1, b1),
                  d2 = between(positions, a2, b2), d3 = between(positions, a3, b3);
    const Columns rates = columns(between(velocities, a0, b0), between(velocities, a1, b1),
                                  between(velocities, a2, b2), between(velocities, a3, b3));
    const __m256d scale =
        forces_per_length(columns(d0, d1, d2, d3), rates,
                          {four.rest_length.data(), four.stiffness.data(), four.damping.data()});
    const auto add = [&](std::size_t a, std::size_t b, __m256d force) SNIP_AVX2 {
      store(forces[a], _mm256_add_pd(load(forces[a]), force));
      if constexpr (BothNodes) store(forces[b], _mm256_sub_pd(load(forces[b]), force));
    };
    add(a0, b0, _mm256_mul_pd(d0, _mm256_permute4x64_pd(scale, 0x00)));
    add(a1, b1, _mm256_mul_pd(d1, _mm256_permute4x64_pd(scale, 0x55)));
    add(a2, b2, _mm256_mul_pd(d2, _mm256_permute4x64_pd(scale, 0xaa)));
    add(a3, b3, _mm256_mul_pd(d3, _mm256_permute4x64_pd(scale, 0xff)));
  }
}

SNIP_AVX2 bool advance_nodes(const VelocityUpdate& update, const NodeArrays& nodes, std::size_t first,
                             std::size_t last, std::span<const SlottedNode> others) {
  const __m256d time_step = _mm256_set1_pd(update.time_step);
  const __m256d acceleration = load(update.acceleration);
  const __m256d drag = _mm256_set1_pd(update.drag);
  const __m256d limit = _mm256_set1_pd(update.speed_limit);
  const __m256d zero = _mm256_setzero_pd();
  const bool moves = nodes.moves, old_first = update.old_first;
  const PaddedVector *const positions = nodes.positions, *const velocities = nodes.velocities;
  PaddedVector *const forces = nodes.forces, *const next_positions = nodes.next_positions;
  const double* const inverse_mass = nodes.inverse_mass_at_slots;
  __m256d sound = _mm256_cmp_pd(zero, zero, _CMP_EQ_OQ);
  const auto advance = [&](std::size_t n) SNIP_AVX2 {
    const __m256d inverse = _mm256_broadcast_sd(inverse_mass + n);
    const __m256d v = load(velocities[n]);
    const __m256d a = _mm256_add_pd(_mm256_mul_pd(load(forces[n]), inverse),
                                    _mm256_sub_pd(acceleration, _mm256_mul_pd(drag, v)));
    const __m256d free = _mm256_cmp_pd(inverse, zero, _CMP_GT_OQ);
    const __m256d next = _mm256_blendv_pd(v, _mm256_add_pd(v, _mm256_mul_pd(a, time_step)), free);
    sound = _mm256_and_pd(sound, _mm256_cmp_pd(amount(next), limit, _CMP_LE_OQ));
    store(forces[n], next);
    if (moves)
      store(next_positions[n],
            _mm256_add_pd(load(positions[n]), _mm256_mul_pd(old_first ? v : next, time_step)));
  };
  for (std::size_t n = first; n < last; ++n) advance(n);
  for (const SlottedNode& n : others) advance(n.slot);
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

SNIP_AVX2 inline __m256d vector_at(const double* x, const double* y, const double* z, std::size_t n) {
  const __m128d xy = _mm_loadh_pd(_mm_load_sd(x + n), y + n);
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(xy), _mm_load_sd(z + n), 1);
}

SNIP_AVX2 void gather(std::span<const SlottedNode> held, const NodeArrays& nodes) {
  const auto [px, py, pz] = nodes.position_columns;
  const auto [vx, vy, vz] = nodes.velocity_columns;
  PaddedVector *const positions = nodes.positions, *const velocities = nodes.velocities,
                      *const forces = nodes.forces;
  for (const auto [node, slot] : held) {
    store(positions[slot], vector_at(px, py, pz, node));
    store(velocities[slot], vector_at(vx, vy, vz, node));
    store(forces[slot], _mm256_setzero_pd());
  }
}

SNIP_AVX2 void scatter(std::span<const SlottedNode> held, const PaddedVector* forces,
                       const NodeRange& range) {
  const std::size_t first = range.first, size = (range.last - first + 3) / 4 * 4;
  const std::uint32_t* const fours = range.fours;
  for (const auto [node, slot] : held) {
    const std::size_t n = std::min(node - first, size), entry = fours[n / 4] + n % 4;
    double *const x = (*range.given)[0] + entry, *const y = (*range.given)[1] + entry,
                  *const z = (*range.given)[2] + entry;
    const __m256d force = load(forces[slot]);
    const __m128d xy = _mm256_castpd256_pd128(force);
    _mm_store_sd(x, _mm_add_sd(_mm_load_sd(x), xy));
    _mm_store_sd(y, _mm_add_sd(_mm_load_sd(y), _mm_unpackhi_pd(xy, xy)));
    _mm_store_sd(z, _mm_add_sd(_mm_load_sd(z), _mm256_extractf128_pd(force, 1)));
  }
}

}  // namespace

const Kernels& best_kernels() {
  static constexpr Kernels kernels{add_spring_forces<true>,
                                   add_spring_forces<false>,
                                   advance_nodes,
                                   move,
                                   advance_range_avx2,
                                   to_columns,
                                   from_columns,
                                   gather,
                                   scatter};
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? kernels : portable_kernels();
}

}  // namespace cut
#else
namespace cut {
const Kernels& best_kernels() { return portable_kernels(); }
}  // namespace cut
#endif

// The loops of an implicit step's solver. Each is written once, with vectors of four numbers that compilers
// know, and compiled twice: without and with the instructions of AVX2, which are looked for at run time.
#include "simulation/implicit_kernels.hpp"

#include <cstring>

#if defined(__x86_64__)
#include "simulation/avx2.hpp"  // SNIP_AVX2
#endif

#define SNIP_LOOP __attribute__((always_inline)) inline

namespace cut {
namespace {

using Four = double __attribute__((vector_size(32)));

// Vectors are passed by reference: by value they would need AVX on the way.
SNIP_LOOP void load(Four& to, const void* from) { std::memcpy(&to, from, sizeof to); }
SNIP_LOOP void store(void* to, const Four& from) { std::memcpy(to, &from, sizeof from); }

/// The components of four vectors side by side.
SNIP_LOOP void columns(const PaddedVector* v0, const PaddedVector* v1, const PaddedVector* v2,
                       const PaddedVector* v3, Four& x, Four& y, Four& z) {
  Four a, b, c, d;
  load(a, v0);
  load(b, v1);
  load(c, v2);
  load(d, v3);
  const Four ab_xz = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four cd_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four ab_yw = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd_yw = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  x = __builtin_shufflevector(ab_xz, cd_xz, 0, 1, 4, 5);
  y = __builtin_shufflevector(ab_yw, cd_yw, 0, 1, 4, 5);
  z = __builtin_shufflevector(ab_xz, cd_xz, 2, 3, 6, 7);
}

/// Four vectors one after the other.
SNIP_LOOP void store_columns(PaddedVector* to, const Four& x, const Four& y, const Four& z) {
  const Four w{};
  const Four xy02 = __builtin_shufflevector(x, y, 0, 4, 2, 6),
             xy13 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  const Four zw02 = __builtin_shufflevector(z, w, 0, 4, 2, 6),
             zw13 = __builtin_shufflevector(z, w, 1, 5, 3, 7);
  store(to, __builtin_shufflevector(xy02, zw02, 0, 1, 4, 5));
  store(to + 1, __builtin_shufflevector(xy13, zw13, 0, 1, 4, 5));
  store(to + 2, __builtin_shufflevector(xy02, zw02, 2, 3, 6, 7));
  store(to + 3, __builtin_shufflevector(xy13, zw13, 2, 3, 6, 7));
}

/// (px, py, pz) = block · (x, y, z)
SNIP_LOOP void times(const ImplicitWork::FourBlocks& block, const Four& x, const Four& y, const Four& z,
                     Four& px, Four& py, Four& pz) {
  Four xx, yy, zz, xy, yz, zx;
  load(xx, &block.values[0]);
  load(yy, &block.values[1]);
  load(zz, &block.values[2]);
  load(xy, &block.values[3]);
  load(yz, &block.values[4]);
  load(zx, &block.values[5]);
  px = (xx * x + xy * y) + zx * z;
  py = (xy * x + yy * y) + yz * z;
  pz = (zx * x + yz * y) + zz * z;
}

SNIP_LOOP double sum_of(const Four& s) { return (s[0] + s[1]) + (s[2] + s[3]); }

SNIP_LOOP double multiply_loop(const ImplicitWork& work, const PaddedVector* vector, PaddedVector* product,
                               std::size_t first, std::size_t last) {
  Four sum{};
  for (std::size_t i = first; i < last; ++i) {
    const PaddedVector* const own = vector + 4 * i;
    Four x, y, z, px, py, pz;
    columns(own, own + 1, own + 2, own + 3, x, y, z);
    times(work.blocks[i], x, y, z, px, py, pz);
    for (std::size_t s = work.row_begins[i]; s < work.row_begins[i + 1]; ++s) {
      const auto& other = work.others[s];
      const ImplicitWork::FourCouplings& c = work.couplings[s];
      Four ox, oy, oz, dx, dy, dz, along, across;
      columns(vector + other[0], vector + other[1], vector + other[2], vector + other[3], ox, oy, oz);
      load(dx, &c.x);
      load(dy, &c.y);
      load(dz, &c.z);
      load(along, &c.along);
      load(across, &c.across);
      const Four ux = x - ox, uy = y - oy, uz = z - oz;
      const Four part = along * ((dx * ux + dy * uy) + dz * uz);
      px += across * ux + part * dx;
      py += across * uy + part * dy;
      pz += across * uz + part * dz;
    }
    sum += (x * px + y * py) + z * pz;
    store_columns(product + 4 * i, px, py, pz);
  }
  return sum_of(sum);
}

SNIP_LOOP double advance_loop(ImplicitWork& work, double way, std::size_t first, std::size_t last) {
  Four sum{};
  for (std::size_t i = first; i < last; ++i) {
    for (std::size_t n = 4 * i; n < 4 * i + 4; ++n) {
      Four change, residual, direction, product;
      load(change, &work.change[n]);
      load(residual, &work.residual[n]);
      load(direction, &work.direction[n]);
      load(product, &work.product[n]);
      store(&work.change[n], change + way * direction);
      store(&work.residual[n], residual - way * product);
    }
    const PaddedVector* const r = &work.residual[4 * i];
    Four x, y, z, px, py, pz, inverse_mass;
    columns(r, r + 1, r + 2, r + 3, x, y, z);
    times(work.inverses[i], x, y, z, px, py, pz);
    store_columns(&work.preconditioned[4 * i], px, py, pz);
    load(inverse_mass, &work.inverse_mass[4 * i]);
    sum += inverse_mass * ((x * x + y * y) + z * z);
  }
  return sum_of(sum);
}

SNIP_LOOP void approach_loop(ImplicitWork& work, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const PaddedVector *const right = &work.right[4 * i], *const product = &work.product[4 * i],
                              *const reached = &work.direction[4 * i];
    Four x, y, z, ax, ay, az, px, py, pz;
    columns(right, right + 1, right + 2, right + 3, x, y, z);
    columns(product, product + 1, product + 2, product + 3, ax, ay, az);
    x -= ax;
    y -= ay;
    z -= az;
    store_columns(&work.residual[4 * i], x, y, z);
    times(work.inverses[i], x, y, z, px, py, pz);
    columns(reached, reached + 1, reached + 2, reached + 3, x, y, z);
    store_columns(&work.preconditioned[4 * i], x + 0.5 * px, y + 0.5 * py, z + 0.5 * pz);
  }
}

SNIP_LOOP void add_row(const WeightRows& rows, std::size_t row, const PaddedVector* from, Four& sum) {
  for (std::size_t k = rows.begins[row]; k < rows.begins[row + 1]; ++k) {
    Four v;
    load(v, from + rows.columns[k]);
    sum += rows.weights[k] * v;
  }
}

SNIP_LOOP double correct_loop(ImplicitWork& work, std::size_t first, std::size_t last) {
  const CoarseGrid& grid = work.grids.front();
  const std::size_t nodes = grid.to_finer.begins.size() - 1;
  Four sum{};
  for (std::size_t n = 4 * first; n < 4 * last && n < nodes; ++n) {
    if (!(work.inverse_mass[n] > 0)) continue;
    Four z, r;
    load(z, &work.preconditioned[n]);
    load(r, &work.residual[n]);
    add_row(grid.to_finer, n, grid.correction.data(), z);
    store(&work.preconditioned[n], z);
    sum += r * z;
  }
  return sum_of(sum);
}

SNIP_LOOP void turn_loop(ImplicitWork& work, double part, std::size_t first, std::size_t last) {
  for (std::size_t n = 4 * first; n < 4 * last; ++n) {
    Four direction, preconditioned;
    load(direction, &work.direction[n]);
    load(preconditioned, &work.preconditioned[n]);
    store(&work.direction[n], preconditioned + part * direction);
  }
}

SNIP_LOOP void add_weighted_loop(const WeightRows& rows, const PaddedVector* from, PaddedVector* to,
                                 std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    Four sum;
    load(sum, to + i);
    add_row(rows, i, from, sum);
    store(to + i, sum);
  }
}

struct Portable {
  static double multiply(const ImplicitWork& work, const PaddedVector* vector, PaddedVector* product,
                         std::size_t first, std::size_t last) {
    return multiply_loop(work, vector, product, first, last);
  }
  static double advance(ImplicitWork& work, double way, std::size_t first, std::size_t last) {
    return advance_loop(work, way, first, last);
  }
  static void approach(ImplicitWork& work, std::size_t first, std::size_t last) {
    approach_loop(work, first, last);
  }
  static double correct(ImplicitWork& work, std::size_t first, std::size_t last) {
    return correct_loop(work, first, last);
  }
  static void turn(ImplicitWork& work, double part, std::size_t first, std::size_t last) {
    turn_loop(work, part, first, last);
  }
  static void add_weighted(const WeightRows& rows, const PaddedVector* from, PaddedVector* to,
                           std::size_t first, std::size_t last) {
    add_weighted_loop(rows, from, to, first, last);
  }
  static constexpr ImplicitKernels all{multiply, advance, approach, correct, turn, add_weighted};
};

#if defined(__x86_64__)
struct Avx2 {
  SNIP_AVX2 static double multiply(const ImplicitWork& work, const PaddedVector* vector,
                                   PaddedVector* product, std::size_t first, std::size_t last) {
    return multiply_loop(work, vector, product, first, last);
  }
  SNIP_AVX2 static double advance(ImplicitWork& work, double way, std::size_t first, std::size_t last) {
    return advance_loop(work, way, first, last);
  }
  SNIP_AVX2 static void approach(ImplicitWork& work, std::size_t first, std::size_t last) {
    approach_loop(work, first, last);
  }
  SNIP_AVX2 static double correct(ImplicitWork& work, std::size_t first, std::size_t last) {
    return correct_loop(work, first, last);
  }
  SNIP_AVX2 static void turn(ImplicitWork& work, double part, std::size_t first, std::size_t last) {
    turn_loop(work, part, first, last);
  }
  SNIP_AVX2 static void add_weighted(const WeightRows& rows, const PaddedVector* from, PaddedVector* to,
                                     std::size_t first, std::size_t last) {
    add_weighted_loop(rows, from, to, first, last);
  }
  static constexpr ImplicitKernels all{multiply, advance, approach, correct, turn, add_weighted};
};
#endif

}  // namespace

const ImplicitKernels& portable_implicit_kernels() { return Portable::all; }

const ImplicitKernels& best_implicit_kernels() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  return has_avx2 ? Avx2::all : Portable::all;
#else
  return Portable::all;
#endif
}

}  // namespace cut

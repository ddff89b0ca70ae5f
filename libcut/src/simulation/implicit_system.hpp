/// @file
/// Arithmetic of an implicit step's system: 3×3 blocks of its diagonal, ranges of nodes that are gone through
/// at the same time, and sums over all of them.
#pragma once
#include <algorithm>
#include <vector>

#include "cut/executor.hpp"
#include "cut/implicit_work.hpp"
#include "simulation/padded.hpp"

namespace cut {

inline PaddedVector product(const SymmetricBlock& b, const PaddedVector& v) {
  return {b[0] * v.x + b[3] * v.y + b[5] * v.z, b[3] * v.x + b[1] * v.y + b[4] * v.z,
          b[5] * v.x + b[4] * v.y + b[2] * v.z, 0};
}

/// @pre positive definite
inline SymmetricBlock inverse(const SymmetricBlock& b) {
  const double xx = b[1] * b[2] - b[4] * b[4], xy = b[4] * b[5] - b[3] * b[2], zx = b[3] * b[4] - b[1] * b[5];
  const double factor = 1 / ((b[0] * xx + b[3] * xy) + b[5] * zx);
  return {factor * xx, factor * (b[0] * b[2] - b[5] * b[5]), factor * (b[0] * b[1] - b[3] * b[3]),
          factor * xy, factor * (b[3] * b[5] - b[0] * b[4]), factor * zx};
}

/// Adds factor · n·nᵀ.
inline void add_square(SymmetricBlock& block, double factor, const Eigen::Vector3d& n) {
  block[0] += factor * n.x() * n.x();
  block[1] += factor * n.y() * n.y();
  block[2] += factor * n.z() * n.z();
  block[3] += factor * n.x() * n.y();
  block[4] += factor * n.y() * n.z();
  block[5] += factor * n.z() * n.x();
}

inline SymmetricBlock block_of(const std::vector<ImplicitWork::FourBlocks>& blocks, std::size_t node) {
  SymmetricBlock block;
  for (std::size_t k = 0; k < 6; ++k) block[k] = blocks[node / 4].values[k][node % 4];
  return block;
}

inline void put_block(std::vector<ImplicitWork::FourBlocks>& blocks, std::size_t node,
                      const SymmetricBlock& block) {
  for (std::size_t k = 0; k < 6; ++k) blocks[node / 4].values[k][node % 4] = block[k];
}

/// Σ |v|²/m: of impulses, twice the energy that they give to nodes at rest.
inline double weighted_square(const std::vector<PaddedVector>& v, const std::vector<double>& inverse_mass) {
  double sum = 0;
  for (std::size_t n = 0; n < v.size(); ++n)
    sum += inverse_mass[n] * ((v[n].x * v[n].x + v[n].y * v[n].y) + v[n].z * v[n].z);
  return sum;
}

/// Calls body(range, first, last) for ranges of `count` things. How they are divided depends on their number
/// only, since sums do.
/// @param size  of a range, about
template <class Body>
void for_each_range(const Executor& executor, std::size_t count, std::size_t size, const Body& body) {
  const std::size_t pairs = (count + 2 * size - 1) / (2 * size);
  const std::size_t ranges = count <= size + size / 2 ? 1 : 2 * pairs;
  executor.for_each(ranges, [&](std::size_t r) { body(r, r * count / ranges, (r + 1) * count / ranges); });
}

/// So many fours of nodes are a range.
inline constexpr std::size_t range_size = 256;

/// The sum of body(first, last) over ranges of fours of nodes.
template <class Body>
double sum_over(const Executor& executor, ImplicitWork& work, const Body& body) {
  work.sums.assign(work.blocks.size() / range_size + 2, 0);
  for_each_range(
      executor, work.blocks.size(), range_size,
      [&](std::size_t r, std::size_t first, std::size_t last) { work.sums[r] = body(first, last); });
  double sum = 0;
  for (const double s : work.sums) sum += s;
  return sum;
}

}  // namespace cut

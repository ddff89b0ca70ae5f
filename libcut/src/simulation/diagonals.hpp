/// @file
/// A step of the nodes of a block whose springs stand in diagonals (equations 1 to 6). In: positions and
/// velocities of all uncut nodes, and other forces. Out: what is next for the nodes of the block.
///
/// With each component in an array of its own, a column, four springs are found in whole registers that need
/// no indices. Forces are written down and summed up afterwards: to add each to both of its nodes at once
/// would take most of the time.
#pragma once
#include <algorithm>
#include <vector>

#include "simulation/kernels.hpp"

namespace cut {

/// How far columns of positions and velocities are read behind the last node: zeros.
[[nodiscard]] inline std::size_t reach_of(const SpringBlock& block) {
  std::size_t reach = 0;
  for (const SpringDiagonal& d : block.diagonals) reach = std::max<std::size_t>(reach, d.offset);
  return (reach + 7) / 4 * 4;
}

/// Whole cache lines, and so many that columns are not all at the same place of a page, which caches go by.
[[nodiscard]] inline std::size_t column_stride(std::size_t size) { return (size + 511) / 512 * 512 + 56; }

/// Columns side by side in `space`, which grows as needed.
class ColumnSpace {
 public:
  ColumnSpace(std::vector<CacheLine>& space, std::size_t triples, std::size_t size)
      : stride_(column_stride(size)) {
    const std::size_t lines = 3 * triples * stride_ / CacheLine{}.values.size();
    if (space.size() < lines) space.resize(lines);
    next_ = space.data()->values.data();
  }
  [[nodiscard]] ColumnArrays take() {
    const ColumnArrays result{next_, next_ + stride_, next_ + 2 * stride_};
    next_ += 3 * stride_;
    return result;
  }

 private:
  std::size_t stride_;
  double* next_;
};

/// Forces of springs that start at a node, at that node: columns in which node n is at n + shift.
struct BlockForces {
  std::ptrdiff_t shift = 0;
  std::size_t count = 0;  ///< of diagonals
  std::array<std::ptrdiff_t, most_diagonals> offsets{};
  std::array<ColumnArrays, most_diagonals> columns{};
  ColumnArrays given{};  ///< space for the forces that a node begins with

  [[nodiscard]] std::ptrdiff_t at(std::size_t node) const {
    return static_cast<std::ptrdiff_t>(node) + shift;
  }
};

/// Forces are found and summed up for so many nodes in turn, and kept for twice as many, so that they are
/// still in a near cache.
inline constexpr std::size_t nodes_at_once = 1024;

/// @tparam Loops  in diagonals.cpp and diagonals_avx2.cpp
template <class Loops>
bool advance_block(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                   const NodeArrays& nodes) {
  const std::size_t first = block.first, last = block.last, end = (last + 3) / 4 * 4;
  const std::size_t reach = reach_of(block);
  thread_local std::vector<CacheLine> own;
  BlockForces forces;
  forces.count = block.diagonals.size();
  forces.shift = static_cast<std::ptrdiff_t>(reach) - static_cast<std::ptrdiff_t>(first);
  const std::size_t kept = std::min(end - first, 2 * nodes_at_once) + reach;
  ColumnSpace space(own, forces.count + 1, kept);
  forces.given = space.take();
  for (std::size_t k = 0; k < forces.count; ++k) {
    forces.offsets[k] = block.diagonals[k].offset;
    forces.columns[k] = space.take();
    // No spring comes from before node 0.
    if (first < block.diagonals[k].offset)
      for (double* column : forces.columns[k]) std::fill_n(column, forces.at(0), 0.0);
  }
  bool sound = true;
  for (std::size_t from = first; from < end; from += nodes_at_once) {
    const std::size_t to = std::min(from + nodes_at_once, end);
    if (forces.at(to) > static_cast<std::ptrdiff_t>(kept)) {  // what is still needed goes to the front
      for (std::size_t k = 0; k < forces.count; ++k)
        for (double* column : forces.columns[k]) std::copy_n(column + (kept - reach), reach, column);
      forces.shift = static_cast<std::ptrdiff_t>(reach) - static_cast<std::ptrdiff_t>(from);
    }
    for (std::size_t k = 0; k < forces.count; ++k) {
      const SpringDiagonal& d = block.diagonals[k];
      Loops::find_forces(d, from == first ? d.first : from, to, nodes, forces.shift, forces.columns[k]);
    }
    sound &= Loops::finish(update, begun, from, std::min(to, last), forces, nodes);
  }
  return sound;
}

/// `Loops::finish` in plain C++, for what is left of four nodes.
bool finish_portable(const VelocityUpdate* update, bool begun, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes);
bool advance_block_portable(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                            const NodeArrays& nodes);
bool advance_block_avx2(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                        const NodeArrays& nodes);

}  // namespace cut

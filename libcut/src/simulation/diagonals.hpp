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

/// So that columns are not all at the same place of a page, which caches go by.
[[nodiscard]] inline std::size_t column_stride(std::size_t size) { return (size + 511) / 512 * 512 + 56; }

/// Columns side by side in `space`, which grows as needed.
class ColumnSpace {
 public:
  ColumnSpace(std::vector<double>& space, std::size_t triples, std::size_t size)
      : stride_(column_stride(size)) {
    if (space.size() < 3 * triples * stride_) space.resize(3 * triples * stride_);
    next_ = space.data();
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

/// Sums and forces of a block: columns in which node n is at n + shift.
struct BlockColumns {
  std::ptrdiff_t shift;
  ColumnArrays sums;
  std::array<ColumnArrays, most_diagonals> forces;  ///< of the springs that start at a node, at that node

  [[nodiscard]] std::ptrdiff_t at(std::size_t node) const {
    return static_cast<std::ptrdiff_t>(node) + shift;
  }
};

/// @tparam Loops  in diagonals.cpp and diagonals_avx2.cpp
template <class Loops>
bool advance_block(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                   const NodeArrays& nodes) {
  const std::size_t diagonals = block.diagonals.size(), reach = reach_of(block);
  const std::size_t first = block.first, last = block.last, end = (last + 3) / 4 * 4;
  thread_local std::vector<double> own;
  ColumnSpace space(own, 1 + diagonals, end - first + reach);
  BlockColumns columns;
  columns.shift = static_cast<std::ptrdiff_t>(reach) - static_cast<std::ptrdiff_t>(first);
  columns.sums = space.take();
  for (std::size_t k = 0; k < diagonals; ++k) {
    columns.forces[k] = space.take();
    // No spring comes from before node 0.
    if (first < block.diagonals[k].offset)
      for (double* column : columns.forces[k]) std::fill_n(column, columns.at(0), 0.0);
  }
  bool sound = true;
  constexpr std::size_t piece = 1024;  // columns stay in the nearest cache from loop to loop
  for (std::size_t from = first; from < end; from += piece) {
    const std::size_t to = std::min(from + piece, end);
    for (std::size_t k = 0; k < diagonals; ++k) {
      const SpringDiagonal& d = block.diagonals[k];
      Loops::find_forces(d, from == first ? d.first : from, to, nodes, columns.shift, columns.forces[k]);
      Loops::sum_up(k == 0, d.offset, columns.at(from), columns.at(to), columns.forces[k], columns.sums);
    }
    sound &= Loops::finish(update, begun, from, std::min(to, last), columns.sums, columns.shift, nodes);
  }
  return sound;
}

/// `Loops::finish` in plain C++, for what is left of four nodes.
bool finish_portable(const VelocityUpdate* update, bool begun, std::size_t from, std::size_t to,
                     const ColumnArrays& sums, std::ptrdiff_t shift, const NodeArrays& nodes);
bool advance_block_portable(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                            const NodeArrays& nodes);
bool advance_block_avx2(const SpringBlock& block, const VelocityUpdate* update, bool begun,
                        const NodeArrays& nodes);

}  // namespace cut

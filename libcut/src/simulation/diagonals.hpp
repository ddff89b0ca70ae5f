/// @file
/// A step of nodes next to each other whose springs stand in diagonals (equations 1 to 6). In: positions and
/// velocities of all nodes, and other forces. Out: what is next for these.
///
/// With each component in an array of its own, a column, four springs are found in whole registers that need
/// no indices. Forces are written down and summed up afterwards: to add each to both of its nodes at once
/// would take most of the time.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "simulation/kernels.hpp"

namespace cut {

/// How far columns of positions and velocities are read behind the last node: numbers that are finite.
[[nodiscard]] inline std::size_t reach_of(std::span<const SpringDiagonal> diagonals) {
  std::size_t reach = 0;
  for (const SpringDiagonal& d : diagonals) reach = std::max<std::size_t>(reach, d.offset);
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

/// Forces of springs that start at a node, at that node, in columns: where to find those for node n.
struct BlockForces {
  std::size_t count = 0;  ///< of diagonals
  std::array<ColumnArrays, most_diagonals> columns{};
  std::ptrdiff_t starting = 0;                          ///< at node n: in entry n + this
  std::array<std::ptrdiff_t, most_diagonals> ending{};  ///< that end at node n: in entry n + this
};

/// Forces are found and summed up for so many nodes in turn, so that they are still in a near cache.
inline constexpr std::size_t nodes_at_once = 2048;

/// The forces that are kept while one range after the other is gone through: of the last `size` nodes, the
/// columns being rings. Four springs are taken at once, so the first ones stand once more behind the last.
class ForceWindow {
 public:
  BlockForces forces;

  /// Makes ready for the forces of springs at nodes from `first` on. Returns whether those of springs that
  /// come from before are there already.
  bool open(std::span<const SpringDiagonal> diagonals, std::size_t first) {
    if (first == next_ && diagonals.data() == diagonals_.data()) return true;
    diagonals_ = diagonals;
    size_ = reach_of(diagonals) + nodes_at_once;
    ColumnSpace space(space_, diagonals.size(), size_ + 4);
    forces.count = diagonals.size();
    for (std::size_t k = 0; k < forces.count; ++k) {
      forces.columns[k] = space.take();
      // No spring comes from before node 0.
      if (first < diagonals[k].offset)
        for (double* column : forces.columns[k])
          std::fill_n(column + (size_ - diagonals[k].offset), diagonals[k].offset, 0.0);
    }
    return false;
  }
  /// Makes room for nodes from here on. Returns up to which, at most `to`.
  std::size_t start_at(std::size_t from, std::size_t to) {
    forces.starting = shift(from, 0);
    return std::min(to, from + (size_ - from % size_));
  }
  /// Those of a diagonal have been found for nodes from here on.
  void repeat_first(std::size_t diagonal, std::size_t from) {
    if (from % size_ != 0) return;
    for (double* column : forces.columns[diagonal]) std::copy_n(column, 4, column + size_);
  }
  /// Makes the springs known that end at nodes from here on. Returns up to which, at most `to`.
  std::size_t end_at(std::size_t from, std::size_t to) {
    for (std::size_t k = 0; k < forces.count; ++k) {
      forces.ending[k] = shift(from, diagonals_[k].offset);
      const std::size_t entry =
          static_cast<std::size_t>(static_cast<std::ptrdiff_t>(from) + forces.ending[k]);
      to = std::min(to, from + (size_ - entry + 3) / 4 * 4);
    }
    return to;
  }
  /// @param next  the node that would follow
  void close(std::size_t next = none) { next_ = next; }
  static constexpr std::size_t none = ~std::size_t{0};

 private:
  /// From node n to the entry of node n - offset.
  [[nodiscard]] std::ptrdiff_t shift(std::size_t n, std::size_t offset) const {
    const std::size_t entry = (n + size_ - offset) % size_;
    return static_cast<std::ptrdiff_t>(entry) - static_cast<std::ptrdiff_t>(n);
  }

  std::span<const SpringDiagonal> diagonals_;
  std::vector<CacheLine> space_;
  std::size_t size_ = 0, next_ = none;
};

/// @tparam Loops  in diagonals.cpp and diagonals_avx2.cpp
template <class Loops>
bool advance_range(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                   ForceWindow& window) {
  const std::size_t last = range.last, end = (last + 3) / 4 * 4;
  const auto find = [&](std::size_t k, std::size_t from, std::size_t to) {
    while (from < to) {
      const std::size_t stop = window.start_at(from, to);
      Loops::find_forces(range.diagonals[k], from, stop, nodes, window.forces.starting,
                         window.forces.columns[k]);
      window.repeat_first(k, from);
      from = stop;
    }
  };
  if (!window.open(range.diagonals, range.first))
    for (std::size_t k = 0; k < range.diagonals.size(); ++k)
      find(k, (range.first - std::min<std::size_t>(range.first, range.diagonals[k].offset)) / 4 * 4,
           range.first);
  bool sound = true;
  for (std::size_t from = range.first; from < end;) {
    const std::size_t to = window.start_at(from, std::min(from + nodes_at_once, end));
    for (std::size_t k = 0; k < range.diagonals.size(); ++k) find(k, from, to);
    const std::size_t stop = std::min(to, last);
    while (from < stop) {
      const std::size_t piece = window.end_at(from, stop);
      sound &= Loops::finish(range, update, from, piece, window.forces, nodes);
      from = piece;
    }
    from = to;
  }
  window.close(last == end ? last : ForceWindow::none);
  return sound;
}

/// `Loops::finish` in plain C++, for what is left of four nodes.
bool finish_portable(const NodeRange& range, const VelocityUpdate* update, std::size_t from, std::size_t to,
                     const BlockForces& forces, const NodeArrays& nodes);
bool advance_range_portable(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                            ForceWindow& window);
bool advance_range_avx2(const NodeRange& range, const VelocityUpdate* update, const NodeArrays& nodes,
                        ForceWindow& window);

}  // namespace cut

/// @file
/// A node of the tree (§5.1): its volume, its split plane, its lower, higher and centric child, and the tight
/// box of each child, laid out so that the three are tested at once.
#pragma once
#include <cstddef>
#include <cstdint>

#include "../box.hpp"
#include "cell.hpp"

namespace spatial::detail {

/// A child: nothing, a node or a leaf, by its index.
struct ChildRef {
  static constexpr std::uint32_t leaf_bit = 0x80000000u;
  /// Used by searches for what needs no further test.
  static constexpr std::uint32_t inside_bit = 0x40000000u;
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t bits = none;

  static constexpr ChildRef node(std::uint32_t index) { return {index}; }
  static constexpr ChildRef leaf(std::uint32_t index) { return {index | leaf_bit}; }
  [[nodiscard]] constexpr bool empty() const { return bits == none; }
  [[nodiscard]] constexpr bool is_node() const { return bits < inside_bit; }
  [[nodiscard]] constexpr bool is_leaf() const { return (bits & leaf_bit) != 0; }  ///< @pre !empty()
  [[nodiscard]] constexpr bool is_inside() const { return (bits & inside_bit) != 0; }
  [[nodiscard]] constexpr std::uint32_t index() const { return bits & ~(leaf_bit | inside_bit); }
  friend constexpr bool operator==(ChildRef, ChildRef) = default;
};

/// On cache lines of its own, with the rows first: a query reads these and the children, an insertion the
/// children and the plane. Wide reads run past the end of a row, and of the last one into the children.
template <class T, std::size_t D>
struct alignas(64) Node {
  static constexpr std::size_t lanes = 3;  ///< the children

  T rows[2 * D][lanes];  ///< tight boxes: min[row] of each child for row < D, then max[row - D]
  ChildRef child[3];
  T plane{};
  std::uint8_t axis = 0;
  std::uint8_t side = 0;  ///< which child of the parent
  /// The volume is smaller than the parent's child volume: volumes that would have had one child were left
  /// out.
  bool compressed = false;
  std::uint32_t parent = 0;  ///< the next free node while this one is free
  Cell<T, D> cell;

  [[nodiscard]] Split<T, D> split() const { return {axis, plane}; }
  [[nodiscard]] Side side_of(const Box<T, D>& box) const {
    return detail::side_of(box.min[axis], box.max[axis], plane);
  }
  [[nodiscard]] Box<T, D> child_box(std::size_t side_index) const {
    Box<T, D> box;
    for (std::size_t a = 0; a < D; ++a) {
      box.min[a] = rows[a][side_index];
      box.max[a] = rows[D + a][side_index];
    }
    return box;
  }
  void set_child_box(std::size_t side_index, const Box<T, D>& box) {
    for (std::size_t a = 0; a < D; ++a) {
      rows[a][side_index] = box.min[a];
      rows[D + a][side_index] = box.max[a];
    }
  }
  /// An empty child has the empty box, which adds nothing.
  [[nodiscard]] Box<T, D> bounds() const {
    Box<T, D> result = child_box(0);
    extend(result, child_box(1));
    extend(result, child_box(2));
    return result;
  }
};

}  // namespace spatial::detail

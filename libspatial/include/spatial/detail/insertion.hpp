/// @file
/// Finds the place of a box (§5.1), and makes it where there is none. In: a tree, a box and its slot. Out: a
/// place in a leaf that lacks nothing but the value.
#pragma once
#include <cstddef>
#include <cstdint>

#include "split_leaf.hpp"
#include "tight_boxes.hpp"
#include "tree_storage.hpp"

namespace spatial::detail {

template <class T, std::size_t D>
void extend_by_cell(Box<T, D>& box, const Cell<T, D>& cell) {
  for (std::size_t a = 0; a < D; ++a) {
    if (!cell.is_divisible(a)) continue;
    box.min[a] = cell.box.min[a] < box.min[a] ? cell.box.min[a] : box.min[a];
    box.max[a] = cell.box.max[a] > box.max[a] ? cell.box.max[a] : box.max[a];
  }
}

template <class Tree>
std::uint32_t attach_new_leaf(Tree& tree, std::uint32_t parent, std::uint32_t side,
                              const TreeBox<Tree>& box) {
  const std::uint32_t index =
      tree.new_leaf(Tree::least_capacity, is_point(box) ? Tree::dimension : 2 * Tree::dimension);
  TreeBox<Tree> room = box;  // likely to hold what will come
  if (parent != Tree::none) extend_by_cell(room, tree.link_cell(parent, side));
  tree.leaf(index).set_frame(Tree::FrameType::around(room));
  tree.attach_leaf(index, parent, side);
  return index;
}

template <class Tree>
Slot append(Tree& tree, std::uint32_t index, const TreeBox<Tree>& box, std::uint32_t id) {
  typename Tree::LeafType& target = tree.leaf(index);
  const bool widen = target.is_flat() && !is_point(box);
  if (target.count == target.capacity || widen || !target.has_ids) {
    tree.enlarge_leaf(
        index, target.count == target.capacity ? Tree::capacity_for(target.count + 1) : target.capacity,
        widen ? 2 * Tree::dimension : target.rows);
  }
  if (target.has_old_frame()) target.make_new_frame(tree.link_box(target.parent, target.side));
  const std::uint32_t end = target.count++;
  target.set_box(end, box);
  target.ids()[end] = id;
  extend_up(tree, target.parent, target.side, box);
  return {index, end, 0};
}

/// Halves `cell` until a plane lies between `inner`, which is one of its parts, and `box`.
template <class T, std::size_t D>
Split<T, D> separate(Cell<T, D>& cell, const Cell<T, D>& inner, const Box<T, D>& box, Side& inner_side,
                     bool& compressed) {
  for (;;) {
    const Split<T, D> at = cell.split();
    if (!at.exists()) break;
    inner_side = side_of(inner.box.min[at.axis], inner.box.max[at.axis], at.plane);
    if (inner_side == centric) break;
    if (side_of(box.min[at.axis], box.max[at.axis], at.plane) != inner_side) return at;
    cell = cell.child(at, inner_side);
    compressed = true;
  }
  // Where the root grew with rounding, the halves do not meet the old planes to the bit. Then a border will
  // do.
  for (std::size_t a = 0; a < D; ++a) {
    if (!cell.is_divisible(a)) continue;
    inner_side = higher;
    if (side_of(box.min[a], box.max[a], inner.box.min[a]) != higher) return {a, inner.box.min[a]};
    inner_side = lower;
    if (side_of(box.min[a], box.max[a], inner.box.max[a]) != lower) return {a, inner.box.max[a]};
  }
  return {0, inner.box.min[0]};  // not reached: the box is outside of the inner cell
}

/// Puts a node between `below` and its parent, so that `box`, which is outside of the volume of `below`, has
/// a place.
template <class Tree>
std::uint32_t insert_node_above(Tree& tree, std::uint32_t below, const TreeBox<Tree>& box) {
  const std::uint32_t parent = tree.node(below).parent;
  const std::uint32_t parent_side = tree.node(below).side;
  const std::uint32_t above = tree.new_node();
  const TreeCell<Tree> inner = tree.node(below).cell;
  typename Tree::NodeType& fresh = tree.node(above);
  Side below_side = lower;
  TreeSplit<Tree> at;
  bool compressed = false;
  TreeCell<Tree> cell = inner;
  if (parent == Tree::none) {
    at = cell.grow_to_hold(box, below_side);
  } else {
    cell = tree.link_cell(parent, parent_side);
    at = separate(cell, inner, box, below_side, compressed);
  }
  fresh.cell = cell;
  fresh.plane = at.plane;
  fresh.axis = static_cast<std::uint8_t>(at.axis);
  fresh.compressed = compressed;
  const TreeBox<Tree> tight = tree.link_box(parent, parent_side);
  tree.attach_node(above, parent, parent_side);
  for (std::size_t s = 0; s < Tree::NodeType::lanes; ++s) fresh.set_child_box(s, no_box<Tree>());
  fresh.set_child_box(below_side, tight);
  tree.attach_node(below, above, below_side);
  const TreeCell<Tree> full = cell.child(at, below_side);
  tree.node(below).compressed = !(full.box == inner.box && full.divisible == inner.divisible);
  return above;
}

/// The same for a box that is outside of the volume of a node.
template <class Tree>
Slot append_above(Tree& tree, std::uint32_t node, const TreeBox<Tree>& box, std::uint32_t id) {
  const std::uint32_t above = insert_node_above(tree, node, box);
  return append(tree, attach_new_leaf(tree, above, tree.node(above).side_of(box), box), box, id);
}

/// Finds or makes the place for a box and enters it there with its slot index. The value is still missing.
template <class Tree>
Slot make_room(Tree& tree, const TreeBox<Tree>& box, std::uint32_t id) {
  tree.drop_overview();
  std::uint32_t parent = Tree::none;
  std::uint32_t side = 0;
  ChildRef here = tree.root();
  if (here.is_node() && !encloses(tree.root_box(), box) && !tree.node(here.index()).cell.holds(box))
    return append_above(tree, here.index(), box, id);
  for (;;) {
    if (!here.is_node()) {
      if (here.empty()) return append(tree, attach_new_leaf(tree, parent, side, box), box, id);
      const std::uint32_t index = here.index();
      const typename Tree::LeafType& there = tree.leaf(index);
      if (there.count < Tree::leaf_limit ||
          (there.indivisible && encloses(tree.link_box(parent, side), box)) ||
          !split_leaf(tree, index, box)) {
        return append(tree, index, box, id);
      }
      here = tree.link(parent, side);
      continue;
    }
    const typename Tree::NodeType& node = tree.node(here.bits);
    if (node.compressed && !node.cell.holds(box)) return append_above(tree, here.bits, box, id);
    parent = here.bits;
    // Branches: half of the guesses are wrong, but a right one starts on the next node at once.
    if (box.max[node.axis] <= node.plane) {
      side = lower;
      here = node.child[lower];
    } else if (box.min[node.axis] >= node.plane) {
      side = higher;
      here = node.child[higher];
    } else {
      side = centric;
      here = node.child[centric];
    }
  }
}

}  // namespace spatial::detail

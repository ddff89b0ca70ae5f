/// @file
/// Takes an element out of a tree, and nodes that are not needed any more. In: a tree and a place. Out: a
/// smaller tree; nothing here allocates, since erasing must not fail.
#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

#include "tight_boxes.hpp"
#include "tree_storage.hpp"

namespace spatial::detail {

/// Moves everything below a node of leaves into the first leaf that has the capacity. No allocation: erasing
/// must not fail.
template <class Tree>
bool merge_into_first(Tree& tree, std::uint32_t index) {
  typename Tree::NodeType& node = tree.node(index);
  std::uint32_t total = 0;
  std::uint32_t target = Tree::none;
  bool flat = true;
  for (const ChildRef child : node.child) {
    if (child.empty()) continue;
    total += tree.leaf(child.index()).count;
    flat &= tree.leaf(child.index()).is_flat();
    if (!tree.leaf(child.index()).has_ids) return false;
  }
  for (const ChildRef child : node.child) {
    if (child.empty()) continue;
    const typename Tree::LeafType& leaf = tree.leaf(child.index());
    if (leaf.capacity >= total && leaf.is_flat() == flat) target = child.index();
  }
  if (target == Tree::none) return false;
  tree.drop_overview();
  typename Tree::LeafType& home = tree.leaf(target);
  const typename Tree::Arrays to(home);
  for (const ChildRef child : node.child) {
    if (child.empty() || child.index() == target) continue;
    typename Tree::LeafType& from = tree.leaf(child.index());
    const typename Tree::Arrays old(from);
    for (std::uint32_t i = 0; i < from.count; ++i) tree.move_element(old, i, home, to, target);
    from.count = 0;
    tree.free_leaf(child.index());
  }
  home.indivisible = false;
  home.loose = 0;
  home.make_new_frame(home.bounds());
  tree.attach_leaf(target, node.parent, node.side);
  return true;
}

/// Removes nodes that are not needed any more: without children, with one child, or with few elements in
/// leaves.
template <class Tree>
void simplify(Tree& tree, std::uint32_t index) {
  while (index != Tree::none) {
    typename Tree::NodeType& node = tree.node(index);
    const std::uint32_t parent = node.parent;
    const std::uint32_t side = node.side;
    int children = 0;
    std::uint32_t only = 0;
    std::uint32_t total = 0;
    bool leaves_only = true;
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (node.child[s].empty()) continue;
      ++children;
      only = s;
      if (node.child[s].is_leaf()) {
        total += tree.leaf(node.child[s].index()).count;
      } else {
        leaves_only = false;
      }
    }
    if (children == 0) {
      tree.link(parent, side) = {};
      tree.set_link_box(parent, side, no_box<Tree>());
      tree.free_node(index);
      if (parent != Tree::none) tighten_up(tree, tree.node(parent).parent, tree.node(parent).side);
    } else if (children == 1 &&
               (only != centric || (node.child[only].is_leaf() && total <= Tree::leaf_limit))) {
      const ChildRef child = node.child[only];
      if (child.is_leaf()) {
        tree.attach_leaf(child.index(), parent, side);
      } else {
        tree.attach_node(child.index(), parent, side);
        tree.node(child.index()).compressed = true;
      }
      tree.free_node(index);
    } else if (leaves_only && total <= Tree::leaf_limit / 2 && merge_into_first(tree, index)) {
      tree.free_node(index);
    } else {
      return;
    }
    index = parent;
  }
}

/// Removes what is at `where`. Its value has been moved away but not destroyed. Slots of others are kept
/// right.
template <class Tree>
void remove_at(Tree& tree, const Slot& where) {
  typename Tree::LeafType& home = tree.leaf(where.leaf);
  const TreeBox<Tree> removed = home.box(where.position);
  const std::uint32_t last = home.count - 1;
  using Value = typename Tree::ValueType;
  Value* values = home.values();
  if (!home.has_ids) {
    // The order tells the ids, so it stays.
    home.set_gone(home.id(where.position));
    for (std::uint32_t i = where.position; i < last; ++i) {
      home.copy_box(i + 1, i);
      values[i].~Value();
      ::new (static_cast<void*>(values + i)) Value(std::move(values[i + 1]));
      if (tree.has_slots()) tree.slot(home.id(i)).position = i;
    }
  } else if (where.position != last) {
    home.copy_box(last, where.position);
    const std::uint32_t moved = home.ids()[last];
    home.ids()[where.position] = moved;
    tree.slot(moved).position = where.position;
    values[where.position].~Value();
    ::new (static_cast<void*>(values + where.position)) Value(std::move(values[last]));
  }
  values[last].~Value();
  home.count = last;
  const std::uint32_t parent = home.parent;
  if (last == 0) {
    const std::uint32_t side = home.side;
    tree.link(parent, side) = {};
    tree.set_link_box(parent, side, no_box<Tree>());
    tree.free_leaf(where.leaf);
    if (parent != Tree::none) {
      tighten_up(tree, tree.node(parent).parent, tree.node(parent).side);
      simplify(tree, parent);
    }
    return;
  }
  const TreeBox<Tree> tight = tree.link_box(parent, home.side);
  if (!is_inside(tight, removed)) shrink_leaf(tree, where.leaf);
  if (parent != Tree::none && last <= Tree::leaf_limit / 4) simplify(tree, parent);
}

}  // namespace spatial::detail

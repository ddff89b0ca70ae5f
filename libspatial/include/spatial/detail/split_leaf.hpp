/// @file
/// Splits a leaf that is full (§5.1, figure 7). In: a leaf. Out: a node with up to three leaves in its place.
#pragma once
#include <cstddef>
#include <cstdint>

#include "tight_boxes.hpp"
#include "tree_storage.hpp"

namespace spatial::detail {

/// Takes back a node and leaves that were made for a split that failed.
template <class Tree>
struct Undo {
  Tree* tree;
  std::uint32_t node;
  const std::uint32_t* leaves;
  ~Undo() {
    if (tree == nullptr) return;
    for (int s = 0; s < 3; ++s) {
      if (leaves[s] != Tree::none) tree->free_leaf(leaves[s]);
    }
    tree->free_node(node);
  }
};

/// Distributes a leaf's elements among three new leaves (§5.1, figure 7), so that `incoming` finds a place
/// too. False if no plane can separate them.
template <class Tree>
bool split_leaf(Tree& tree, std::uint32_t index, const TreeBox<Tree>& incoming) {
  const std::uint32_t parent = tree.leaf(index).parent;
  const std::uint32_t side = tree.leaf(index).side;
  if (tree.leaf(index).loose > 0) tighten_leaf(tree, index);
  TreeBox<Tree> tight = tree.link_box(parent, side);
  extend(tight, incoming);
  TreeCell<Tree> cell =
      parent == Tree::none ? TreeCell<Tree>::cube_around(tight, true) : tree.link_cell(parent, side);
  bool compressed = false;
  TreeSplit<Tree> at;
  for (;;) {
    at = cell.split();
    if (!at.exists()) {
      tree.leaf(index).indivisible = true;
      return false;
    }
    const Side all = side_of(tight.min[at.axis], tight.max[at.axis], at.plane);
    if (all == centric) break;
    cell = cell.child(at, all);
    compressed = true;
  }
  if (!tree.leaf(index).has_ids) tree.enlarge_leaf(index, tree.leaf(index).capacity, tree.leaf(index).rows);
  std::uint32_t counts[3] = {0, 0, 0};
  const auto boxes = tree.leaf(index).boxes();
  for (std::uint32_t i = 0; i < tree.leaf(index).count; ++i) {
    ++counts[boxes.side(i, at)];
  }
  // Half of a volume may do with half of the levels, once on each axis.
  const bool same_frame = tree.leaf(index).frame_age < Tree::dimension && !tree.leaf(index).has_old_frame();
  const std::uint32_t made = tree.new_node();
  // The new leaves hang at the node before the old one is touched, so that a failing allocation loses
  // nothing.
  std::uint32_t leaves[3] = {Tree::none, Tree::none, Tree::none};
  Undo<Tree> undo{&tree, made, leaves};
  for (std::uint32_t s = 0; s < 3; ++s) {
    if (counts[s] == 0) continue;
    leaves[s] = tree.new_leaf(Tree::capacity_for(counts[s]), tree.leaf(index).rows);
    if (same_frame) tree.leaf(leaves[s]).inherit_frame(tree.leaf(index));
  }
  undo.tree = nullptr;
  typename Tree::NodeType& node = tree.node(made);
  node.cell = cell;
  node.plane = at.plane;
  node.axis = static_cast<std::uint8_t>(at.axis);
  node.compressed = compressed;
  for (std::size_t s = 0; s < Tree::NodeType::lanes; ++s) node.set_child_box(s, no_box<Tree>());
  typename Tree::LeafType& old = tree.leaf(index);
  typename Tree::LeafType* targets[3];
  for (std::uint32_t s = 0; s < 3; ++s) targets[s] = &tree.leaf(leaves[s] == Tree::none ? index : leaves[s]);
  using Arrays = typename Tree::Arrays;
  const Arrays from(old);
  const Arrays to[3] = {Arrays(*targets[0]), Arrays(*targets[1]), Arrays(*targets[2])};
  for (std::uint32_t i = 0; i < old.count; ++i) {
    const Side s = boxes.side(i, at);
    tree.move_element(from, i, *targets[s], to[s], leaves[s]);
  }
  old.count = 0;
  tree.free_leaf(index);
  tree.attach_node(made, parent, side);
  for (std::uint32_t s = 0; s < 3; ++s) {
    if (leaves[s] == Tree::none) continue;
    tree.attach_leaf(leaves[s], made, s);
    const TreeBox<Tree> bounds = targets[s]->bounds();
    if (!same_frame) targets[s]->make_new_frame(bounds);
    node.set_child_box(s, bounds);
  }
  // What is still over the limit was indivisible before `incoming` came, so this goes no deeper.
  for (std::uint32_t s = 0; s < 3; ++s) {
    if (counts[s] > Tree::leaf_limit) split_leaf(tree, leaves[s], tree.leaf(leaves[s]).box(0));
  }
  return true;
}

}  // namespace spatial::detail

/// @file
/// Keeps the tight boxes of a tree exact (§5.1 has volumes only; these are what queries prune with). In: what
/// was added or taken away, and where. Out: changed boxes, from there up to the root.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree_storage.hpp"

namespace spatial::detail {

/// True if `inner` touches no side of `outer`, so that taking it away leaves `outer` tight.
template <class T, std::size_t D>
bool is_inside(const Box<T, D>& outer, const Box<T, D>& inner) {
  bool result = true;
  for (std::size_t a = 0; a < D; ++a) {
    result &= outer.min[a] < inner.min[a] && inner.max[a] < outer.max[a];
  }
  return result;
}

/// Makes the box at this link hold another one, and so on upwards.
template <class Tree>
void extend_up(Tree& tree, std::uint32_t parent, std::uint32_t side, const TreeBox<Tree>& box) {
  for (;;) {
    TreeBox<Tree> tight = tree.link_box(parent, side);
    if (encloses(tight, box)) return;
    extend(tight, box);
    tree.set_link_box(parent, side, tight);
    if (parent == Tree::none) return;
    side = tree.node(parent).side;
    parent = tree.node(parent).parent;
  }
}

/// Recomputes the box at this link from the node's children, and so on upwards.
template <class Tree>
void tighten_up(Tree& tree, std::uint32_t parent, std::uint32_t side) {
  for (;;) {
    const ChildRef here = tree.link(parent, side);
    const TreeBox<Tree> tight = tree.node(here.index()).bounds();
    if (tight == tree.link_box(parent, side)) return;
    tree.set_link_box(parent, side, tight);
    if (parent == Tree::none) return;
    side = tree.node(parent).side;
    parent = tree.node(parent).parent;
  }
}

/// Makes the box of a leaf exact, and those above it.
template <class Tree>
void tighten_leaf(Tree& tree, std::uint32_t index) {
  typename Tree::LeafType& home = tree.leaf(index);
  home.loose = 0;
  tree.set_link_box(home.parent, home.side, home.bounds());
  if (home.parent != Tree::none) tighten_up(tree, tree.node(home.parent).parent, tree.node(home.parent).side);
}

/// Makes the tight box of a leaf exact. A big leaf is looked through only after many erasures, so that
/// emptying it costs no more than filling it; until then its box is too large, which costs a query time but
/// no result.
template <class Tree>
void shrink_leaf(Tree& tree, std::uint32_t index) {
  typename Tree::LeafType& home = tree.leaf(index);
  if (home.count > 4 * Tree::leaf_limit && ++home.loose < home.count / 4) {
    tree.set_loose();
    return;
  }
  tighten_leaf(tree, index);
}

/// The exact bounds: root_box(), unless big leaves have put off the recomputation of theirs.
template <class Tree>
TreeBox<Tree> exact_bounds(const Tree& tree) {
  if (!tree.is_loose()) return tree.root_box();
  TreeBox<Tree> result = empty_box<typename Tree::Scalar, Tree::dimension>();
  std::vector<ChildRef> stack;
  if (!tree.root().empty()) stack.push_back(tree.root());
  while (!stack.empty()) {
    const ChildRef here = stack.back();
    stack.pop_back();
    if (here.is_leaf()) {
      extend(result, tree.leaf(here.index()).bounds());
      continue;
    }
    const typename Tree::NodeType& each = tree.node(here.index());
    for (std::size_t s = 0; s < 3; ++s) {
      if (!each.child[s].empty() && !encloses(result, each.child_box(s))) stack.push_back(each.child[s]);
    }
  }
  return result;
}

}  // namespace spatial::detail

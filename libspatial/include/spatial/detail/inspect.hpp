/// @file
/// Looks at a whole tree: whether it is sound, how big it is, and where its nodes are. In: a tree. Out:
/// complaints, statistics, node views.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../tree_statistics.hpp"
#include "cell.hpp"
#include "node.hpp"

namespace spatial::detail {

/// Calls `visit(ref, depth)` for every node and leaf, parents first.
template <class Core, class Visit>
void visit_all(const Core& core, Visit&& visit) {
  struct Item {
    ChildRef ref;
    std::size_t depth;
  };
  std::vector<Item> stack;
  if (!core.root().empty()) stack.push_back({core.root(), 0});
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    visit(item.ref, item.depth);
    if (item.ref.is_leaf()) continue;
    const auto& node = core.node(item.ref.index());
    for (std::size_t s = 3; s-- > 0;) {
      if (!node.child[s].empty()) stack.push_back({node.child[s], item.depth + 1});
    }
  }
}

/// Every broken rule, in words; nothing for a sound tree. O(n).
template <class Core>
std::vector<const char*> validate(const Core& core) {
  using T = typename Core::Scalar;
  constexpr std::size_t D = Core::dimension;
  std::vector<const char*> complaints;
  const auto require = [&](bool holds, const char* rule) {
    if (!holds) complaints.push_back(rule);
  };
  std::size_t elements = 0;
  std::size_t leaves = 0;
  std::vector<bool> seen(core.slot_capacity(), false);
  if (core.root().empty()) require(core.root_box() == empty_box<T, D>(), "an empty tree has the empty box");
  visit_all(core, [&](ChildRef ref, std::size_t) {
    const bool is_leaf = ref.is_leaf();
    const std::uint32_t parent = is_leaf ? core.leaf(ref.index()).parent : core.node(ref.index()).parent;
    const std::uint32_t side = is_leaf ? core.leaf(ref.index()).side : core.node(ref.index()).side;
    const bool is_root = parent == Core::none;
    require(is_root ? core.root() == ref : core.node(parent).child[side] == ref,
            "parent and child know each other");
    const Box<T, D> tight = is_root ? core.root_box() : core.node(parent).child_box(side);
    if (is_leaf) {
      const auto& leaf = core.leaf(ref.index());
      ++leaves;
      require(leaf.count > 0 && leaf.count <= leaf.capacity,
              "a leaf holds between one element and its capacity");
      require(leaf.count <= Core::leaf_limit || leaf.indivisible,
              "a leaf over the soft limit is indivisible");
      const Box<T, D> bounds = leaf.bounds();
      require(leaf.loose > 0 ? encloses(tight, bounds) : tight == bounds, "a leaf's tight box is tight");
      for (std::uint32_t i = 0; i < leaf.count; ++i) {
        ++elements;
        const std::uint32_t id = leaf.id(i);
        require(is_valid(leaf.box(i)), "every box is valid");
        require(id < seen.size() && !seen[id], "every slot is used once");
        if (id >= seen.size()) continue;
        seen[id] = true;
        const auto where = core.place(id);
        require(where.leaf == ref.index() && where.position == i, "a slot knows its element");
        require(is_root || core.link_cell(parent, side).holds(leaf.box(i)),
                "an element lies in its leaf's volume");
      }
    } else {
      const auto& node = core.node(ref.index());
      std::size_t children = 0;
      for (std::size_t s = 0; s < 3; ++s) {
        children += node.child[s].empty() ? 0 : 1;
        require(!node.child[s].empty() || node.child_box(s) == empty_box<T, D>(),
                "no child has the empty box");
      }
      require(children >= 2 || !node.child[centric].empty(), "only a centric child is alone");
      require(tight == node.bounds(), "a node's tight box is the union of its children's");
      require(node.cell.is_divisible(node.axis), "a node is split along a divisible axis");
      require(node.cell.box.min[node.axis] <= node.plane && node.plane <= node.cell.box.max[node.axis],
              "a split plane lies in the node's volume");
      if (!is_root) {
        const Cell<T, D> full = core.link_cell(parent, side);
        require(encloses(full.box, node.cell.box) && full.divisible == node.cell.divisible,
                "a node's volume lies in its parent's");
        require(node.compressed || full.box == node.cell.box, "a smaller volume is marked as compressed");
      }
    }
  });
  require(core.overview().empty() || core.overview().leaves_reached(core.leaves()) == leaves,
          "the overview leads to every leaf");
  require(elements == core.size(), "size is the number of elements");
  for (std::uint32_t id = 0; id < seen.size(); ++id) {
    require(seen[id] == (core.place(id).leaf != Core::none), "a free slot has no element");
  }
  return complaints;
}

template <class Core>
TreeStatistics statistics(const Core& core) {
  TreeStatistics result;
  result.elements = core.size();
  result.bytes = core.table_bytes();
  visit_all(core, [&](ChildRef ref, std::size_t depth) {
    if (ref.is_leaf()) {
      const auto& leaf = core.leaf(ref.index());
      ++result.leaves;
      result.depth = depth > result.depth ? depth : result.depth;
      result.largest_leaf = leaf.count > result.largest_leaf ? leaf.count : result.largest_leaf;
      result.bytes += leaf.bytes(leaf.capacity, leaf.rows, leaf.has_ids);
    } else {
      ++result.nodes;
    }
  });
  return result;
}

template <class Core, class Visit>
void visit_nodes(const Core& core, Visit&& visit) {
  constexpr std::size_t D = Core::dimension;
  visit_all(core, [&](ChildRef ref, std::size_t depth) {
    NodeView<typename Core::Scalar, D> view;
    view.depth = depth;
    view.is_leaf = ref.is_leaf();
    const std::uint32_t parent = view.is_leaf ? core.leaf(ref.index()).parent : core.node(ref.index()).parent;
    const std::uint32_t side = view.is_leaf ? core.leaf(ref.index()).side : core.node(ref.index()).side;
    view.side = parent == Core::none ? -1 : static_cast<int>(side);
    view.tight = parent == Core::none ? core.root_box() : core.node(parent).child_box(side);
    if (view.is_leaf) {
      view.volume = parent == Core::none ? view.tight : core.link_cell(parent, side).box;
      view.elements = core.leaf(ref.index()).count;
    } else {
      view.volume = core.node(ref.index()).cell.box;
      view.axis = core.node(ref.index()).axis;
      view.plane = core.node(ref.index()).plane;
    }
    visit(static_cast<const NodeView<typename Core::Scalar, D>&>(view));
  });
}

}  // namespace spatial::detail

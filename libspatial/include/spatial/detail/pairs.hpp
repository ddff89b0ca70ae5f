/// @file
/// All pairs of intersecting elements, within one tree or between two: both trees are walked together, and
/// only parts whose tight boxes touch are looked at. In: trees. Out: pairs, each once.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "lanes.hpp"
#include "levels.hpp"
#include "node.hpp"
#include "search.hpp"
#include "small_stack.hpp"

namespace spatial::detail {

template <class Core>
Box<typename Core::Scalar, Core::dimension> tight_box(const Core& core, ChildRef ref) {
  const std::uint32_t parent = ref.is_leaf() ? core.leaf(ref.index()).parent : core.node(ref.index()).parent;
  if (parent == Core::none) return core.root_box();
  const std::uint32_t side = ref.is_leaf() ? core.leaf(ref.index()).side : core.node(ref.index()).side;
  return core.node(parent).child_box(side);
}

/// What touches a box, of what its levels have let through.
template <class Leaf, class T, std::size_t D>
std::uint64_t touching(const Leaf& leaf, std::uint32_t begin, const Box<T, D>& box, const Sieved& sieved) {
  std::uint64_t result = sieved.sure;
  const auto boxes = leaf.boxes();
  for (std::uint64_t open = sieved.open(); open != 0; open &= open - 1) {
    const auto at = begin + static_cast<std::uint32_t>(std::countr_zero(open));
    if (touch(boxes[at], box)) result |= open & (~open + 1);
  }
  return result;
}

/// Pairs between two leaves. `visit(leaf, position, leaf, position)` returns whether to go on.
template <class CoreA, class CoreB, class Visit>
bool leaf_pairs(const typename CoreA::LeafType& a, const typename CoreB::LeafType& b,
                const Box<typename CoreB::Scalar, CoreB::dimension>& tight_b, Visit& visit) {
  const auto boxes = a.boxes();
  for (std::uint32_t begin_a = 0; begin_a < a.count; begin_a += level_bits) {
    const std::uint32_t count_a = a.count - begin_a < level_bits ? a.count - begin_a : level_bits;
    std::uint64_t near = a.reaching(begin_a, count_a, tight_b.min, tight_b.max).maybe;
    for (; near != 0; near &= near - 1) {
      const std::uint32_t i = begin_a + static_cast<std::uint32_t>(std::countr_zero(near));
      const auto box = boxes[i];
      const auto levels = b.frame().bounds(box.min, box.max);
      for (std::uint32_t begin_b = 0; begin_b < b.count; begin_b += level_bits) {
        const std::uint32_t count_b = b.count - begin_b < level_bits ? b.count - begin_b : level_bits;
        std::uint64_t hits = touching(b, begin_b, box, b.reaching(begin_b, count_b, levels));
        for (; hits != 0; hits &= hits - 1) {
          if (!visit(a, i, b, begin_b + static_cast<std::uint32_t>(std::countr_zero(hits)))) return false;
        }
      }
    }
  }
  return true;
}

/// Pairs within one leaf, the later element first.
template <class Core, class Visit>
bool leaf_self_pairs(const typename Core::LeafType& leaf, Visit& visit) {
  const auto boxes = leaf.boxes();
  for (std::uint32_t i = 1; i < leaf.count; ++i) {
    const auto box = boxes[i];
    const auto levels = leaf.own_levels(i);
    for (std::uint32_t begin = 0; begin < i; begin += level_bits) {
      const std::uint32_t count = i - begin < level_bits ? i - begin : level_bits;
      std::uint64_t hits = touching(leaf, begin, box, leaf.reaching(begin, count, levels));
      for (; hits != 0; hits &= hits - 1) {
        if (!visit(leaf, i, leaf, begin + static_cast<std::uint32_t>(std::countr_zero(hits)))) return false;
      }
    }
  }
  return true;
}

struct RefPair {
  ChildRef a, b;
};

/// Pairs between the subtree at `a` and the one at `b`, which are disjoint or belong to different trees.
template <class CoreA, class CoreB, class Visit>
bool cross_pairs(const CoreA& core_a, ChildRef a, const CoreB& core_b, ChildRef b, Visit& visit) {
  SmallStack<RefPair, 4 * stack_inline> stack;
  stack.push({a, b});
  while (!stack.empty()) {
    const RefPair here = stack.pop();
    if (here.a.is_leaf() && here.b.is_leaf()) {
      if (!leaf_pairs<CoreA, CoreB>(core_a.leaf(here.a.index()), core_b.leaf(here.b.index()),
                                    tight_box(core_b, here.b), visit)) {
        return false;
      }
    } else if (here.b.is_leaf()) {
      const auto& node = core_a.node(here.a.index());
      const auto box = tight_box(core_b, here.b);
      const std::uint32_t near = reaching(rows_of<CoreA>(node), box.min, box.max);
      for (std::uint32_t s = 0; s < 3; ++s) {
        if (((near >> s) & 1u) != 0 && !node.child[s].empty()) stack.push({node.child[s], here.b});
      }
    } else if (here.a.is_leaf()) {
      const auto& node = core_b.node(here.b.index());
      const auto box = tight_box(core_a, here.a);
      const std::uint32_t near = reaching(rows_of<CoreB>(node), box.min, box.max);
      for (std::uint32_t s = 0; s < 3; ++s) {
        if (((near >> s) & 1u) != 0 && !node.child[s].empty()) stack.push({here.a, node.child[s]});
      }
    } else {
      const auto& node_a = core_a.node(here.a.index());
      const auto& node_b = core_b.node(here.b.index());
      for (std::uint32_t sa = 0; sa < 3; ++sa) {
        if (node_a.child[sa].empty()) continue;
        const auto box = node_a.child_box(sa);
        const std::uint32_t near = reaching(rows_of<CoreB>(node_b), box.min, box.max);
        for (std::uint32_t sb = 0; sb < 3; ++sb) {
          if (((near >> sb) & 1u) != 0 && !node_b.child[sb].empty())
            stack.push({node_a.child[sa], node_b.child[sb]});
        }
      }
    }
  }
  return true;
}

/// Pairs within one tree. Returns whether all were visited.
template <class Core, class Visit>
bool self_pairs(const Core& core, Visit&& visit) {
  if (core.root().empty()) return true;
  SmallStack<ChildRef, stack_inline> stack;
  stack.push(core.root());
  while (!stack.empty()) {
    const ChildRef here = stack.pop();
    if (here.is_leaf()) {
      if (!leaf_self_pairs<Core>(core.leaf(here.index()), visit)) return false;
      continue;
    }
    const auto& node = core.node(here.index());
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (node.child[s].empty()) continue;
      stack.push(node.child[s]);
      const auto box = node.child_box(s);
      const std::uint32_t near = reaching(rows_of<Core>(node), box.min, box.max);
      for (std::uint32_t other = 0; other < s; ++other) {
        if (((near >> other) & 1u) == 0 || node.child[other].empty()) continue;
        if (!cross_pairs(core, node.child[s], core, node.child[other], visit)) return false;
      }
    }
  }
  return true;
}

/// Pairs between two trees. Returns whether all were visited.
template <class CoreA, class CoreB, class Visit>
bool tree_pairs(const CoreA& a, const CoreB& b, Visit&& visit) {
  if (a.root().empty() || b.root().empty() || !touch(a.root_box(), b.root_box())) return true;
  return cross_pairs(a, a.root(), b, b.root(), visit);
}

}  // namespace spatial::detail

/// @file
/// Walks the tree for a predicate (§5.1: "query for all elements within a specified area"). In: a tree and a
/// bound predicate. Out: every hit, to a function, or one at a time from a Cursor.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bound_predicates.hpp"
#include "node.hpp"
#include "small_stack.hpp"

namespace spatial::detail {

template <class Core>
using CoreRows = Rows<typename Core::Scalar, Core::dimension>;

/// Deep enough for any tree of usual data; a deeper one takes memory from the heap.
inline constexpr std::size_t stack_inline = 128;

template <class Core>
CoreRows<Core> rows_of(const typename Core::NodeType& node) {
  return {reinterpret_cast<const typename Core::Scalar*>(&node), Core::NodeType::lanes,
          Core::dimension * Core::NodeType::lanes};
}

/// What a search looked at.
struct NoCounts {
  void node() {}
  void leaf(std::size_t) {}
};

/// Nodes that wait, and leaves that wait. They are written without branches, since whether a child is hit,
/// and whether it is a leaf, cannot be predicted.
class Waiting {
 public:
  static constexpr std::size_t leaf_batch = 64;

  explicit Waiting(ChildRef root) {
    (root.is_leaf() ? leaves_[leaf_count_++] : nodes_[node_count_++]) = root.bits;
  }
  /// Adds those of three children whose bits are set in `hit`, marked where the bit four higher is.
  void push(const ChildRef (&child)[3], std::uint32_t hit) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t bits = child[side].bits;
      const std::uint32_t is_hit = (hit >> side) & 1u & static_cast<std::uint32_t>(bits != ChildRef::none);
      const std::uint32_t is_leaf = bits >> 31;
      const std::uint32_t marked = bits | ((hit >> (4 + side)) & 1u) << 30;
      leaves_[leaf_count_] = marked;
      leaf_count_ += is_hit & is_leaf;
      nodes_[node_count_] = marked;
      node_count_ += is_hit & (is_leaf ^ 1u);
    }
    if (node_count_ + 3 > inline_nodes) spill();
  }
  /// Asks memory for the node that comes after the next one.
  template <class Core>
  void prefetch_second(const Core& core) const {
    if (node_count_ < 2) return;
    const auto& node = core.node(ChildRef{nodes_[node_count_ - 2]}.index());
    const auto* begin = reinterpret_cast<const char*>(&node);
    for (std::size_t i = 0; i < sizeof(node); i += 64) prefetch(begin + i);
  }
  bool pop_node(ChildRef& ref) {
    if (node_count_ == 0 && !unspill()) return false;
    ref.bits = nodes_[--node_count_];
    return true;
  }
  [[nodiscard]] bool batch_is_full() const { return leaf_count_ + 3 > leaf_batch; }
  [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
  [[nodiscard]] ChildRef leaf(std::size_t i) const { return {leaves_[i]}; }
  void clear_leaves() { leaf_count_ = 0; }

 private:
  static constexpr std::size_t inline_nodes = 128;
  void spill() {
    more_.insert(more_.end(), nodes_, nodes_ + node_count_);
    node_count_ = 0;
  }
  bool unspill() {
    if (more_.empty()) return false;
    nodes_[node_count_++] = more_.back();
    more_.pop_back();
    return true;
  }
  std::size_t node_count_ = 0;
  std::size_t leaf_count_ = 0;
  std::uint32_t nodes_[inline_nodes];
  std::uint32_t leaves_[leaf_batch];
  std::vector<std::uint32_t> more_;
};

/// Asks memory for what a query looks at in most leaves: frame, levels and values.
template <class Core>
void prefetch_block(const std::byte* block) {
  // Of half a leaf; to count would be a branch that goes wrong, and would need the leaf's header.
  constexpr std::size_t half = Core::LeafType::boxes_offset(Core::leaf_limit / 2, 2 * Core::dimension);
  constexpr std::size_t end = half < 512 ? half : 512;
  for (std::size_t at = 0; at < end; at += 64) prefetch(block + at);
}

/// Calls `visit(leaf, position)` for every hit in a leaf until it returns false.
template <class Core, class Bound, class Visit>
bool search_leaf(const typename Core::LeafType& leaf, bool all, const Bound& predicate, Visit& visit) {
  if (all) {
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      if (!visit(leaf, i)) return false;
    }
    return true;
  }
  for (std::uint32_t begin = 0; begin < leaf.count; begin += level_bits) {
    const std::uint32_t count = leaf.count - begin < level_bits ? leaf.count - begin : level_bits;
    std::uint64_t hits = predicate.hits(leaf, begin, count);
    for (; hits != 0; hits &= hits - 1) {
      if (!visit(leaf, begin + static_cast<std::uint32_t>(std::countr_zero(hits)))) return false;
    }
  }
  return true;
}

/// The walk through the overview. @pre there is one
template <class Core, class Bound, class Visit, class Counts>
bool search_overview(const Core& core, const Bound& predicate, Visit& visit, Counts& counts) {
  constexpr std::size_t batch = 64;
  std::uint32_t leaves[batch + level_bits];
  std::size_t leaf_count = 0;
  SmallStack<std::uint32_t, stack_inline> nodes;
  nodes.push(0);
  while (!nodes.empty()) {
    const ChildRef here{nodes.pop()};
    const auto node = core.overview().node(here.index());
    counts.node();
    std::uint64_t hit = first_level_bits(node.count);
    std::uint64_t inside = hit;
    if (!here.is_inside()) {
      hit = predicate.wide_may(node);
      // A query that reaches few children is rarely big enough to cover one.
      inside = std::popcount(hit) > 4 ? predicate.wide_must(node) : 0;
    }
    for (; hit != 0; hit &= hit - 1) {
      const int i = std::countr_zero(hit);
      const auto& child = node.children[i];
      const std::uint32_t bits = child.bits | static_cast<std::uint32_t>((inside >> i) & 1u) << 30;
      if (ChildRef{bits}.is_leaf()) {
        leaves[leaf_count++] = bits;
        prefetch(&core.leaf(ChildRef{bits}.index()));
        prefetch_block<Core>(core.overview().block(child));
      } else {
        nodes.push(bits);
      }
    }
    if (leaf_count <= batch && !nodes.empty()) continue;
    for (std::size_t i = 0; i < leaf_count; ++i) {
      const ChildRef ref{leaves[i]};
      const auto& leaf = core.leaf(ref.index());
      counts.leaf(leaf.count);
      if (!search_leaf<Core>(leaf, ref.is_inside(), predicate, visit)) return false;
    }
    leaf_count = 0;
  }
  return true;
}

/// Calls `visit(leaf, position)` for every hit until it returns false. Returns whether all were visited.
template <class Core, class Bound, class Visit, class Counts = NoCounts>
bool search(const Core& core, const Bound& predicate, Visit&& visit, Counts&& counts = {}) {
  if (core.root().empty() || !predicate.may(core.root_box())) return true;
  if constexpr (requires { predicate.wide_may(core.overview().node(0)); }) {
    if (!core.overview().empty()) return search_overview(core, predicate, visit, counts);
  }
  Waiting waiting(core.root());
  ChildRef here;
  for (;;) {
    while (!waiting.batch_is_full() && waiting.pop_node(here)) {
      for (;;) {
        const auto& node = core.node(here.index());
        counts.node();
        const std::uint32_t hit = here.is_inside() ? 0x77u : predicate.may_and_must(rows_of<Core>(node));
        // A small query mostly goes straight down: so the next node is known soonest.
        if ((hit & (hit - 1)) == 0 && hit != 0) {
          const ChildRef only = node.child[std::countr_zero(hit)];
          if (only.is_node()) {
            here = only;
            continue;
          }
        }
        waiting.push(node.child, hit);
        waiting.prefetch_second(core);
        break;
      }
    }
    if (waiting.leaf_count() == 0) return true;
    // A leaf's levels are two steps away: first all headers are asked for, then the levels of the next one.
    for (std::size_t i = 0; i < waiting.leaf_count(); ++i) prefetch(&core.leaf(waiting.leaf(i).index()));
    for (std::size_t i = 0; i < waiting.leaf_count(); ++i) {
      const ChildRef ref = waiting.leaf(i);
      if (i + 1 < waiting.leaf_count()) {
        prefetch_block<Core>(core.leaf(waiting.leaf(i + 1).index()).data);
      }
      const auto& leaf = core.leaf(ref.index());
      counts.leaf(leaf.count);
      if (!search_leaf<Core>(leaf, ref.is_inside(), predicate, visit)) return false;
    }
    waiting.clear_leaves();
  }
}

/// The same walk, one hit at a time.
template <class Core, class Bound>
class Cursor {
 public:
  Cursor(const Core& core, Bound predicate) : core_(&core), predicate_(std::move(predicate)) {
    if (!core.root().empty() && predicate_.may(core.root_box())) stack_.push(core.root());
  }

  /// Goes to the next hit. False if there is none.
  bool next() {
    for (;;) {
      if (hits_ != 0) {
        position_ = begin_ + static_cast<std::uint32_t>(std::countr_zero(hits_));
        hits_ &= hits_ - 1;
        return true;
      }
      if (leaf_ != nullptr && begin_ + level_bits < leaf_->count) {
        begin_ += level_bits;
        test();
        continue;
      }
      leaf_ = nullptr;
      if (stack_.empty()) return false;
      const ChildRef here = stack_.pop();
      if (here.is_leaf()) {
        leaf_ = &core_->leaf(here.index());
        begin_ = 0;
        test();
        continue;
      }
      const auto& node = core_->node(here.index());
      const std::uint32_t may = predicate_.may_mask(rows_of<Core>(node));
      for (std::uint32_t side = 3; side-- > 0;) {
        if (((may >> side) & 1u) != 0 && !node.child[side].empty()) stack_.push(node.child[side]);
      }
    }
  }
  /// @pre next() was true
  [[nodiscard]] const typename Core::LeafType& leaf() const { return *leaf_; }
  [[nodiscard]] std::uint32_t position() const { return position_; }

 private:
  void test() {
    const std::uint32_t left = leaf_->count - begin_;
    hits_ = predicate_.hits(*leaf_, begin_, left < level_bits ? left : level_bits);
  }

  const Core* core_;
  Bound predicate_;
  SmallStack<ChildRef, stack_inline> stack_;
  const typename Core::LeafType* leaf_ = nullptr;
  std::uint32_t begin_ = 0;
  std::uint32_t position_ = 0;
  std::uint64_t hits_ = 0;
};

}  // namespace spatial::detail

/// @file
/// Finds elements in order of a key that a metric gives: nearest first. In: a tree, a metric and a filter.
/// Out: elements, one at a time from an OrderedCursor, or the first k of them at once.
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "metric.hpp"
#include "node.hpp"
#include "search.hpp"

namespace spatial::detail {

/// The filter that lets everything through.
template <class T, std::size_t D>
struct Everything {
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>&, const Value&) const {
    return true;
  }
  [[nodiscard]] bool may(const Box<T, D>&) const { return true; }
};

template <class S>
struct Found {
  S key;
  ChildRef place;          ///< a node, or a leaf
  std::uint32_t position;  ///< in the leaf; `whole` for the leaf itself
  static constexpr std::uint32_t whole = 0xffffffffu;
};
struct LaterFirst {
  template <class S>
  bool operator()(const Found<S>& a, const Found<S>& b) const {
    return a.key > b.key;
  }
};

/// Best first: what waits is kept in a heap, elements among nodes, and an element that comes to the top is
/// next.
template <class Core, class Metric, class Filter>
class OrderedCursor {
 public:
  using S = typename Metric::S;
  static constexpr std::size_t D = Core::dimension;

  OrderedCursor(const Core& core, Metric metric, Filter filter, std::size_t limit)
      : core_(&core), metric_(std::move(metric)), filter_(std::move(filter)), left_(limit) {
    if (core.root().empty() || !filter_.may(core.root_box())) return;
    typename Core::NodeType above;
    above.set_child_box(0, core.root_box());
    S key[keys_room];
    metric_.keys(rows_of<Core>(above), 1, key);
    if (key[0] == key[0]) waiting_.push_back({key[0], core.root(), Found<S>::whole});
  }

  /// Goes to the next element. False if there is none.
  bool next() {
    if (left_ == 0) return false;
    while (!waiting_.empty()) {
      std::pop_heap(waiting_.begin(), waiting_.end(), LaterFirst{});
      const Found<S> top = waiting_.back();
      waiting_.pop_back();
      if (top.position != Found<S>::whole) {
        found_ = top;
        --left_;
        return true;
      }
      if (top.place.is_leaf()) {
        open_leaf(top.place);
      } else {
        open_node(core_->node(top.place.index()));
      }
    }
    left_ = 0;
    return false;
  }
  /// @pre next() was true
  [[nodiscard]] const typename Core::LeafType& leaf() const { return core_->leaf(found_.place.index()); }
  [[nodiscard]] std::uint32_t position() const { return found_.position; }
  [[nodiscard]] S distance() const { return Metric::distance(found_.key); }

 private:
  void open_node(const typename Core::NodeType& node) {
    S keys[keys_room];
    metric_.keys(rows_of<Core>(node), 3, keys);
    for (std::size_t s = 0; s < 3; ++s) {
      if (node.child[s].empty() || keys[s] != keys[s] || !filter_.may(node.child_box(s))) continue;
      push({keys[s], node.child[s], Found<S>::whole});
    }
  }
  void open_leaf(ChildRef place) {
    const auto& leaf = core_->leaf(place.index());
    S keys[keys_room];
    for (std::uint32_t begin = 0; begin < leaf.count; begin += mask_bits) {
      const std::uint32_t count = leaf.count - begin < mask_bits ? leaf.count - begin : mask_bits;
      metric_.keys(rows_of<Core>(leaf).from(begin), count, keys);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t at = begin + i;
        if (keys[i] != keys[i] || !filter_.test(leaf.box(at), unwrap(leaf.values()[at]))) continue;
        push({keys[i], place, at});
      }
    }
  }
  void push(const Found<S>& item) {
    waiting_.push_back(item);
    std::push_heap(waiting_.begin(), waiting_.end(), LaterFirst{});
  }

  const Core* core_;
  Metric metric_;
  Filter filter_;
  std::size_t left_;
  std::vector<Found<S>> waiting_;
  Found<S> found_{};
};

/// Keeps the `limit` smallest of what it is given. A few are kept sorted; many are collected, and thinned out
/// whenever twice as many have come together, which costs constant time for each.
template <class S>
class Smallest {
 public:
  Smallest(std::size_t limit, std::size_t available) : limit_(limit), sorted_(limit <= few) {
    best_.reserve(sorted_ ? limit : std::min(2 * limit, available));
  }
  /// What has a key of `worst()` or more is not needed any more.
  [[nodiscard]] S worst() const { return worst_; }
  /// False if less than `limit` were given so far, so that an infinite key counts too.
  [[nodiscard]] bool full() const { return full_; }
  void add(const Found<S>& item) {
    if (!sorted_) {
      best_.push_back(item);
      if (best_.size() >= 2 * limit_) thin();
      return;
    }
    if (best_.size() < limit_) {
      best_.push_back(item);
    } else {
      best_.back() = item;
    }
    for (std::size_t i = best_.size() - 1; i > 0 && best_[i].key < best_[i - 1].key; --i) {
      std::swap(best_[i], best_[i - 1]);
    }
    full_ = best_.size() == limit_;
    if (full_) worst_ = best_.back().key;
  }
  std::vector<Found<S>> take() {
    if (!sorted_) {
      if (best_.size() > limit_) thin();
      std::sort(best_.begin(), best_.end(), Nearer{});
    }
    return std::move(best_);
  }

 private:
  static constexpr std::size_t few = 16;
  struct Nearer {
    bool operator()(const Found<S>& a, const Found<S>& b) const { return a.key < b.key; }
  };
  void thin() {
    const auto last = best_.begin() + static_cast<std::ptrdiff_t>(limit_ - 1);
    std::nth_element(best_.begin(), last, best_.end(), Nearer{});
    best_.resize(limit_);
    worst_ = best_.back().key;
    full_ = true;
  }

  std::size_t limit_;
  bool sorted_;
  bool full_ = false;
  S worst_ = std::numeric_limits<S>::infinity();
  std::vector<Found<S>> best_;
};

/// The `limit` elements with the smallest keys, in order. Walks depth first, nearest child first, and prunes
/// with the worst of the best so far: unlike best first, it keeps few elements.
template <class Core, class Metric, class Filter>
std::vector<Found<typename Metric::S>> first_of(const Core& core, const Metric& metric, const Filter& filter,
                                                std::size_t limit) {
  using S = typename Metric::S;
  Smallest<S> best(limit, core.size());
  if (core.root().empty() || limit == 0 || !filter.may(core.root_box())) return {};
  struct Item {
    S key;
    ChildRef place;
  };
  SmallStack<Item, stack_inline> stack;
  stack.push({S{0}, core.root()});
  S keys[keys_room];
  while (!stack.empty()) {
    const Item top = stack.pop();
    if (best.full() && !(top.key < best.worst())) continue;
    if (top.place.is_leaf()) {
      const auto& leaf = core.leaf(top.place.index());
      for (std::uint32_t begin = 0; begin < leaf.count; begin += mask_bits) {
        const std::uint32_t count = leaf.count - begin < mask_bits ? leaf.count - begin : mask_bits;
        if (best.full() && !(top.key < best.worst()))
          break;  // nothing here can be nearer than the leaf itself
        metric.keys(rows_of<Core>(leaf).from(begin), count, keys);
        std::uint32_t near = below(keys, count, best.worst(), !best.full());
        for (; near != 0; near &= near - 1) {
          const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
          const std::uint32_t at = begin + i;
          if (best.full() && !(keys[i] < best.worst())) continue;
          if (!filter.test(leaf.box(at), unwrap(leaf.values()[at]))) continue;
          best.add({keys[i], top.place, at});
        }
      }
      continue;
    }
    const auto& node = core.node(top.place.index());
    metric.keys(rows_of<Core>(node), 3, keys);
    // Farthest first onto the stack. The centric child goes where its key says.
    std::uint32_t order[3] = {0, 1, 2};
    if (keys[order[0]] < keys[order[1]]) std::swap(order[0], order[1]);
    if (keys[order[1]] < keys[order[2]]) std::swap(order[1], order[2]);
    if (keys[order[0]] < keys[order[1]]) std::swap(order[0], order[1]);
    for (const std::uint32_t s : order) {
      if (node.child[s].empty() || !(keys[s] <= best.worst()) || !filter.may(node.child_box(s))) continue;
      stack.push({keys[s], node.child[s]});
    }
  }
  return best.take();
}

}  // namespace spatial::detail

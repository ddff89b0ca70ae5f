/// @file
/// Finds elements in order of a key that a metric gives: nearest first. In: a tree, a metric and a filter.
/// Out: elements, one at a time from an OrderedCursor, or the first k of them at once.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    S key[1];
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
    S keys[3];
    metric_.keys(rows_of<Core>(node), 3, keys);
    for (std::size_t s = 0; s < 3; ++s) {
      if (node.child[s].empty() || keys[s] != keys[s] || !filter_.may(node.child_box(s))) continue;
      push({keys[s], node.child[s], Found<S>::whole});
    }
  }
  void open_leaf(ChildRef place) {
    const auto& leaf = core_->leaf(place.index());
    S keys[mask_bits];
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

/// The `limit` elements with the smallest keys, in order. Walks depth first, nearest child first, and prunes
/// with the worst of the best so far: unlike best first, it keeps only `limit` elements.
template <class Core, class Metric, class Filter>
std::vector<Found<typename Metric::S>> first_of(const Core& core, const Metric& metric, const Filter& filter,
                                                std::size_t limit) {
  using S = typename Metric::S;
  std::vector<Found<S>> best;
  if (core.root().empty() || limit == 0 || !filter.may(core.root_box())) return best;
  const auto nearer = [](const Found<S>& a, const Found<S>& b) { return a.key < b.key; };
  best.reserve(std::min(limit, core.size()));
  struct Waiting {
    S key;
    ChildRef place;
  };
  SmallStack<Waiting, stack_inline> stack;
  stack.push({S{0}, core.root()});
  S worst = std::numeric_limits<S>::infinity();
  S keys[mask_bits];
  while (!stack.empty()) {
    const Waiting top = stack.pop();
    if (top.key > worst || (top.key == worst && best.size() == limit)) continue;
    if (top.place.is_leaf()) {
      const auto& leaf = core.leaf(top.place.index());
      for (std::uint32_t begin = 0; begin < leaf.count; begin += mask_bits) {
        const std::uint32_t count = leaf.count - begin < mask_bits ? leaf.count - begin : mask_bits;
        metric.keys(rows_of<Core>(leaf).from(begin), count, keys);
        for (std::uint32_t i = 0; i < count; ++i) {
          const bool full = best.size() == limit;
          if (!(full ? keys[i] < worst : keys[i] <= worst)) continue;
          const std::uint32_t at = begin + i;
          if (!filter.test(leaf.box(at), unwrap(leaf.values()[at]))) continue;
          if (full) {
            std::pop_heap(best.begin(), best.end(), nearer);
            best.back() = {keys[i], top.place, at};
          } else {
            best.push_back({keys[i], top.place, at});
          }
          std::push_heap(best.begin(), best.end(), nearer);
          if (best.size() == limit) worst = best.front().key;
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
      if (node.child[s].empty() || !(keys[s] <= worst) || !filter.may(node.child_box(s))) continue;
      stack.push({keys[s], node.child[s]});
    }
  }
  std::sort_heap(best.begin(), best.end(), nearer);
  return best;
}

}  // namespace spatial::detail

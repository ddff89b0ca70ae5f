/// @file
/// Finds elements in order of a key that a metric gives: nearest first, one at a time. In: a tree, a metric
/// and a filter. Out: elements.
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
    for (std::uint32_t at = 0; at < leaf.count; ++at) {
      const S key = metric_.key(leaf.box(at));
      if (key != key || !filter_.test(leaf.box(at), unwrap(leaf.values()[at]))) continue;
      push({key, place, at});
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

}  // namespace spatial::detail

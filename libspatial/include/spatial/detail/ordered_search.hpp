/// @file
/// Finds elements in order of a key that a metric gives: nearest first. In: a tree, a metric and a filter.
/// Out: elements, one at a time from an OrderedCursor, or the first k of them at once.
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
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

/// Keeps the `limit` smallest of what it is given. A few are kept sorted; many are collected, and thinned out
/// whenever twice as many have come together, which costs constant time for each.
template <class S>
class Smallest {
 public:
  Smallest(std::size_t limit, std::size_t available) : limit_(limit), sorted_(limit <= few) {
    if (!sorted_) many_.reserve(std::min(2 * limit, available));
  }
  /// True if something with this key is still needed. What is infinitely far is, while less than `limit` were
  /// given.
  [[nodiscard]] bool wants(S key) const { return full_ ? key < worst_ : key <= worst_; }
  /// Nothing with a greater key is needed.
  [[nodiscard]] S worst() const { return worst_; }
  [[nodiscard]] bool full() const { return full_; }
  void add(const Found<S>& item) {
    if (!sorted_) {
      many_.push_back(item);
      if (many_.size() >= 2 * limit_) thin();
      return;
    }
    std::size_t i = full_ ? count_ - 1 : count_++;
    for (; i > 0 && item.key < few_[i - 1].key; --i) few_[i] = few_[i - 1];
    few_[i] = item;
    full_ = count_ == limit_;
    if (full_) worst_ = few_[count_ - 1].key;
  }
  /// Calls `visit(item)` for each, nearest first, until it returns false.
  template <class Visit>
  void visit_in_order(Visit&& visit) {
    if (!sorted_) {
      sort_many();
      if (many_.size() > limit_) many_.resize(limit_);
    }
    const Found<S>* items = sorted_ ? few_ : many_.data();
    const std::size_t count = sorted_ ? count_ : many_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (!visit(items[i])) return;
    }
  }

 private:
  static constexpr std::size_t few = 16;
  struct Nearer {
    bool operator()(const Found<S>& a, const Found<S>& b) const { return a.key < b.key; }
  };
  void thin() {
    const auto last = many_.begin() + static_cast<std::ptrdiff_t>(limit_ - 1);
    std::nth_element(many_.begin(), last, many_.end(), Nearer{});
    many_.resize(limit_);
    worst_ = many_.back().key;
    full_ = true;
  }

  // Squared distances are spread over their range, so that as many buckets as items nearly sort them.
  void sort_many() {
    S greatest = 0;
    for (const Found<S>& item : many_) greatest = item.key > greatest ? item.key : greatest;
    const std::size_t count = many_.size();
    const S scale = static_cast<S>(count) / greatest;
    if (!(scale > 0 && scale <= std::numeric_limits<S>::max())) {
      std::sort(many_.begin(), many_.end(), Nearer{});
      return;
    }
    const auto bucket_of = [&](S key) {
      const auto bucket = static_cast<std::size_t>(key * scale);
      return bucket < count ? bucket : count - 1;
    };
    std::vector<std::uint32_t> ends(count + 1, 0);  // first: where each bucket begins, then where it ends
    for (const Found<S>& item : many_) ++ends[bucket_of(item.key) + 1];
    for (std::size_t b = 1; b <= count; ++b) ends[b] += ends[b - 1];
    std::vector<Found<S>> sorted(count);
    for (const Found<S>& item : many_) sorted[ends[bucket_of(item.key)]++] = item;
    std::uint32_t begin = 0;
    for (std::size_t b = 0; b < count; begin = ends[b++]) {
      if (ends[b] - begin > 1) {
        std::sort(sorted.begin() + begin, sorted.begin() + ends[b], Nearer{});
      }
    }
    many_.swap(sorted);
  }

  std::size_t limit_;
  bool sorted_;
  bool full_ = false;
  S worst_ = std::numeric_limits<S>::infinity();
  std::size_t count_ = 0;
  Found<S> few_[few];
  std::vector<Found<S>> many_;
};

/// Calls `visit(item)` for the `limit` elements with the smallest keys, in order, until it returns false.
/// Walks depth first, nearest child first, and prunes with the worst of the best so far: unlike best first,
/// it keeps few elements.
template <class Core, class Metric, class Filter, class Visit>
void visit_first(const Core& core, const Metric& metric, const Filter& filter, std::size_t limit,
                 Visit&& visit) {
  using S = typename Metric::S;
  constexpr bool all_pass = std::is_same_v<Filter, Everything<typename Core::Scalar, Core::dimension>>;
  if (core.root().empty() || limit == 0 || !filter.may(core.root_box())) return;
  Smallest<S> best(limit, core.size());
  struct Part {
    S key;
    ChildRef place;
  };
  SmallStack<Part, stack_inline> waiting;
  S keys[keys_room];
  // Puts the children that may hold something near onto the stack, except one, farthest first.
  const auto open = [&](const typename Core::NodeType& node, std::uint32_t except) {
    metric.keys(rows_of<Core>(node), 3, keys);
    const std::uint32_t near = below(keys, 3, best.worst(), !best.full()) & ~(1u << except);
    if (near == 0) return;
    // The centric child goes where its key says.
    std::uint32_t order[3] = {0, 1, 2};
    if ((near & (near - 1)) != 0) {
      if (keys[order[0]] < keys[order[1]]) std::swap(order[0], order[1]);
      if (keys[order[1]] < keys[order[2]]) std::swap(order[1], order[2]);
      if (keys[order[0]] < keys[order[1]]) std::swap(order[0], order[1]);
    }
    for (const std::uint32_t s : order) {
      if (((near >> s) & 1u) == 0 || node.child[s].empty()) continue;
      if (!all_pass && !filter.may(node.child_box(s))) continue;
      if (node.child[s].is_leaf()) prefetch(&core.leaf(node.child[s].index()));
      waiting.push({keys[s], node.child[s]});
    }
  };
  // First straight down by the planes, as long as nothing lies across them: a plane is compared sooner than
  // three boxes. What is beside this way is looked at afterwards, from below: most of it is too far by then.
  Part here{S{0}, core.root()};
  std::uint32_t above = Core::none;
  std::uint32_t side = 0;
  while (!here.place.is_leaf()) {
    const auto& node = core.node(here.place.index());
    if (!node.child[centric].empty()) break;
    above = here.place.index();
    side = metric.is_higher(node.axis, node.plane) ? higher : lower;
    here.place = node.child[side];
  }
  waiting.push(here);
  for (;;) {
    if (waiting.empty()) {
      if (above == Core::none) break;
      const auto& node = core.node(above);
      open(node, side);
      above = node.parent;
      side = node.side;
      continue;
    }
    here = waiting.pop();
    if (!best.wants(here.key)) continue;
    if (!here.place.is_leaf()) {
      open(core.node(here.place.index()), 3);
      continue;
    }
    const auto& leaf = core.leaf(here.place.index());
    const auto boxes = leaf.boxes();
    const bool point_keys = leaf.is_flat() && metric.has_point_keys();
    std::uint32_t step = 0;
    for (std::uint32_t begin = 0; begin < leaf.count && best.wants(here.key); begin += step) {
      // Once there are enough, the levels tell what is too far. Until then, some are looked at.
      const bool sieved = Metric::has_reach && best.full();
      const std::uint32_t most = sieved ? level_bits : static_cast<std::uint32_t>(level_block);
      step = leaf.count - begin < most ? leaf.count - begin : most;
      std::uint64_t near = first_level_bits(step);
      if constexpr (Metric::has_reach) {
        if (sieved) {
          Point<S, Core::dimension> low, high;
          metric.reach(best.worst(), low, high);
          near = leaf.reaching(begin, step, low, high).maybe;
        }
      }
      for (; near != 0; near &= near - 1) {
        const std::uint32_t at = begin + static_cast<std::uint32_t>(std::countr_zero(near));
        const typename Core::Scalar* from = boxes.coordinates(at);
        const S key =
            point_keys ? metric.point_key(from) : metric.key(from, from + boxes.rows - Core::dimension);
        if (!best.wants(key)) continue;
        if (!all_pass && !filter.test(boxes[at], unwrap(leaf.values()[at]))) continue;
        best.add({key, here.place, at});
      }
    }
  }
  best.visit_in_order(visit);
}

}  // namespace spatial::detail

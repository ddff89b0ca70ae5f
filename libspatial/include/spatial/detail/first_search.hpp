/// @file
/// Finds the k elements with the smallest keys that a metric gives: the nearest. In: a tree, a metric and a
/// filter. Out: elements, in order.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "level_distances.hpp"
#include "metric.hpp"
#include "ordered_search.hpp"
#include "overview.hpp"
#include "search.hpp"
#include "small_stack.hpp"
#include "smallest.hpp"

namespace spatial::detail {

/// Walks the tree and prunes with the worst of the best so far: unlike best first among the elements, it
/// keeps few of them. A tree with an overview is walked by that; others depth first, nearest child first.
template <class Core, class Metric, class Filter>
class FirstSearch {
 public:
  using S = typename Metric::S;
  using T = typename Core::Scalar;
  static constexpr std::size_t D = Core::dimension;

  /// @pre limit > 0
  FirstSearch(const Core& core, const Metric& metric, const Filter& filter, std::size_t limit)
      : core_(core), metric_(metric), filter_(filter), best_(limit, core.size()) {}

  void run() {
    if (core_.root().empty() || !filter_.may(core_.root_box())) return;
    if constexpr (all_pass && D <= most_axes_by_overview) {
      if (!core_.overview().empty()) {
        if (metric_.reaches_any()) walk_overview();
        return;
      }
    }
    walk_nodes();
  }
  /// Calls `visit(item)` for what was found, nearest first, until it returns false.
  template <class Visit>
  void visit_in_order(Visit&& visit) {
    best_.visit_in_order(visit);
  }

 private:
  static constexpr bool all_pass = std::is_same_v<Filter, Everything<T, D>>;
  // Distances of levels tell the less, the more axes there are: then the nodes lead to fewer leaves.
  static constexpr std::size_t most_axes_by_overview = 4;
  using NodeType = typename Core::NodeType;
  using LeafType = typename Core::LeafType;
  using Measure = LevelMeasure<T, D>;

  // --- the tree ---

  struct Part {
    S key;
    std::uint32_t bits;  // of a ChildRef
  };
  using Parts = SmallStack<Part, stack_inline>;

  // Puts the children that may hold something near onto the stack, except one, farthest first.
  void open(const NodeType& node, std::uint32_t except, Parts& waiting) {
    S keys[keys_room];
    metric_.keys(rows_of<Core>(node), 3, keys);
    const std::uint32_t near = below(keys, 3, best_.worst(), !best_.full()) & ~(1u << except);
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
      if (!all_pass && !filter_.may(node.child_box(s))) continue;
      if (node.child[s].is_leaf()) prefetch(&core_.leaf(node.child[s].index()));
      waiting.push({keys[s], node.child[s].bits});
    }
  }
  void walk_nodes() {
    Parts waiting;
    // First straight down by the planes, as long as nothing lies across them: a plane is compared sooner than
    // three boxes. What is beside this way is looked at afterwards, from below: most of it is too far by
    // then.
    ChildRef here = core_.root();
    std::uint32_t above = Core::none;
    std::uint32_t side = 0;
    while (!here.is_leaf()) {
      const NodeType& node = core_.node(here.index());
      if (!node.child[centric].empty()) break;
      above = here.index();
      side = metric_.is_higher(node.axis, node.plane) ? higher : lower;
      here = node.child[side];
    }
    waiting.push({S{0}, here.bits});
    for (;;) {
      if (waiting.empty()) {
        if (above == Core::none) break;
        const NodeType& node = core_.node(above);
        open(node, side, waiting);
        above = node.parent;
        side = node.side;
        continue;
      }
      const Part part = waiting.pop();
      if (!best_.wants(part.key)) continue;
      const ChildRef ref{part.bits};
      if (ref.is_leaf()) {
        look_at(ref.index());
      } else {
        open(core_.node(ref.index()), 3, waiting);
      }
    }
  }

  // --- the overview ---

  /// A node of the overview, some of whose children were taken.
  struct Step {
    OverviewNode<T, D> node;
    Measure measure;
    LevelDistances distances;
    S outside;  // how far the query is from all that is here, squared
    S bound;    // how far the nearest of the others is, squared: good enough for an order
    void find_bound() {
      const S nearest = measure.squared(distances.least());
      bound = nearest > outside ? nearest : outside;
    }
  };
  void enter(std::uint32_t place, Step& step) const {
    step.node = core_.overview().node(place);
    const auto& node = step.node;
    step.measure = Measure(*node.frame, metric_.query());
    step.distances.compute(step.measure, node.levels, 2 * D, 0, D, node.count, node.count);
    step.outside = step.measure.squared_outside(*node.frame, metric_.query());
    step.find_bound();
  }
  /// Best first, since levels of the upper nodes do not tell what is on which side of their borders.
  void walk_overview() {
    SmallStack<Step, 8> steps;
    enter(0, steps.push());
    while (!steps.empty() && best_.wants(S{0})) {
      std::size_t nearest = steps.size() - 1;
      for (std::size_t i = nearest; i-- > 0;) {
        nearest = steps[i].bound < steps[nearest].bound ? i : nearest;
      }
      Step& step = steps[nearest];
      std::uint32_t at = 0;
      if (!take_child(step, at)) {
        if (nearest + 1 < steps.size()) step = steps.top();
        steps.drop();
        continue;
      }
      const OverviewChild& child = step.node.children[at];
      const ChildRef ref{child.bits};
      if (ref.is_leaf()) {
        prefetch(&core_.leaf(ref.index()));
        prefetch_block<Core>(core_.overview().block(child));
        step.find_bound();
        look_at(ref.index());
      } else {
        step.find_bound();
        enter(ref.index(), steps.push());
      }
    }
  }
  bool take_child(Step& step, std::uint32_t& at) const {
    if (!best_.full()) return step.distances.take_nearest(at);
    const S radius = metric_.radius(best_.worst());
    std::uint64_t near = step.distances.at_most(step.measure.limit(radius));
    if (near == 0) return false;
    Point<S, D> low, high;
    metric_.reach(radius, low, high);
    const LevelBounds<D> reach = step.node.frame->bounds(low, high);
    do {
      at = step.distances.take_nearest_of(near);
      if (step.node.reaches(at, reach)) return true;
      near &= ~(std::uint64_t{1} << at);
    } while (near != 0);
    return false;
  }

  // --- leaves ---

  void look_at(std::uint32_t index) {
    const LeafType& leaf = core_.leaf(index);
    leaf.is_flat() ? look_at<true>(leaf, index) : look_at<false>(leaf, index);
  }
  template <bool OfPoints>
  void look_at(const LeafType& leaf, std::uint32_t index) {
    // A leaf may be big, and what it holds first be all that is needed.
    for (std::uint32_t begin = 0; begin < leaf.count && best_.wants(S{0}); begin += level_bits) {
      const std::uint32_t count = leaf.count - begin < level_bits ? leaf.count - begin : level_bits;
      std::uint64_t near = first_level_bits(count);
      const std::size_t missing = best_.full() ? 0 : best_.missing();
      if (missing < count && metric_.reaches_any()) {
        constexpr std::size_t rows = OfPoints ? D : 2 * D;
        const Measure measure(leaf.frame(), metric_.query());
        LevelDistances distances;
        distances.compute(measure, leaf.levels(begin), rows, 0, rows - D, count, leaf.capacity - begin);
        std::uint64_t done = 0;
        if (missing > 0) {
          // The nearest by their levels, so that soon there are enough.
          done = distances.at_most(distances.enclosing(static_cast<std::uint32_t>(missing)));
          add<OfPoints>(leaf, index, begin, done);
        }
        near = distances.at_most(measure.limit(metric_.radius(best_.worst()))) & ~done;
      }
      add<OfPoints>(leaf, index, begin, near);
    }
  }
  template <bool OfPoints>
  void add(const LeafType& leaf, std::uint32_t index, std::uint32_t begin, std::uint64_t which) {
    constexpr std::size_t high = OfPoints ? 0 : D;
    const T* const boxes = leaf.coordinates(begin);
    // First all keys: what follows are branches that are taken at random.
    S keys[level_bits];
    std::uint8_t positions[level_bits];
    std::size_t count = 0;
    const S worst = best_.worst();
    for (; which != 0; which &= which - 1) {
      const auto at = static_cast<std::uint32_t>(std::countr_zero(which));
      const T* from = boxes + at * (D + high);
      keys[count] = metric_.key(from, from + high);
      positions[count] = static_cast<std::uint8_t>(at);
      count += keys[count] <= worst ? 1 : 0;
    }
    if constexpr (!all_pass) {
      // A filter may be expensive: it is asked of nothing that is not wanted.
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = begin + positions[i];
        if (best_.wants(keys[i]) && filter_.test(leaf.box(at), unwrap(leaf.values()[at])))
          best_.add(index, begin, keys + i, positions + i, 1);
      }
      return;
    }
    best_.add(index, begin, keys, positions, count);
  }

  const Core& core_;
  const Metric& metric_;
  const Filter& filter_;
  Smallest<S> best_;
};

/// Calls `visit(item)` for the `limit` elements with the smallest keys, in order, until it returns false.
template <class Core, class Metric, class Filter, class Visit>
void visit_first(const Core& core, const Metric& metric, const Filter& filter, std::size_t limit,
                 Visit&& visit) {
  if (limit == 0) return;
  FirstSearch<Core, Metric, Filter> search(core, metric, filter, limit);
  search.run();
  search.visit_in_order(visit);
}

}  // namespace spatial::detail

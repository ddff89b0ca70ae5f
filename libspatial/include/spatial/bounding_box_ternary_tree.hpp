/// @file
/// The bounding box ternary tree (BBTT, §5.1): a dynamic container of boxes with values, for finding those
/// that intersect a box, contain a point, are nearest, ... In: boxes and values. Out: handles, values, hits.
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "box.hpp"
#include "detail/holder.hpp"
#include "detail/inspect.hpp"
#include "detail/ordered_search.hpp"
#include "detail/pairs.hpp"
#include "detail/search.hpp"
#include "detail/tree_core.hpp"
#include "detail/visitor.hpp"
#include "handle.hpp"
#include "predicates.hpp"
#include "query_range.hpp"
#include "tree_statistics.hpp"

namespace spatial {

/// Reads the box of a value: the value itself if it is a geometry, else its member `first` (as of a pair).
template <class T, std::size_t D>
struct DefaultBoxOf {
  template <class V>
    requires Geometry<V, T, D>
  constexpr Box<T, D> operator()(const V& value) const {
    return to_box<T, D>(value);
  }
  template <class V>
    requires(!Geometry<V, T, D>) && requires(const V& v) { to_box<T, D>(v.first); }
  constexpr Box<T, D> operator()(const V& value) const {
    return to_box<T, D>(value.first);
  }
};

/// Compares values with ==.
struct DefaultEqual {
  template <class V>
  constexpr bool operator()(const V& a, const V& b) const {
    return a == b;
  }
};

/// A container of values with boxes.
/// @tparam Value     anything that can be moved; one whose move may throw is kept behind a pointer
/// @tparam T         float, double or an integer type
/// @tparam D         number of axes, 1 to 31
/// @tparam BoxOf     gives the box of a value, for the functions that take no box
/// @tparam Equal     compares values, for the functions that look for a value
/// @tparam Allocator of all memory; values that use allocators get it too
///
/// Handles stay valid until their element is erased. References, iterators and query ranges are invalidated
/// by every change. Any number of threads may use const member functions at the same time. If a user's copy
/// or the allocator throws, the function that was called has no effect. At most 2^31 elements.
template <class Value, class T, std::size_t D, class BoxOf = DefaultBoxOf<T, D>, class Equal = DefaultEqual,
          class Allocator = std::allocator<Value>>
class BoundingBoxTernaryTree {
  static_assert(D >= 1 && D <= 31, "one bit per axis in 32 bits");
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
  using Stored = detail::Stored<Value>;
  using Core = detail::TreeCore<Stored, T, D, Allocator>;
  using Leaf = typename Core::LeafType;
  using AllocatorTraits = std::allocator_traits<Allocator>;

 public:
  using value_type = Value;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using allocator_type = Allocator;
  using reference = const Value&;
  using const_reference = const Value&;
  using box_type = Box<T, D>;
  using const_iterator = TreeIterator<Value, Core>;
  using iterator = const_iterator;

  BoundingBoxTernaryTree() : BoundingBoxTernaryTree(Allocator()) {}
  explicit BoundingBoxTernaryTree(const Allocator& allocator) : core_(allocator) {}
  explicit BoundingBoxTernaryTree(BoxOf box_of, Equal equal = {}, const Allocator& allocator = {})
      : core_(allocator), box_of_(std::move(box_of)), equal_(std::move(equal)) {}

  /// Built from a range, see insert(first, last).
  template <std::input_iterator I, std::sentinel_for<I> S>
  BoundingBoxTernaryTree(I first, S last, BoxOf box_of = {}, Equal equal = {},
                         const Allocator& allocator = {})
      : core_(allocator), box_of_(std::move(box_of)), equal_(std::move(equal)) {
    insert(std::move(first), std::move(last));
  }

  BoundingBoxTernaryTree(const BoundingBoxTernaryTree& other)
    requires std::copy_constructible<Value>
      : BoundingBoxTernaryTree(
            other, AllocatorTraits::select_on_container_copy_construction(other.get_allocator())) {}
  BoundingBoxTernaryTree(const BoundingBoxTernaryTree& other, const Allocator& allocator)
    requires std::copy_constructible<Value>
      : core_(allocator), box_of_(other.box_of_), equal_(other.equal_) {
    core_.assign_from(other.core_, [&](const Stored& v) {
      return detail::wrap<Value>(get_allocator(), detail::unwrap(v));
    });
  }
  /// The other tree is empty afterwards.
  BoundingBoxTernaryTree(BoundingBoxTernaryTree&& other) noexcept
      : core_(other.get_allocator()), box_of_(std::move(other.box_of_)), equal_(std::move(other.equal_)) {
    core_.swap(other.core_);
  }
  BoundingBoxTernaryTree(BoundingBoxTernaryTree&& other, const Allocator& allocator)
      : core_(allocator), box_of_(other.box_of_), equal_(other.equal_) {
    take(other);
  }
  BoundingBoxTernaryTree& operator=(const BoundingBoxTernaryTree& other)
    requires std::copy_constructible<Value>
  {
    if (this != &other) {
      BoundingBoxTernaryTree copy(other, AllocatorTraits::propagate_on_container_copy_assignment::value
                                             ? other.get_allocator()
                                             : get_allocator());
      replace_by(copy);
    }
    return *this;
  }
  BoundingBoxTernaryTree& operator=(BoundingBoxTernaryTree&& other) noexcept(
      AllocatorTraits::propagate_on_container_move_assignment::value ||
      AllocatorTraits::is_always_equal::value) {
    if (this != &other) {
      BoundingBoxTernaryTree moved(std::move(other),
                                   AllocatorTraits::propagate_on_container_move_assignment::value
                                       ? other.get_allocator()
                                       : get_allocator());
      replace_by(moved);
    }
    return *this;
  }
  ~BoundingBoxTernaryTree() = default;

  /// @pre the allocators are equal, or are swapped too
  void swap(BoundingBoxTernaryTree& other) noexcept {
    core_.swap(other.core_);
    using std::swap;
    swap(box_of_, other.box_of_);
    swap(equal_, other.equal_);
  }
  friend void swap(BoundingBoxTernaryTree& a, BoundingBoxTernaryTree& b) noexcept { a.swap(b); }

  [[nodiscard]] allocator_type get_allocator() const { return core_.allocator(); }
  [[nodiscard]] size_type size() const { return core_.size(); }
  [[nodiscard]] bool empty() const { return core_.size() == 0; }
  /// The smallest box that encloses all elements, also after erasing; empty_box() of an empty tree. O(1),
  /// except after erasing from a leaf of more than 384 elements.
  [[nodiscard]] box_type bounds() const { return core_.bounds(); }

  [[nodiscard]] const_iterator begin() const { return {core_, 0}; }
  [[nodiscard]] const_iterator end() const {
    return {core_, static_cast<std::uint32_t>(core_.leaf_capacity())};
  }

  /// Adds an element. Amortised O(log n) for boxes that can be told apart.
  /// @return its handle; an invalid one, and no change, if the box has a NaN or min > max
  template <class G>
    requires Geometry<G, T, D>
  Handle insert(const G& geometry, Value value) {
    const box_type box = to_box<T, D>(geometry);
    if (!is_valid(box)) return {};
    return handle_of(core_.insert(box, detail::wrap<Value>(get_allocator(), std::move(value))));
  }
  Handle insert(Value value)
    requires std::is_invocable_r_v<box_type, const BoxOf&, const Value&>
  {
    const box_type box = box_of_(static_cast<const Value&>(value));
    return insert(box, std::move(value));
  }

  /// Adds many elements: values, where BoxOf applies to them, else (box, value) pairs. Faster than one by one
  /// for a tree that at least doubles, which is built anew. O(n log n).
  /// @param handles receives one handle per element, invalid for those that were refused
  /// @return the number of elements added
  template <std::input_iterator I, std::sentinel_for<I> S, std::output_iterator<Handle> O>
  size_type insert(I first, S last, O handles) {
    std::vector<detail::BuildEntry<T, D>> entries;
    std::vector<Stored> values;
    if constexpr (std::sized_sentinel_for<S, I>) {
      entries.reserve(static_cast<size_type>(last - first));
      values.reserve(static_cast<size_type>(last - first));
    }
    const size_type first_slot = core_.slot_capacity();
    for (; first != last; ++first) {
      auto&& item = *first;
      box_type box;
      if constexpr (std::is_convertible_v<decltype(item), Value>) {
        values.push_back(detail::wrap<Value>(get_allocator(), std::forward<decltype(item)>(item)));
        box = box_of_(static_cast<const Value&>(detail::unwrap(values.back())));
      } else {
        box = to_box<T, D>(item.first);
        values.push_back(detail::wrap<Value>(get_allocator(), std::forward<decltype(item)>(item).second));
      }
      if (is_valid(box)) entries.push_back({box, static_cast<std::uint32_t>(first_slot + values.size() - 1)});
    }
    const size_type added = entries.size();
    if (values.size() >= size()) {
      core_.insert_all(entries, values);
      for (size_type id = first_slot; id < core_.slot_capacity(); ++id) {
        const auto slot = static_cast<std::uint32_t>(id);
        *handles++ = core_.slot(slot).leaf == Core::none ? Handle{} : handle_of(slot);
      }
    } else {
      size_type next = 0;
      for (size_type i = 0; i < values.size(); ++i) {
        if (next == entries.size() || entries[next].id != first_slot + i) {
          *handles++ = Handle{};
        } else {
          *handles++ = handle_of(core_.insert(entries[next++].box, std::move(values[i])));
        }
      }
    }
    return added;
  }
  template <std::input_iterator I, std::sentinel_for<I> S>
  size_type insert(I first, S last) {
    return insert(std::move(first), std::move(last), detail::NoHandles{});
  }

  /// Gives an element another box. Amortised O(log n), and O(1) where it stays in its leaf.
  /// @return false, and no change, if the handle is stale or the box is not valid
  template <class G>
    requires Geometry<G, T, D>
  bool move(Handle handle, const G& geometry) {
    const box_type box = to_box<T, D>(geometry);
    if (!contains(handle) || !is_valid(box)) return false;
    core_.move(handle.index, box);
    return true;
  }

  /// Removes an element. O(log n). @return false if the handle is stale
  bool erase(Handle handle) {
    if (!contains(handle)) return false;
    core_.erase(handle.index);
    return true;
  }
  /// Removes one element equal to the value, whose box is BoxOf of the value. @return how many were removed,
  /// 0 or 1
  size_type erase(const Value& value)
    requires std::is_invocable_r_v<box_type, const BoxOf&, const Value&>
  {
    return erase(find(value)) ? 1 : 0;
  }
  /// Removes all elements that satisfy a predicate. @return how many
  template <Predicate P>
  size_type erase_if(const P& predicate) {
    std::vector<std::uint32_t> found;
    detail::search(core_, detail::bind<T, D>(predicate), [&](const Leaf& leaf, std::uint32_t at) {
      found.push_back(leaf.ids()[at]);
      return true;
    });
    for (const std::uint32_t id : found) core_.erase(id);
    return found.size();
  }
  /// Removes an element and returns its value. @pre contains(handle)
  Value extract(Handle handle) {
    Stored stored = core_.erase(handle.index);
    return std::move(detail::unwrap(stored));
  }

  /// Removes everything. All handles become stale. O(n).
  void clear() noexcept { core_.clear(); }

  /// True if the element of this handle is still there.
  [[nodiscard]] bool contains(Handle handle) const { return core_.is_alive(handle.index, handle.generation); }
  /// One element equal to the value, whose box is BoxOf of the value; an invalid handle if there is none.
  [[nodiscard]] Handle find(const Value& value) const
    requires std::is_invocable_r_v<box_type, const BoxOf&, const Value&>
  {
    Handle result;
    find_equal(value, [&](std::uint32_t id) {
      result = handle_of(id);
      return false;
    });
    return result;
  }
  [[nodiscard]] bool contains(const Value& value) const
    requires std::is_invocable_r_v<box_type, const BoxOf&, const Value&>
  {
    return find(value).valid();
  }
  [[nodiscard]] size_type count(const Value& value) const
    requires std::is_invocable_r_v<box_type, const BoxOf&, const Value&>
  {
    size_type result = 0;
    find_equal(value, [&](std::uint32_t) {
      ++result;
      return true;
    });
    return result;
  }
  /// The number of elements that satisfy a predicate.
  template <Predicate P>
  [[nodiscard]] size_type count(const P& predicate) const {
    size_type result = 0;
    detail::search(core_, detail::bind<T, D>(predicate), [&](const Leaf&, std::uint32_t) {
      ++result;
      return true;
    });
    return result;
  }

  /// The value may be changed; if BoxOf then gives another box, move() the element too. @pre contains(handle)
  [[nodiscard]] const Value& value(Handle handle) const { return detail::unwrap(core_.value(handle.index)); }
  [[nodiscard]] Value& value(Handle handle) { return detail::unwrap(core_.value(handle.index)); }
  /// @pre contains(handle)
  [[nodiscard]] box_type box(Handle handle) const { return core_.box(handle.index); }

  /// Finds the elements that satisfy a predicate, in no particular order; those of an ordered predicate in
  /// its order.
  /// @param sink an output iterator that receives copies of the values, or a visitor: a function of (const
  /// Value&) or
  ///        (const Value&, Handle), for ordered predicates also (const Value&, Handle, distance). A visitor
  ///        that returns something is asked to go on by true, and stops the query by false.
  /// @return the number of elements that the sink received
  template <Predicate P, class Sink>
  size_type query(const P& predicate, Sink&& sink) const {
    size_type found = 0;
    detail::search(core_, detail::bind<T, D>(predicate), [&](const Leaf& leaf, std::uint32_t at) {
      ++found;
      return detail::give<Value>(sink, detail::unwrap(leaf.values()[at]),
                                 [&] { return handle_of(leaf.ids()[at]); });
    });
    return found;
  }
  template <OrderedPredicate P, class Sink>
  size_type query(const P& predicate, Sink&& sink) const {
    return ordered_query(predicate, detail::Everything<T, D>{}, sink);
  }
  template <class O, class F, class Sink>
  size_type query(const FilteredPredicate<O, F>& predicate, Sink&& sink) const {
    return ordered_query(predicate.ordered, detail::bind<T, D>(predicate.filter), sink);
  }

  /// The same as a lazy input range: an element is looked for when the iterator gets there.
  template <Predicate P>
  [[nodiscard]] auto query(const P& predicate) const {
    using Cursor = detail::Cursor<Core, decltype(detail::bind<T, D>(predicate))>;
    return QueryRange<Value, Core, Cursor>(core_, Cursor(core_, detail::bind<T, D>(predicate)));
  }
  template <OrderedPredicate P>
  [[nodiscard]] auto query(const P& predicate) const {
    return ordered_range(predicate, detail::Everything<T, D>{});
  }
  template <class O, class F>
  [[nodiscard]] auto query(const FilteredPredicate<O, F>& predicate) const {
    return ordered_range(predicate.ordered, detail::bind<T, D>(predicate.filter));
  }

  /// Visits every pair of elements whose boxes intersect, each pair once, none with itself.
  /// @param visitor a function of (const Value&, const Value&) or (const Value&, Handle, const Value&,
  /// Handle); returns
  ///        void, or whether to go on
  /// @return the number of pairs visited
  template <class Visitor>
  size_type pairs(Visitor&& visitor) const {
    size_type found = 0;
    detail::self_pairs(core_, [&](const Leaf& a, std::uint32_t i, const Leaf& b, std::uint32_t j) {
      ++found;
      return detail::give_pair<Value, Value>(
          visitor, detail::unwrap(a.values()[i]), [&] { return handle_of(a.ids()[i]); },
          detail::unwrap(b.values()[j]), [&] { return handle_of(b.ids()[j]); });
    });
    return found;
  }
  /// The same between the elements of this tree and those of another.
  template <class V2, class B2, class E2, class A2, class Visitor>
  size_type pairs_with(const BoundingBoxTernaryTree<V2, T, D, B2, E2, A2>& other, Visitor&& visitor) const {
    size_type found = 0;
    detail::tree_pairs(core_, other.core_,
                       [&](const Leaf& a, std::uint32_t i, const auto& b, std::uint32_t j) {
                         ++found;
                         return detail::give_pair<Value, V2>(
                             visitor, detail::unwrap(a.values()[i]), [&] { return handle_of(a.ids()[i]); },
                             detail::unwrap(b.values()[j]), [&] { return other.handle_of(b.ids()[j]); });
                       });
    return found;
  }

  /// Every rule of the data structure that does not hold, in words; always empty unless there is a bug. O(n).
  [[nodiscard]] std::vector<const char*> validate() const { return detail::validate(core_); }
  /// O(n).
  [[nodiscard]] TreeStatistics statistics() const { return detail::statistics(core_); }
  /// What a query with this predicate looks at.
  template <Predicate P>
  [[nodiscard]] QueryStatistics query_statistics(const P& predicate) const {
    detail::Counts counts;
    detail::search(
        core_, detail::bind<T, D>(predicate),
        [&](const Leaf&, std::uint32_t) {
          ++counts.result.hits;
          return true;
        },
        counts);
    return counts.result;
  }
  /// Calls `visitor(const NodeView<T, D>&)` for every node and leaf, parents first: enough to draw the tree.
  /// O(n).
  template <class Visitor>
  void visit_nodes(Visitor&& visitor) const {
    detail::visit_nodes(core_, visitor);
  }

 private:
  template <class V2, class T2, std::size_t D2, class B2, class E2, class A2>
  friend class BoundingBoxTernaryTree;

  [[nodiscard]] Handle handle_of(std::uint32_t slot) const { return {slot, core_.slot(slot).generation}; }

  // Takes over what another tree holds: its memory if the allocators are equal, else each value.
  void take(BoundingBoxTernaryTree& other) {
    if (get_allocator() == other.get_allocator()) {
      core_.swap(other.core_);
      return;
    }
    core_.assign_from(other.core_, [&](Stored& v) {
      return detail::wrap<Value>(get_allocator(), std::move(detail::unwrap(v)));
    });
    other.clear();
  }
  // The other tree's allocator is the one that this tree is to have from now on.
  void replace_by(BoundingBoxTernaryTree& other) noexcept {
    core_.replace_by(other.core_);
    box_of_ = std::move(other.box_of_);
    equal_ = std::move(other.equal_);
  }

  template <class Visit>
  void find_equal(const Value& value, Visit&& visit) const {
    const box_type box = box_of_(value);
    detail::search(core_, detail::bind<T, D>(covers(box)), [&](const Leaf& leaf, std::uint32_t at) {
      return !(leaf.box(at) == box && equal_(detail::unwrap(leaf.values()[at]), value)) ||
             visit(leaf.ids()[at]);
    });
  }

  template <class P, class Filter, class Sink>
  size_type ordered_query(const P& predicate, const Filter& filter, Sink& sink) const {
    const auto metric = detail::metric<T, D>(predicate);
    using Metric = std::remove_const_t<decltype(metric)>;
    size_type found = 0;
    const auto hand_over = [&](const Leaf& leaf, std::uint32_t at, auto distance) {
      ++found;
      return detail::give<Value>(
          sink, detail::unwrap(leaf.values()[at]), [&] { return handle_of(leaf.ids()[at]); }, distance);
    };
    const size_type limit = detail::count_limit(predicate);
    if (limit < size()) {
      detail::visit_first(core_, metric, filter, limit, [&](const auto& each) {
        return hand_over(core_.leaf(each.place.index()), each.position, Metric::distance(each.key));
      });
    } else {
      detail::OrderedCursor<Core, Metric, Filter> cursor(core_, metric, filter, limit);
      while (cursor.next()) {
        if (!hand_over(cursor.leaf(), cursor.position(), cursor.distance())) break;
      }
    }
    return found;
  }
  template <class P, class Filter>
  auto ordered_range(const P& predicate, const Filter& filter) const {
    const auto metric = detail::metric<T, D>(predicate);
    using Cursor = detail::OrderedCursor<Core, std::remove_const_t<decltype(metric)>, Filter>;
    return QueryRange<Value, Core, Cursor>(core_,
                                           Cursor(core_, metric, filter, detail::count_limit(predicate)));
  }

  Core core_;
  [[no_unique_address]] BoxOf box_of_{};
  [[no_unique_address]] Equal equal_{};
};

}  // namespace spatial

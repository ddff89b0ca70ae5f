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
#include "detail/search.hpp"
#include "detail/visitor.hpp"
#include "handle.hpp"
#include "predicates.hpp"
#include "tree_queries.hpp"
#include "value_box.hpp"

namespace spatial {

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
class BoundingBoxTernaryTree : public TreeQueries<Value, T, D, BoxOf, Equal, Allocator> {
  static_assert(D >= 1 && D <= 31, "one bit per axis in 32 bits");
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
  using Queries = TreeQueries<Value, T, D, BoxOf, Equal, Allocator>;
  using typename Queries::Core;
  using typename Queries::Leaf;
  using typename Queries::Stored;
  using AllocatorTraits = std::allocator_traits<Allocator>;
  using Queries::box_of_;
  using Queries::core_;
  using Queries::equal_;
  using Queries::handle_of;

 public:
  using Queries::contains;
  using Queries::find;
  using Queries::get_allocator;
  using Queries::size;
  using Queries::value;
  using typename Queries::box_type;
  using typename Queries::size_type;

  BoundingBoxTernaryTree() : BoundingBoxTernaryTree(Allocator()) {}
  explicit BoundingBoxTernaryTree(const Allocator& allocator) : Queries(allocator) {}
  explicit BoundingBoxTernaryTree(BoxOf box_of, Equal equal = {}, const Allocator& allocator = {})
      : Queries(allocator, std::move(box_of), std::move(equal)) {}

  /// Built from a range, see insert(first, last).
  template <std::input_iterator I, std::sentinel_for<I> S>
  BoundingBoxTernaryTree(I first, S last, BoxOf box_of = {}, Equal equal = {},
                         const Allocator& allocator = {})
      : Queries(allocator, std::move(box_of), std::move(equal)) {
    insert(std::move(first), std::move(last));
  }

  BoundingBoxTernaryTree(const BoundingBoxTernaryTree& other)
    requires std::copy_constructible<Value>
      : BoundingBoxTernaryTree(
            other, AllocatorTraits::select_on_container_copy_construction(other.get_allocator())) {}
  BoundingBoxTernaryTree(const BoundingBoxTernaryTree& other, const Allocator& allocator)
    requires std::copy_constructible<Value>
      : Queries(allocator, other.box_of_, other.equal_) {
    core_.assign_from(other.core_, [&](const Stored& v) {
      return detail::wrap<Value>(get_allocator(), detail::unwrap(v));
    });
  }
  /// The other tree is empty afterwards.
  BoundingBoxTernaryTree(BoundingBoxTernaryTree&& other) noexcept
      : Queries(other.get_allocator(), std::move(other.box_of_), std::move(other.equal_)) {
    core_.swap(other.core_);
  }
  BoundingBoxTernaryTree(BoundingBoxTernaryTree&& other, const Allocator& allocator)
      : Queries(allocator, other.box_of_, other.equal_) {
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
      constexpr bool wants_handles = !std::is_same_v<O, detail::NoHandles>;
      core_.insert_all(entries, values, wants_handles);
      for (size_type id = first_slot; wants_handles && id < core_.slot_capacity(); ++id) {
        const auto slot = static_cast<std::uint32_t>(id);
        *handles++ = core_.place(slot).leaf == Core::none ? Handle{} : handle_of(slot);
      }
    } else {
      const std::vector<std::uint32_t> slots = core_.insert_each(entries, values);
      size_type next = 0;
      for (size_type i = 0; i < values.size(); ++i) {
        const bool is_refused = next == entries.size() || entries[next].id != first_slot + i;
        *handles++ = is_refused ? Handle{} : handle_of(slots[next++]);
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
      found.push_back(leaf.id(at));
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

  /// The value may be changed; if BoxOf then gives another box, move() the element too. @pre contains(handle)
  [[nodiscard]] Value& value(Handle handle) { return detail::unwrap(core_.value(handle.index)); }

  /// Removes everything. All handles become stale. O(n).
  void clear() noexcept { core_.clear(); }

 private:
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
};

}  // namespace spatial

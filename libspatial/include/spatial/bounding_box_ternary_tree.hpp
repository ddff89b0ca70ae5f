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

#include "box.hpp"
#include "detail/search.hpp"
#include "detail/tree_core.hpp"
#include "handle.hpp"
#include "predicates.hpp"

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
/// @tparam Value anything that can be moved, without throwing
/// @tparam T     float, double or an integer type
/// @tparam D     number of axes, at least 1
/// @tparam BoxOf gives the box of a value, for the functions that take no box
/// @tparam Equal compares values, for the functions that look for a value
///
/// Handles stay valid until their element is erased. References, iterators and cursors are invalidated by
/// every change. Any number of threads may use const member functions at the same time.
template <class Value, class T, std::size_t D, class BoxOf = DefaultBoxOf<T, D>, class Equal = DefaultEqual,
          class Allocator = std::allocator<Value>>
class BoundingBoxTernaryTree {
  static_assert(D >= 1 && D <= 31, "one bit per axis in 32 bits");
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
  static_assert(std::is_nothrow_move_constructible_v<Value>);
  using Core = detail::TreeCore<Value, T, D, Allocator>;

 public:
  using value_type = Value;
  using size_type = std::size_t;
  using allocator_type = Allocator;
  using box_type = Box<T, D>;

  BoundingBoxTernaryTree() : BoundingBoxTernaryTree(Allocator()) {}
  explicit BoundingBoxTernaryTree(const Allocator& allocator) : core_(allocator) {}
  explicit BoundingBoxTernaryTree(BoxOf box_of, Equal equal = {}, const Allocator& allocator = {})
      : core_(allocator), box_of_(std::move(box_of)), equal_(std::move(equal)) {}

  /// Built from (box, value) pairs.
  template <std::input_iterator I, std::sentinel_for<I> S>
  BoundingBoxTernaryTree(I first, S last, const Allocator& allocator = {}) : core_(allocator) {
    for (; first != last; ++first) insert((*first).first, (*first).second);
  }

  [[nodiscard]] size_type size() const { return core_.size(); }
  [[nodiscard]] bool empty() const { return core_.size() == 0; }

  /// Adds an element. Amortised O(log n).
  /// @return its handle; an invalid one, and no change, if the box has a NaN or min > max
  template <class G>
    requires Geometry<G, T, D>
  Handle insert(const G& geometry, Value value) {
    const box_type box = to_box<T, D>(geometry);
    if (!is_valid(box)) return {};
    return handle_of(core_.insert(box, std::move(value)));
  }
  Handle insert(Value value)
    requires requires(const BoxOf& f, const Value& v) { f(v); }
  {
    const box_type box = box_of_(static_cast<const Value&>(value));
    return insert(box, std::move(value));
  }

  /// Gives an element another box. @return false, and no change, if the handle is stale or the box is not
  /// valid
  template <class G>
    requires Geometry<G, T, D>
  bool move(Handle handle, const G& geometry) {
    const box_type box = to_box<T, D>(geometry);
    if (!contains(handle) || !is_valid(box)) return false;
    core_.move(handle.index, box);
    return true;
  }

  /// Removes an element. @return false if the handle is stale
  bool erase(Handle handle) {
    if (!contains(handle)) return false;
    core_.erase(handle.index);
    return true;
  }

  /// Removes everything. All handles become stale.
  void clear() noexcept { core_.clear(); }

  /// True if the element of this handle is still there.
  [[nodiscard]] bool contains(Handle handle) const { return core_.is_alive(handle.index, handle.generation); }

  /// @pre contains(handle)
  [[nodiscard]] const Value& value(Handle handle) const { return core_.value(handle.index); }
  [[nodiscard]] Value& value(Handle handle) { return core_.value(handle.index); }
  [[nodiscard]] box_type box(Handle handle) const { return core_.box(handle.index); }

  /// Calls `visitor(const Value&)` or `visitor(const Value&, Handle)` for every element that satisfies the
  /// predicate, in no particular order. A visitor that returns something is asked to go on by true, and stops
  /// the query by false.
  /// @return the number of elements visited
  template <Predicate P, class Visitor>
  size_type query(const P& predicate, Visitor&& visitor) const {
    const auto bound = detail::bind<T, D>(predicate);
    size_type visited = 0;
    detail::search(core_, bound, [&](const typename Core::LeafType& leaf, std::uint32_t at) {
      ++visited;
      return call(visitor, leaf, at);
    });
    return visited;
  }

 private:
  [[nodiscard]] Handle handle_of(std::uint32_t slot) const { return {slot, core_.slot(slot).generation}; }

  template <class Visitor>
  bool call(Visitor& visitor, const typename Core::LeafType& leaf, std::uint32_t at) const {
    const Value& value = leaf.values()[at];
    if constexpr (std::is_invocable_v<Visitor&, const Value&>) {
      if constexpr (std::is_void_v<std::invoke_result_t<Visitor&, const Value&>>) {
        visitor(value);
        return true;
      } else {
        return static_cast<bool>(visitor(value));
      }
    } else {
      if constexpr (std::is_void_v<std::invoke_result_t<Visitor&, const Value&, Handle>>) {
        visitor(value, handle_of(leaf.ids()[at]));
        return true;
      } else {
        return static_cast<bool>(visitor(value, handle_of(leaf.ids()[at])));
      }
    }
  }

  Core core_;
  [[no_unique_address]] BoxOf box_of_{};
  [[no_unique_address]] Equal equal_{};
};

}  // namespace spatial

/// @file
/// What can be asked of a bounding box ternary tree (§5.1): the const half of BoundingBoxTernaryTree. In:
/// handles, values, predicates. Out: elements, pairs, statistics.
#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "box.hpp"
#include "detail/first_search.hpp"
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

template <class Value, class T, std::size_t D, class BoxOf, class Equal, class Allocator>
class BoundingBoxTernaryTree;

/// The base of BoundingBoxTernaryTree, where its parameters are explained. Any number of threads may use
/// these functions at the same time.
template <class Value, class T, std::size_t D, class BoxOf, class Equal, class Allocator>
class TreeQueries {
 protected:
  using Stored = detail::Stored<Value>;
  using Core = detail::TreeCore<Stored, T, D, Allocator>;
  using Leaf = typename Core::LeafType;

 public:
  TreeQueries(const TreeQueries&) = delete;
  TreeQueries& operator=(const TreeQueries&) = delete;

  using value_type = Value;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using allocator_type = Allocator;
  using reference = const Value&;
  using const_reference = const Value&;
  using box_type = Box<T, D>;
  using const_iterator = TreeIterator<Value, Core>;
  using iterator = const_iterator;

  [[nodiscard]] allocator_type get_allocator() const { return core_.allocator(); }
  [[nodiscard]] size_type size() const { return core_.size(); }
  [[nodiscard]] bool empty() const { return core_.size() == 0; }
  /// The smallest box that encloses all elements, also after erasing; empty_box() of an empty tree. O(1),
  /// except after erasing from a leaf of more than 384 elements.
  [[nodiscard]] box_type bounds() const { return core_.bounds(); }

  [[nodiscard]] const_iterator begin() const { return {core_, 0}; }
  [[nodiscard]] const_iterator end() const {
    return {core_, static_cast<std::uint32_t>(core_.leaves().size())};
  }

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

  /// @pre contains(handle)
  [[nodiscard]] const Value& value(Handle handle) const { return detail::unwrap(core_.value(handle.index)); }
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
                                 [&] { return handle_of(leaf.id(at)); });
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
          visitor, detail::unwrap(a.values()[i]), [&] { return handle_of(a.id(i)); },
          detail::unwrap(b.values()[j]), [&] { return handle_of(b.id(j)); });
    });
    return found;
  }
  /// The same between the elements of this tree and those of another.
  template <class V2, class B2, class E2, class A2, class Visitor>
  size_type pairs_with(const TreeQueries<V2, T, D, B2, E2, A2>& other, Visitor&& visitor) const {
    size_type found = 0;
    detail::tree_pairs(core_, other.core_,
                       [&](const Leaf& a, std::uint32_t i, const auto& b, std::uint32_t j) {
                         ++found;
                         return detail::give_pair<Value, V2>(
                             visitor, detail::unwrap(a.values()[i]), [&] { return handle_of(a.id(i)); },
                             detail::unwrap(b.values()[j]), [&] { return other.handle_of(b.id(j)); });
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

 protected:
  explicit TreeQueries(const Allocator& allocator, BoxOf box_of = {}, Equal equal = {})
      : core_(allocator), box_of_(std::move(box_of)), equal_(std::move(equal)) {}
  ~TreeQueries() = default;

  [[nodiscard]] Handle handle_of(std::uint32_t slot) const { return {slot, core_.generation(slot)}; }

 private:
  template <class V2, class T2, std::size_t D2, class B2, class E2, class A2>
  friend class TreeQueries;
  friend class BoundingBoxTernaryTree<Value, T, D, BoxOf, Equal, Allocator>;

  template <class Visit>
  void find_equal(const Value& value, Visit&& visit) const {
    const box_type box = box_of_(value);
    detail::search(core_, detail::bind<T, D>(covers(box)), [&](const Leaf& leaf, std::uint32_t at) {
      return !(leaf.box(at) == box && equal_(detail::unwrap(leaf.values()[at]), value)) || visit(leaf.id(at));
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
          sink, detail::unwrap(leaf.values()[at]), [&] { return handle_of(leaf.id(at)); }, distance);
    };
    const size_type limit = detail::count_limit(predicate);
    if constexpr (Metric::has_reach) {  // of a path all hits are wanted
      if (limit < size()) {
        detail::visit_first(core_, metric, filter, limit, [&](const auto& each) {
          return hand_over(core_.leaf(each.leaf), each.position, Metric::distance(each.key));
        });
        return found;
      }
    }
    detail::OrderedCursor<Core, Metric, Filter> cursor(core_, metric, filter, limit);
    while (cursor.next()) {
      if (!hand_over(cursor.leaf(), cursor.position(), cursor.distance())) break;
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

/// @file
/// What a query asks for, with the names of Boost.Geometry: an element's box RELATION a geometry, combined by
/// && || !. In: geometries and functions. Out: predicate objects, which a tree binds to its scalar type when
/// it is queried.
///
/// All boxes are closed. A geometry with a NaN or with min > max is the empty set: nothing intersects, covers
/// or is covered by it, and everything is disjoint from it.
#pragma once
#include <cstddef>
#include <type_traits>
#include <utility>

#include "box.hpp"

namespace spatial {

/// How an element's box e relates to the box q of a query.
enum class Relation {
  intersects,  ///< e and q have a point in common
  covered_by,  ///< no point of e is outside of q
  within,      ///< covered_by, and e does not lie in the border of q: a side of e without extent is strictly
               ///< inside
  covers,      ///< no point of q is outside of e
  contains,    ///< q is within e
  overlaps     ///< their interiors meet, and neither covers the other
};

/// An element's box in relation to a geometry.
template <Relation R, class G>
struct RelationPredicate {
  static constexpr bool is_spatial_predicate = true;
  G geometry;
};

/// A function of the value: `bool f(const Value&)`.
template <class F>
struct ValuePredicate {
  static constexpr bool is_spatial_predicate = true;
  F function;
};

/// A function of a box: `bool f(const Box<T, D>&)`.
template <class F>
struct BoxPredicate {
  static constexpr bool is_spatial_predicate = true;
  F function;
};

template <class A, class B>
struct AndPredicate {
  static constexpr bool is_spatial_predicate = true;
  A a;
  B b;
};
template <class A, class B>
struct OrPredicate {
  static constexpr bool is_spatial_predicate = true;
  A a;
  B b;
};
template <class A>
struct NotPredicate {
  static constexpr bool is_spatial_predicate = true;
  A a;
};

/// The k elements nearest to a geometry, in ascending order of the distance between the boxes.
template <class G>
struct NearestPredicate {
  static constexpr bool is_ordered_predicate = true;
  G geometry;
  std::size_t count;
};

/// The elements hit by the points origin + t * direction, 0 <= t <= limit, in ascending order of t.
template <class P, class T>
struct PathPredicate {
  static constexpr bool is_ordered_predicate = true;
  P origin;
  P direction;
  T limit;
};

/// An ordered predicate, of whose results only those that satisfy the filter count.
template <class O, class F>
struct FilteredPredicate {
  static constexpr bool is_ordered_predicate = true;
  O ordered;
  F filter;
};

template <class P>
concept Predicate = std::remove_cvref_t<P>::is_spatial_predicate;
template <class P>
concept OrderedPredicate = std::remove_cvref_t<P>::is_ordered_predicate;

template <class G>
[[nodiscard]] constexpr auto intersects(const G& g) {
  return RelationPredicate<Relation::intersects, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto covered_by(const G& g) {
  return RelationPredicate<Relation::covered_by, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto within(const G& g) {
  return RelationPredicate<Relation::within, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto covers(const G& g) {
  return RelationPredicate<Relation::covers, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto contains(const G& g) {
  return RelationPredicate<Relation::contains, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto overlaps(const G& g) {
  return RelationPredicate<Relation::overlaps, G>{g};
}
template <class G>
[[nodiscard]] constexpr auto disjoint(const G& g) {
  return NotPredicate<RelationPredicate<Relation::intersects, G>>{{g}};
}

/// Elements whose value satisfies `f`. It prunes nothing.
template <class F>
[[nodiscard]] constexpr auto satisfies(F f) {
  return ValuePredicate<F>{std::move(f)};
}

/// Elements whose box satisfies `f`, which is asked about the boxes of whole subtrees too and prunes them.
/// @pre `f` is true of every box that encloses a box of which it is true (as is "reaches into this frustum").
template <class F>
[[nodiscard]] constexpr auto box_satisfies(F f) {
  return BoxPredicate<F>{std::move(f)};
}

/// The `count` elements nearest to a point or box; elements that touch it are at distance 0. Ties in any
/// order.
template <class G>
[[nodiscard]] constexpr auto nearest(const G& g, std::size_t count) {
  return NearestPredicate<G>{g, count};
}

/// Elements hit by a ray, nearest first. The direction needs no normalisation; distances are multiples of it.
template <class T, std::size_t D>
[[nodiscard]] constexpr auto ray_hits(const Point<T, D>& origin, const Point<T, D>& direction) {
  using S = std::conditional_t<std::is_floating_point_v<T>, T, double>;
  using Limits = std::numeric_limits<S>;
  return PathPredicate<Point<T, D>, S>{origin, direction, Limits::infinity()};
}

/// Elements hit by the segment between two points, in order from the first; distances are fractions of its
/// length.
template <class T, std::size_t D>
[[nodiscard]] constexpr auto segment_hits(const Point<T, D>& from, const Point<T, D>& to) {
  using S = std::conditional_t<std::is_floating_point_v<T>, T, double>;
  Point<S, D> origin{};
  Point<S, D> direction{};
  for (std::size_t a = 0; a < D; ++a) {
    origin[a] = static_cast<S>(from[a]);
    direction[a] = static_cast<S>(to[a]) - static_cast<S>(from[a]);
  }
  return PathPredicate<Point<S, D>, S>{origin, direction, S{1}};
}

template <Predicate A, Predicate B>
[[nodiscard]] constexpr auto operator&&(A a, B b) {
  return AndPredicate<A, B>{std::move(a), std::move(b)};
}
template <Predicate A, Predicate B>
[[nodiscard]] constexpr auto operator||(A a, B b) {
  return OrPredicate<A, B>{std::move(a), std::move(b)};
}
template <Predicate A>
[[nodiscard]] constexpr auto operator!(A a) {
  return NotPredicate<A>{std::move(a)};
}
template <OrderedPredicate O, Predicate F>
[[nodiscard]] constexpr auto operator&&(O ordered, F filter) {
  return FilteredPredicate<O, F>{std::move(ordered), std::move(filter)};
}
template <Predicate F, OrderedPredicate O>
[[nodiscard]] constexpr auto operator&&(F filter, O ordered) {
  return FilteredPredicate<O, F>{std::move(ordered), std::move(filter)};
}

}  // namespace spatial

/// @file
/// Predicates as the search uses them, bound to the tree's scalar type. Each answers four questions:
///   test(box, value)  does this element satisfy it?
///   may(box)          could an element inside of this box?        (prunes)
///   must(box)         does every element inside of this box?      (makes ! prune: what may not is what must
///   be)
///   hits(leaf, begin, count)  which of these elements do?        (the wide form of test)
///   may_mask(rows)            which of three children may?       (the wide form of may)
/// In: predicate objects. Out: yes, no, or a bit per element.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "../box.hpp"
#include "../predicates.hpp"
#include "cell.hpp"
#include "holder.hpp"
#include "lanes.hpp"
#include "levels.hpp"

namespace spatial::detail {

/// Those of the elements in `bits` that satisfy a predicate.
template <class Predicate, class Leaf>
std::uint64_t passing(const Predicate& predicate, const Leaf& leaf, std::uint32_t begin, std::uint64_t bits) {
  std::uint64_t result = 0;
  const auto boxes = leaf.boxes();
  const auto* values = leaf.values();
  for (; bits != 0; bits &= bits - 1) {
    const std::uint32_t at = begin + static_cast<std::uint32_t>(std::countr_zero(bits));
    if (predicate.test(boxes[at], unwrap(values[at]))) result |= bits & (~bits + 1);
  }
  return result;
}

/// The wide forms in terms of the narrow ones.
template <class Self, class T, std::size_t D>
struct OneByOne {
  [[nodiscard]] std::uint32_t may_mask(const Rows<T, D>& rows) const {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      result |= static_cast<std::uint32_t>(self().may(rows.box(i))) << i;
    }
    return result;
  }
  /// may_mask for three children; four bits higher, some of those of which nothing needs to be tested.
  [[nodiscard]] std::uint32_t may_and_must(const Rows<T, D>& rows) const { return self().may_mask(rows); }
  template <class Leaf>
  [[nodiscard]] std::uint64_t hits(const Leaf& leaf, std::uint32_t begin, std::uint32_t count) const {
    return passing(self(), leaf, begin, first_level_bits(count));
  }

 private:
  [[nodiscard]] const Self& self() const { return static_cast<const Self&>(*this); }
};

/// e is inside of q, and no side of e lies in the border of q.
template <class T, std::size_t D>
bool is_within(const Box<T, D>& e, const Box<T, D>& q) {
  bool result = true;
  for (std::size_t a = 0; a < D; ++a) {
    const bool flat = e.min[a] == e.max[a];
    result &=
        flat ? q.min[a] < e.min[a] && e.max[a] < q.max[a] : q.min[a] <= e.min[a] && e.max[a] <= q.max[a];
  }
  return result;
}

template <class T, std::size_t D>
bool is_strictly_inside(const Box<T, D>& e, const Box<T, D>& q) {
  bool result = true;
  for (std::size_t a = 0; a < D; ++a) result &= q.min[a] < e.min[a] && e.max[a] < q.max[a];
  return result;
}

template <class T, std::size_t D>
bool interiors_meet(const Box<T, D>& e, const Box<T, D>& q) {
  bool result = true;
  for (std::size_t a = 0; a < D; ++a) result &= e.min[a] < q.max[a] && q.min[a] < e.max[a];
  return result;
}

template <Relation R, class T, std::size_t D>
class BoundRelation : public OneByOne<BoundRelation<R, T, D>, T, D> {
 public:
  explicit BoundRelation(const Box<T, D>& query) : q_(query), valid_(is_valid(query)) {}

  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>& e, const Value&) const {
    if (!valid_) return false;
    if constexpr (R == Relation::intersects) return touch(e, q_);
    if constexpr (R == Relation::covered_by) return encloses(q_, e);
    if constexpr (R == Relation::within) return is_within(e, q_);
    if constexpr (R == Relation::covers) return encloses(e, q_);
    if constexpr (R == Relation::contains) return is_within(q_, e);
    if constexpr (R == Relation::overlaps)
      return interiors_meet(e, q_) && !encloses(q_, e) && !encloses(e, q_);
  }
  [[nodiscard]] bool may(const Box<T, D>& node) const {
    if (!valid_) return false;
    if constexpr (R == Relation::covers || R == Relation::contains) return encloses(node, q_);
    if constexpr (R == Relation::overlaps) return touch(node, q_) && !encloses(q_, node);
    return touch(node, q_);
  }
  [[nodiscard]] bool must(const Box<T, D>& node) const {
    if (!valid_) return false;
    if constexpr (R == Relation::intersects || R == Relation::covered_by) return encloses(q_, node);
    if constexpr (R == Relation::within) return is_strictly_inside(node, q_);
    return false;
  }
  [[nodiscard]] std::uint32_t may_mask(const Rows<T, D>& rows) const {
    if (!valid_) return 0;
    if constexpr (R == Relation::covers || R == Relation::contains) return reaching(rows, q_.max, q_.min);
    return reaching(rows, q_.min, q_.max);
  }
  [[nodiscard]] std::uint32_t may_and_must(const Rows<T, D>& rows) const {
    const std::uint32_t may = may_mask(rows);
    if constexpr (R == Relation::intersects || R == Relation::covered_by) {
      // A query that reaches one child only is rarely big enough to cover it.
      if ((may & (may - 1)) != 0) return may | (may & covered(rows, q_.min, q_.max)) << 4;
    }
    return may;
  }
  /// Of the children of a node of the overview those that may; some that must.
  template <class Wide>
  [[nodiscard]] std::uint64_t wide_may(const Wide& node) const {
    if constexpr (R == Relation::covers || R == Relation::contains) return node.reaching(q_.max, q_.min);
    return node.reaching(q_.min, q_.max);
  }
  template <class Wide>
  [[nodiscard]] std::uint64_t wide_must(const Wide& node) const {
    if constexpr (R == Relation::intersects || R == Relation::covered_by) return node.covered(q_.min, q_.max);
    return 0;
  }
  /// The levels decide nearly all; what they leave open is tested.
  template <class Leaf>
  [[nodiscard]] std::uint64_t hits(const Leaf& leaf, std::uint32_t begin, std::uint32_t count) const {
    if (!valid_) return 0;
    if constexpr (R == Relation::intersects || R == Relation::overlaps) {
      return settle(leaf, begin, leaf.reaching(begin, count, q_.min, q_.max));
    } else if constexpr (R == Relation::covers || R == Relation::contains) {
      return settle(leaf, begin, leaf.reaching(begin, count, q_.max, q_.min));
    } else {
      return settle(leaf, begin, leaf.covered(begin, count, q_.min, q_.max));
    }
  }

 private:
  template <class Leaf>
  [[nodiscard]] std::uint64_t settle(const Leaf& leaf, std::uint32_t begin, Sieved sieved) const {
    // With overlaps alone, what is strictly inside may yet be a miss.
    if constexpr (R == Relation::overlaps) sieved.sure = 0;
    return sieved.open() == 0 ? sieved.sure : sieved.sure | passing(*this, leaf, begin, sieved.open());
  }

  Box<T, D> q_;
  bool valid_;
};

template <class F, class T, std::size_t D>
struct BoundValue : OneByOne<BoundValue<F, T, D>, T, D> {
  F function;
  explicit BoundValue(const F& f) : function(f) {}
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>&, const Value& value) const {
    return static_cast<bool>(function(value));
  }
  [[nodiscard]] bool may(const Box<T, D>&) const { return true; }
  [[nodiscard]] bool must(const Box<T, D>&) const { return false; }
  [[nodiscard]] std::uint32_t may_mask(const Rows<T, D>&) const { return 7u; }
};

template <class F, class T, std::size_t D>
struct BoundBox : OneByOne<BoundBox<F, T, D>, T, D> {
  F function;
  explicit BoundBox(const F& f) : function(f) {}
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>& box, const Value&) const {
    return static_cast<bool>(function(box));
  }
  [[nodiscard]] bool may(const Box<T, D>& box) const { return static_cast<bool>(function(box)); }
  [[nodiscard]] bool must(const Box<T, D>&) const { return false; }
};

template <class A, class B, class T, std::size_t D>
struct BoundAnd {
  A a;
  B b;
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>& box, const Value& value) const {
    return a.test(box, value) && b.test(box, value);
  }
  [[nodiscard]] bool may(const Box<T, D>& box) const { return a.may(box) && b.may(box); }
  [[nodiscard]] bool must(const Box<T, D>& box) const { return a.must(box) && b.must(box); }
  [[nodiscard]] std::uint32_t may_mask(const Rows<T, D>& rows) const {
    std::uint32_t result = a.may_mask(rows);
    for (std::size_t i = 0; i < 3; ++i) {
      if (((result >> i) & 1u) != 0 && !b.may(rows.box(i))) result &= ~(1u << i);
    }
    return result;
  }
  [[nodiscard]] std::uint32_t may_and_must(const Rows<T, D>& rows) const { return may_mask(rows); }
  /// The first one tests widely; the second one sees only what the first one has let through.
  template <class Leaf>
  [[nodiscard]] std::uint64_t hits(const Leaf& leaf, std::uint32_t begin, std::uint32_t count) const {
    return passing(b, leaf, begin, a.hits(leaf, begin, count));
  }
};

template <class A, class B, class T, std::size_t D>
struct BoundOr : OneByOne<BoundOr<A, B, T, D>, T, D> {
  A a;
  B b;
  BoundOr(const A& first, const B& second) : a(first), b(second) {}
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>& box, const Value& value) const {
    return a.test(box, value) || b.test(box, value);
  }
  [[nodiscard]] bool may(const Box<T, D>& box) const { return a.may(box) || b.may(box); }
  [[nodiscard]] bool must(const Box<T, D>& box) const { return a.must(box) || b.must(box); }
};

template <class A, class T, std::size_t D>
struct BoundNot : OneByOne<BoundNot<A, T, D>, T, D> {
  A a;
  explicit BoundNot(const A& inner) : a(inner) {}
  template <class Value>
  [[nodiscard]] bool test(const Box<T, D>& box, const Value& value) const {
    return !a.test(box, value);
  }
  [[nodiscard]] bool may(const Box<T, D>& box) const { return !a.must(box); }
  [[nodiscard]] bool must(const Box<T, D>& box) const { return !a.may(box); }
};

template <class T, std::size_t D, Relation R, class G>
  requires Geometry<G, T, D>
auto bind(const RelationPredicate<R, G>& p) {
  return BoundRelation<R, T, D>(to_box<T, D>(p.geometry));
}
template <class T, std::size_t D, class F>
auto bind(const ValuePredicate<F>& p) {
  return BoundValue<F, T, D>(p.function);
}
template <class T, std::size_t D, class F>
auto bind(const BoxPredicate<F>& p) {
  return BoundBox<F, T, D>(p.function);
}
template <class T, std::size_t D, class A, class B>
auto bind(const AndPredicate<A, B>& p);
template <class T, std::size_t D, class A, class B>
auto bind(const OrPredicate<A, B>& p);
template <class T, std::size_t D, class A>
auto bind(const NotPredicate<A>& p) {
  auto a = bind<T, D>(p.a);
  return BoundNot<decltype(a), T, D>(a);
}
template <class T, std::size_t D, class A, class B>
auto bind(const AndPredicate<A, B>& p) {
  auto a = bind<T, D>(p.a);
  auto b = bind<T, D>(p.b);
  return BoundAnd<decltype(a), decltype(b), T, D>{a, b};
}
template <class T, std::size_t D, class A, class B>
auto bind(const OrPredicate<A, B>& p) {
  auto a = bind<T, D>(p.a);
  auto b = bind<T, D>(p.b);
  return BoundOr<decltype(a), decltype(b), T, D>(a, b);
}

}  // namespace spatial::detail

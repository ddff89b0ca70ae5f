// The containers that are compared, behind one interface. In: boxes and queries. Out: sums, so that nothing
// is optimised away.
#pragma once
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <utility>
#include <vector>

namespace peers {

/// Counts the bytes that a container holds.
inline std::size_t bytes_in_use = 0;
template <class X>
struct Counting {
  using value_type = X;
  Counting() = default;
  template <class Y>
  Counting(const Counting<Y>&) {}
  X* allocate(std::size_t n) {
    bytes_in_use += n * sizeof(X);
    return std::allocator<X>().allocate(n);
  }
  void deallocate(X* p, std::size_t n) {
    bytes_in_use -= n * sizeof(X);
    std::allocator<X>().deallocate(p, n);
  }
  friend bool operator==(Counting, Counting) { return true; }
};

template <class T, std::size_t D>
struct Bbtt {
  using Box = spatial::Box<T, D>;
  using Tree = spatial::BoundingBoxTernaryTree<std::uint32_t, T, D, spatial::DefaultBoxOf<T, D>,
                                               spatial::DefaultEqual, Counting<std::uint32_t>>;
  Tree tree;
  std::vector<spatial::Handle> handles;

  static Bbtt one_by_one(const std::vector<Box>& boxes) {
    Bbtt result;
    result.handles.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      result.handles.push_back(result.tree.insert(boxes[i], i));
    return result;
  }
  static Bbtt bulk(const std::vector<Box>& boxes) {
    std::vector<std::pair<Box, std::uint32_t>> values;
    values.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) values.push_back({boxes[i], i});
    Bbtt result;
    result.tree.insert(values.begin(), values.end());
    return result;
  }
  std::size_t query(const Box& q) const {
    std::size_t sum = 0;
    tree.query(spatial::intersects(q), [&](std::uint32_t v) { sum += v; });
    return sum;
  }
  std::size_t count(const Box& q) const { return tree.count(spatial::intersects(q)); }
  template <class Visit>
  void nearest(const spatial::Point<T, D>& p, unsigned k, Visit visit) const {
    tree.query(spatial::nearest(p, k), [&](std::uint32_t v) { visit(v); });
  }
  void erase(std::uint32_t i, const Box&) { tree.erase(handles[i]); }
  void move(std::uint32_t i, const Box&, const Box& to) { tree.move(handles[i], to); }
  std::size_t pairs(const std::vector<Box>&) const {
    std::size_t sum = 0;
    tree.pairs([&](std::uint32_t a, std::uint32_t b) { sum += a ^ b; });
    return sum;
  }
};

template <class T, std::size_t D, class Parameters>
struct Boost {
  using Box = spatial::Box<T, D>;
  using P = boost::geometry::model::point<T, D, boost::geometry::cs::cartesian>;
  using B = boost::geometry::model::box<P>;
  using Value = std::pair<B, std::uint32_t>;
  using Tree = boost::geometry::index::rtree<Value, Parameters, boost::geometry::index::indexable<Value>,
                                             boost::geometry::index::equal_to<Value>, Counting<Value>>;
  Tree tree;

  static P point(const spatial::Point<T, D>& p) {
    if constexpr (D == 2) return P(p[0], p[1]);
    if constexpr (D == 3) return P(p[0], p[1], p[2]);
  }
  static B box(const Box& b) { return B(point(b.min), point(b.max)); }
  static Boost one_by_one(const std::vector<Box>& boxes) {
    Boost result;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) result.tree.insert(Value(box(boxes[i]), i));
    return result;
  }
  static Boost bulk(const std::vector<Box>& boxes) {
    std::vector<Value> values;
    values.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) values.push_back({box(boxes[i]), i});
    return {Tree(values.begin(), values.end())};
  }
  std::size_t query(const Box& q) const {
    std::size_t sum = 0;
    tree.query(boost::geometry::index::intersects(box(q)),
               boost::make_function_output_iterator([&](const Value& v) { sum += v.second; }));
    return sum;
  }
  template <class Visit>
  void nearest(const spatial::Point<T, D>& p, unsigned k, Visit visit) const {
    tree.query(boost::geometry::index::nearest(point(p), k),
               boost::make_function_output_iterator([&](const Value& v) { visit(v.second); }));
  }
  void erase(std::uint32_t i, const Box& at) { tree.remove(Value(box(at), i)); }
  void move(std::uint32_t i, const Box& from, const Box& to) {
    tree.remove(Value(box(from), i));
    tree.insert(Value(box(to), i));
  }
  std::size_t pairs(const std::vector<Box>& boxes) const {
    std::size_t sum = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      tree.query(boost::geometry::index::intersects(box(boxes[i])),
                 boost::make_function_output_iterator(
                     [&](const Value& v) { sum += v.second < i ? v.second ^ i : 0; }));
    }
    return sum;
  }
};

template <class T, std::size_t D>
using Linear = Boost<T, D, boost::geometry::index::linear<16>>;
template <class T, std::size_t D>
using Quadratic = Boost<T, D, boost::geometry::index::quadratic<16>>;
template <class T, std::size_t D>
using Rstar = Boost<T, D, boost::geometry::index::rstar<16>>;

}  // namespace peers

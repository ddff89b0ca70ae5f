// Every query that Boost.Geometry's R-tree has gives the same results, on the same data, with touching
// borders.
#include <doctest/doctest.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <random>
#include <spatial/adapt/boost_geometry.hpp>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using BoxValue = std::pair<Box, int>;
using PointValue = std::pair<Point, int>;

template <class Value>
struct Both {
  bgi::rtree<Value, bgi::rstar<8>> theirs;
  spatial::BoundingBoxTernaryTree<Value, double, 3> ours;
  void insert(const Value& value) {
    theirs.insert(value);
    ours.insert(value);
  }
  template <class P, class Q>
  void compare(const P& their_predicate, const Q& our_predicate) {
    std::vector<int> expected, found;
    theirs.query(their_predicate,
                 boost::make_function_output_iterator([&](const Value& v) { expected.push_back(v.second); }));
    ours.query(our_predicate, [&](const Value& v) { found.push_back(v.second); });
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
};

Box random_box(std::mt19937& random, bool flat) {
  double c[6];
  for (int a = 0; a < 3; ++a) {
    c[a] = int(random() % 12);
    c[3 + a] = c[a] + (flat && random() % 2 == 0 ? 0 : 1 + int(random() % 4));
  }
  return {Point(c[0], c[1], c[2]), Point(c[3], c[4], c[5])};
}

}  // namespace

TEST_CASE("boxes, as Boost answers") {
  std::mt19937 random(1);
  for (const bool flat : {false, true}) {
    Both<BoxValue> both;
    for (int i = 0; i < 1500; ++i) both.insert({random_box(random, flat), i});
    for (int n = 0; n < 60; ++n) {
      const Box q = random_box(random, flat);
      both.compare(bgi::intersects(q), spatial::intersects(q));
      both.compare(bgi::disjoint(q), spatial::disjoint(q));
      both.compare(bgi::covered_by(q), spatial::covered_by(q));
      both.compare(bgi::covers(q), spatial::covers(q));
      both.compare(bgi::overlaps(q), spatial::overlaps(q));
      if (!flat) {  // Boost has no interior for a flat box, here it has that of its own dimension
        both.compare(bgi::within(q), spatial::within(q));
        both.compare(bgi::contains(q), spatial::contains(q));
      }
      const auto odd = [](const BoxValue& v) { return v.second % 2 == 1; };
      both.compare(bgi::intersects(q) && bgi::satisfies(odd) && !bgi::covered_by(q),
                   spatial::intersects(q) && spatial::satisfies(odd) && !spatial::covered_by(q));
    }
  }
}

TEST_CASE("points, as Boost answers") {
  std::mt19937 random(2);
  Both<PointValue> both;
  for (int i = 0; i < 1500; ++i)
    both.insert({Point(int(random() % 12), int(random() % 12), int(random() % 12)), i});
  for (int n = 0; n < 60; ++n) {
    const Box q = random_box(random, false);
    both.compare(bgi::intersects(q), spatial::intersects(q));
    both.compare(bgi::within(q), spatial::within(q));
    both.compare(bgi::covered_by(q), spatial::covered_by(q));
    both.compare(bgi::disjoint(q), spatial::disjoint(q));
  }
}

TEST_CASE("nearest, as Boost answers") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(0, 100);
  Both<BoxValue> both;
  for (int i = 0; i < 2000; ++i) {
    const Point p(at(random), at(random), at(random));
    both.insert({Box(p, Point(bg::get<0>(p) + 1, bg::get<1>(p) + 1, bg::get<2>(p) + 1)), i});
  }
  for (const unsigned k : {1u, 10u, 100u}) {
    for (int n = 0; n < 30; ++n) {
      const Point q(at(random), at(random), at(random));
      both.compare(bgi::nearest(q, k), spatial::nearest(q, k));
    }
  }
}

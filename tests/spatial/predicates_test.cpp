// Every predicate and every combination, as visitor, output iterator and lazy range, against looking at each
// element.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <ranges>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace {

using Box = spatial::Box<double, 2>;
using Tree = spatial::BoundingBoxTernaryTree<int, double, 2>;

struct Scene {
  std::vector<Box> boxes;
  Tree tree;
  explicit Scene(unsigned seed, int count = 600) {
    std::mt19937 random(seed);
    for (int i = 0; i < count; ++i) {
      boxes.push_back(any_box(random));
      tree.insert(boxes.back(), i);
    }
  }
  static Box any_box(std::mt19937& random) {
    Box b;
    for (std::size_t a = 0; a < 2; ++a) {
      b.min[a] = int(random() % 20);
      b.max[a] = b.min[a] + int(random() % 6);
    }
    return b;
  }
  template <class Expected>
  std::vector<int> brute(Expected expected) const {
    std::vector<int> result;
    for (int i = 0; i < int(boxes.size()); ++i) {
      if (expected(boxes[static_cast<std::size_t>(i)], i)) result.push_back(i);
    }
    return result;
  }
  template <class P>
  std::vector<int> found(const P& predicate) const {
    std::vector<int> visited, copied, lazily;
    const std::size_t n = tree.query(predicate, [&](int v) { visited.push_back(v); });
    tree.query(predicate, std::back_inserter(copied));
    for (int v : tree.query(predicate)) lazily.push_back(v);
    for (auto* v : {&visited, &copied, &lazily}) std::sort(v->begin(), v->end());
    CHECK(n == visited.size());
    CHECK(tree.count(predicate) == n);
    CHECK(copied == visited);
    CHECK(lazily == visited);
    return visited;
  }
};

bool inside(const Box& e, const Box& q) { return spatial::encloses(q, e); }
bool strictly(const Box& e, const Box& q) {
  for (std::size_t a = 0; a < 2; ++a) {
    if (!inside(e, q)) return false;
    if (e.min[a] == e.max[a] && (e.min[a] == q.min[a] || e.max[a] == q.max[a])) return false;
  }
  return true;
}
bool overlapping(const Box& e, const Box& q) {
  for (std::size_t a = 0; a < 2; ++a) {
    if (e.max[a] <= q.min[a] || q.max[a] <= e.min[a]) return false;
  }
  return !inside(e, q) && !inside(q, e);
}

}  // namespace

TEST_CASE("each relation") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Scene scene(seed);
    std::mt19937 random(seed + 1000);
    for (int i = 0; i < 10; ++i) {
      const Box q = Scene::any_box(random);
      CHECK(scene.found(spatial::intersects(q)) ==
            scene.brute([&](const Box& e, int) { return spatial::touch(e, q); }));
      CHECK(scene.found(spatial::disjoint(q)) ==
            scene.brute([&](const Box& e, int) { return !spatial::touch(e, q); }));
      CHECK(scene.found(spatial::covered_by(q)) ==
            scene.brute([&](const Box& e, int) { return inside(e, q); }));
      CHECK(scene.found(spatial::covers(q)) == scene.brute([&](const Box& e, int) { return inside(q, e); }));
      CHECK(scene.found(spatial::within(q)) ==
            scene.brute([&](const Box& e, int) { return strictly(e, q); }));
      CHECK(scene.found(spatial::contains(q)) ==
            scene.brute([&](const Box& e, int) { return strictly(q, e); }));
      CHECK(scene.found(spatial::overlaps(q)) ==
            scene.brute([&](const Box& e, int) { return overlapping(e, q); }));
    }
  }
}

TEST_CASE("combinations") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Scene scene(seed);
    std::mt19937 random(seed + 1000);
    for (int i = 0; i < 10; ++i) {
      const Box p = Scene::any_box(random);
      const Box q = Scene::any_box(random);
      using spatial::box_satisfies, spatial::covered_by, spatial::disjoint, spatial::intersects,
          spatial::overlaps, spatial::satisfies, spatial::touch, spatial::within;
      const auto odd = satisfies([](int v) { return v % 2 == 1; });
      const auto left = box_satisfies([](const Box& b) { return b.min[0] <= 7; });
      CHECK(scene.found(intersects(p) && intersects(q)) ==
            scene.brute([&](const Box& e, int) { return touch(e, p) && touch(e, q); }));
      CHECK(scene.found(intersects(p) || covered_by(q)) ==
            scene.brute([&](const Box& e, int) { return touch(e, p) || inside(e, q); }));
      CHECK(scene.found(intersects(p) && !covered_by(q) && odd) ==
            scene.brute([&](const Box& e, int v) { return touch(e, p) && !inside(e, q) && v % 2 == 1; }));
      CHECK(scene.found(!(intersects(p) || !odd)) ==
            scene.brute([&](const Box& e, int v) { return !touch(e, p) && v % 2 == 1; }));
      CHECK(scene.found(left && !within(p)) ==
            scene.brute([&](const Box& e, int) { return e.min[0] <= 7 && !strictly(e, p); }));
      CHECK(scene.found(!left) == scene.brute([&](const Box& e, int) { return !(e.min[0] <= 7); }));
      CHECK(scene.found(!!overlaps(p) && !disjoint(q)) ==
            scene.brute([&](const Box& e, int) { return overlapping(e, p) && touch(e, q); }));
    }
  }
}

TEST_CASE("a visitor that returns false stops the query") {
  const Scene scene(1);
  int calls = 0;
  const auto all = spatial::satisfies([](int) { return true; });
  CHECK(scene.tree.query(all, [&](int) { return ++calls < 5; }) == 5);
  CHECK(calls == 5);
  CHECK(scene.tree.query(all, [&](int, spatial::Handle h) { CHECK(scene.tree.contains(h)); }) == 600);
}

TEST_CASE("boxes that are empty or not a number are the empty set in a query, and are refused as elements") {
  Scene scene(2);
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Box& q : {Box{{5, 5}, {4, 6}}, Box{{nan, 0}, {20, 20}}, Box{{0, 0}, {20, nan}}}) {
    CHECK(scene.tree.count(spatial::intersects(q)) == 0);
    CHECK(scene.tree.count(spatial::covers(q)) == 0);
    CHECK(scene.tree.count(spatial::covered_by(q)) == 0);
    CHECK(scene.tree.count(spatial::disjoint(q)) == 600);
    CHECK(scene.tree.query(spatial::nearest(q, 3), [](int) {}) == 0);
    CHECK_FALSE(scene.tree.insert(q, 1).valid());
    CHECK_FALSE(scene.tree.move(scene.tree.begin().handle(), q));
  }
  CHECK(scene.tree.size() == 600);
  CHECK(scene.tree.validate().empty());
  const Box everything{{-infinity, -infinity}, {infinity, infinity}};
  CHECK(scene.tree.count(spatial::intersects(everything)) == 600);
  CHECK(scene.tree.insert(everything, 600).valid());
  CHECK(scene.tree.count(spatial::covers(everything)) == 1);
  CHECK(scene.tree.count(spatial::intersects(Box{{1e300, 1e300}, {1e300, 1e300}})) == 1);
  CHECK(scene.tree.validate().empty());
}

TEST_CASE("a lazy range works with the standard views") {
  const Scene scene(3);
  static_assert(std::ranges::input_range<decltype(scene.tree.query(spatial::intersects(Box{})))>);
  int sum = 0;
  for (int v : scene.tree.query(spatial::intersects(Box{{3, 3}, {9, 9}})) | std::views::filter([](int v) {
                 return v < 50;
               }) | std::views::transform([](int v) { return 2 * v; })) {
    sum += v;
  }
  int expected = 0;
  for (int v : scene.found(spatial::intersects(Box{{3, 3}, {9, 9}}))) expected += v < 50 ? 2 * v : 0;
  CHECK(sum == expected);
  CHECK(std::ranges::distance(scene.tree.begin(), scene.tree.end()) == 600);
}

TEST_CASE("a query says what it looked at") {
  const Scene scene(4, 5000);
  const auto few = scene.tree.query_statistics(spatial::intersects(Box{{3, 3}, {3, 3}}));
  const auto all = scene.tree.query_statistics(spatial::intersects(Box{{-1, -1}, {99, 99}}));
  CHECK(all.hits == 5000);
  CHECK(all.elements == 5000);
  CHECK(all.leaves == scene.tree.statistics().leaves);
  CHECK(all.nodes == scene.tree.statistics().nodes);
  CHECK(few.elements < all.elements);
  std::size_t nodes = 0;
  std::size_t elements = 0;
  scene.tree.visit_nodes([&](const spatial::NodeView<double, 2>& view) {
    (view.is_leaf ? elements : nodes) += view.is_leaf ? view.elements : 1;
  });
  CHECK(nodes == all.nodes);
  CHECK(elements == 5000);
}

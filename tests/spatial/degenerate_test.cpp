// Data that makes trees deep, leaves big or arithmetic overflow. Each has a million elements or the extremes
// of its type; a blow-up of time, depth or stack makes the test fail by its bounds or not end.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace {

constexpr int million = 1000000;
using Tree = spatial::BoundingBoxTernaryTree<int, double, 2>;
using Box = spatial::Box<double, 2>;

}  // namespace

TEST_CASE("a million identical boxes, and away with them") {
  Tree tree;
  const Box same{{1, 2}, {3, 4}};
  std::vector<spatial::Handle> handles;
  for (int i = 0; i < million; ++i) handles.push_back(tree.insert(same, i));
  CHECK(tree.statistics().depth <= 2);
  CHECK(tree.count(spatial::intersects(Box{{3, 4}, {5, 5}})) == million);
  CHECK(tree.count(spatial::intersects(Box{{3.5, 4}, {5, 5}})) == 0);
  tree.insert(Box{{0, 0}, {0, 0}}, -1);
  for (const auto& handle : handles) REQUIRE(tree.erase(handle));
  CHECK(tree.size() == 1);
  CHECK(tree.bounds() == Box{{0, 0}, {0, 0}});
  CHECK(tree.validate().empty());
}

TEST_CASE("a million identical points, loaded at once") {
  std::vector<std::pair<spatial::Point<float, 3>, int>> points(million, {{0.1f, 0.2f, 0.3f}, 7});
  spatial::BoundingBoxTernaryTree<int, float, 3> tree(points.begin(), points.end());
  CHECK(tree.size() == million);
  CHECK(tree.statistics().depth == 0);
  CHECK(tree.insert(spatial::Point<float, 3>{0.1f, 0.2f, 0.31f}, 8).valid());
  CHECK(tree.query(spatial::nearest(spatial::Point<float, 3>{1, 1, 1}, 1), [](int v) { CHECK(v == 8); }) ==
        1);
  CHECK(tree.validate().empty());
}

TEST_CASE("a million nested boxes") {
  Tree tree;
  for (int i = 1; i <= million; ++i) tree.insert(Box{{-1.0 * i, -1.0 * i}, {1.0 * i, 1.0 * i}}, i);
  CHECK(tree.size() == million);
  CHECK(tree.count(spatial::intersects(spatial::Point<double, 2>{999990, 0})) == 11);
  CHECK(tree.statistics().depth < 100);
}

TEST_CASE("boxes in the order of a line") {
  Tree tree;
  for (int i = 0; i < million; ++i) tree.insert(Box{{1.0 * i, 0}, {i + 0.5, 0}}, i);
  CHECK(tree.statistics().depth < 64);
  CHECK(tree.count(spatial::intersects(Box{{10, 0}, {19, 0}})) == 10);
  CHECK(tree.bounds() == Box{{0, 0}, {million - 0.5, 0}});
}

TEST_CASE("every scale of a double, growing and shrinking") {
  for (const bool outwards : {true, false}) {
    Tree tree;
    int count = 0;
    for (int e = -1070; e <= 1020; ++e) {
      const int exponent = outwards ? e : -50 - e;
      const double x = std::ldexp(1.0, exponent);
      for (int i = 0; i < 20; ++i)
        tree.insert(spatial::Point<double, 2>{x * (1 + i / 32.0), i % 2 == 0 ? x : -x}, count++);
    }
    CHECK(tree.validate().empty());
    CHECK(tree.statistics().depth < 2 * 2200);
    const double x = std::ldexp(1.0, -600);
    CHECK(tree.count(spatial::intersects(Box{{x, -x}, {x * 1.99, x}})) == 20);
  }
}

TEST_CASE("coordinates at the limits of the type") {
  const double most = std::numeric_limits<double>::max();
  const double infinity = std::numeric_limits<double>::infinity();
  Tree tree;
  std::mt19937 random(3);
  const double special[] = {-infinity, -most,  -most / 2, -1,       -5e-324, 0,
                            5e-324,    1e-310, 1,         most / 2, most,    infinity};
  std::vector<Box> boxes;
  for (int i = 0; i < 3000; ++i) {
    Box b;
    for (std::size_t a = 0; a < 2; ++a) {
      b.min[a] = special[random() % 12];
      b.max[a] = special[random() % 12];
      if (b.max[a] < b.min[a]) std::swap(b.min[a], b.max[a]);
    }
    boxes.push_back(b);
    REQUIRE(tree.insert(b, i).valid());
  }
  REQUIRE(tree.validate().empty());
  for (const Box& q : boxes) {
    std::size_t expected = 0;
    for (const Box& b : boxes) expected += spatial::touch(b, q) ? 1 : 0;
    REQUIRE(tree.count(spatial::intersects(q)) == expected);
  }
}

TEST_CASE("all integers of a small type") {
  spatial::BoundingBoxTernaryTree<int, std::int8_t, 2> tree;
  for (int x = -128; x < 128; ++x) {
    for (int y = -128; y < 128; ++y) {
      tree.insert(spatial::Point<std::int8_t, 2>{std::int8_t(x), std::int8_t(y)}, x * 256 + y);
    }
  }
  CHECK(tree.validate().empty());
  CHECK(tree.count(spatial::intersects(spatial::Point<std::int8_t, 2>{-128, 127})) == 1);
  CHECK(tree.count(spatial::covered_by(spatial::Box<std::int8_t, 2>{{-128, -128}, {127, 127}})) == 65536);
  CHECK(tree.query(spatial::nearest(spatial::Point<std::int8_t, 2>{127, 127}, 4), [](int) {}) == 4);
}

TEST_CASE("points that halve their distance to one end") {
  spatial::BoundingBoxTernaryTree<int, float, 2> tree;
  for (int i = 0; i < 100000; ++i) tree.insert(spatial::Point<float, 2>{std::ldexp(1.0f, -(i % 140)), 0}, i);
  CHECK(tree.validate().empty());
  CHECK(tree.statistics().depth < 300);
}

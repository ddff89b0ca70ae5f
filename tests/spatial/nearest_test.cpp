// The nearest elements of trees that were loaded at once, which are found through the overview and by the
// distances of levels: the keys are those of looking at every element, in order, and each element comes once.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <utility>
#include <vector>

namespace {

template <class T, std::size_t D>
using Boxes = std::vector<std::pair<spatial::Box<T, D>, int>>;

// As documented: the Euclidean distance, of integers in double.
template <class T, std::size_t D>
auto distance(const spatial::Box<T, D>& box, const spatial::Box<T, D>& query) {
  using S = spatial::detail::DistanceOf<T>;
  S sum = 0;
  for (std::size_t a = 0; a < D; ++a) {
    const S above = static_cast<S>(box.min[a]) - static_cast<S>(query.max[a]);
    const S below = static_cast<S>(query.min[a]) - static_cast<S>(box.max[a]);
    const S outside = above > below ? above : below;
    const S gap = outside > 0 ? outside : S{0};
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

template <class S>
bool is_same(S a, S b) {
  return a == b || std::abs(a - b) <= 8 * std::numeric_limits<S>::epsilon() * std::max(a, b);
}

template <class Tree, class T, std::size_t D>
void compare(const Tree& tree, const Boxes<T, D>& boxes, const spatial::Box<T, D>& query, std::size_t k) {
  using S = spatial::detail::DistanceOf<T>;
  std::vector<S> expected;
  std::vector<const spatial::Box<T, D>*> box_of;
  for (const auto& [box, i] : boxes) {
    expected.push_back(distance(box, query));
    box_of.resize(std::max(box_of.size(), static_cast<std::size_t>(i) + 1), nullptr);
    box_of[static_cast<std::size_t>(i)] = &box;
  }
  k = std::min(k, boxes.size());
  std::partial_sort(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(k), expected.end());
  std::size_t found = 0;
  int wrong = 0;
  tree.query(spatial::nearest(query, k), [&](int i, spatial::Handle, auto d) {
    const auto* const box = std::exchange(box_of[static_cast<std::size_t>(i)], nullptr);
    wrong += box == nullptr || !is_same(distance(*box, query), d) || !is_same(expected[found], d) ? 1 : 0;
    ++found;
  });
  CHECK(wrong == 0);
  CHECK(found == k);
}

struct Shape {
  int count;
  double extent;        // of all
  double largest;       // side of a box; 0: points
  double flatness = 1;  // how much shorter the last axis is
};

template <class T, std::size_t D>
spatial::Box<T, D> random_box(std::mt19937& random, const Shape& shape, double side) {
  spatial::Box<T, D> box;
  std::uniform_real_distribution<double> unit(0, 1);
  const bool is_in_cluster = random() % 3 == 0;
  for (std::size_t a = 0; a < D; ++a) {
    const double extent = shape.extent * (a + 1 == D ? shape.flatness : 1);
    const double low = extent * (is_in_cluster ? 0.7 + 0.01 * unit(random) : unit(random));
    box.min[a] = static_cast<T>(low);
    box.max[a] = side == 0 ? box.min[a] : static_cast<T>(low + side * unit(random));
  }
  return box;
}

template <class T, std::size_t D>
void check(unsigned seed, const Shape& shape) {
  std::mt19937 random(seed);
  Boxes<T, D> boxes;
  for (int i = 0; i < shape.count; ++i) boxes.push_back({random_box<T, D>(random, shape, shape.largest), i});
  spatial::BoundingBoxTernaryTree<int, T, D> tree(boxes.begin(), boxes.end());
  constexpr auto greatest = static_cast<double>(std::numeric_limits<T>::max());
  const auto ask = [&](std::size_t most) {
    for (const std::size_t k : {1u, 2u, 10u, 16u, 17u, 100u, 1000u}) {
      if (k > most) break;
      for (const double side : {0.0, 0.0, 0.01, 0.3}) {
        compare(tree, boxes, random_box<T, D>(random, shape, side * shape.extent), k);
      }
      // From outside, also of some nodes' boxes only on one axis.
      auto far = random_box<T, D>(random, shape, 0);
      const std::size_t axis = random() % D;
      far.min[axis] = far.max[axis] = static_cast<T>(std::min(1.2 * shape.extent, greatest));
      compare(tree, boxes, far, k);
    }
  };
  ask(1000);
  // Erasing a region empties leaves, erasing here and there thins them.
  const auto region = random_box<T, D>(random, shape, 0.6 * shape.extent);
  tree.erase_if(spatial::intersects(region) || spatial::satisfies([](int i) { return i % 5 == 0; }));
  std::erase_if(boxes, [&](const auto& each) { return touch(each.first, region) || each.second % 5 == 0; });
  REQUIRE(tree.size() == boxes.size());
  ask(17);
}

}  // namespace

TEST_CASE("the nearest boxes and points of a loaded tree, also after erasing") {
  check<float, 2>(1, {6000, 1, 0.02});
  check<float, 2>(2, {6000, 1, 0});
  check<double, 3>(3, {6000, 1, 0.1});
  check<double, 3>(4, {6000, 1, 0});
  check<float, 3>(5, {4000, 1000, 30});
  check<double, 2>(6, {4000, 1e-3, 1e-5, 1e-6});
  check<double, 1>(7, {3000, 1, 0.001});
  check<float, 5>(8, {3000, 1, 0.2});
  check<std::int32_t, 2>(9, {5000, 1e6, 3000});
  check<std::int16_t, 3>(10, {5000, 100, 5});
  check<std::uint8_t, 2>(11, {5000, 200, 0});
}

TEST_CASE("the nearest of a tree whose overview has several levels") {
  check<float, 2>(12, {120000, 1, 0.003});
  check<float, 2>(13, {120000, 1, 0});
  check<double, 3>(14, {120000, 1, 0});
}

TEST_CASE("the nearest at the ends of the numbers") {
  check<float, 2>(21, {3000, 3e38, 1e36});
  check<float, 2>(22, {3000, 1e-37, 1e-39});
  check<float, 2>(23, {3000, 1e-42, 0});
  check<double, 3>(24, {3000, 1e308, 1e306});
  check<double, 3>(25, {3000, 1e-300, 0});
  check<double, 2>(26, {3000, 1e-320, 0});
  check<std::int64_t, 2>(27, {3000, 7e18, 1e15});
  check<std::int8_t, 2>(28, {3000, 100, 3});
}

TEST_CASE("the nearest among coordinates of all sizes and infinite ones") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double greatest = std::numeric_limits<double>::max();
  const double some[] = {-infinity, -greatest, -1e200, -1e100, -1,    -1e-200, 0,        1e-310,  1e-100,
                         1,         1.5,       2,      1e16,   1e100, 1e300,   greatest, infinity};
  std::mt19937 random(31);
  const auto any = [&] { return some[random() % std::size(some)]; };
  Boxes<double, 2> boxes;
  for (int i = 0; i < 3000; ++i) {
    spatial::Box<double, 2> box{{any(), any()}, {any(), any()}};
    for (std::size_t a = 0; a < 2; ++a) {
      if (random() % 2 == 0) box.max[a] = box.min[a];
      if (box.max[a] < box.min[a]) std::swap(box.min[a], box.max[a]);
    }
    boxes.push_back({box, i});
  }
  const spatial::BoundingBoxTernaryTree<int, double, 2> tree(boxes.begin(), boxes.end());
  for (int n = 0; n < 60; ++n) {
    spatial::Box<double, 2> query{{any(), any()}, {}};
    query.max = query.min;
    for (const std::size_t k : {1u, 16u, 40u, 1500u}) compare(tree, boxes, query, k);
  }
}

TEST_CASE("the nearest of many at the same place, and of few groups") {
  std::mt19937 random(41);
  Boxes<float, 2> boxes;
  for (int i = 0; i < 4000; ++i) {
    const auto x = static_cast<float>(random() % 12);
    const auto y = static_cast<float>(random() % 12);
    boxes.push_back({{{x, y}, {x, y}}, i});
  }
  const spatial::BoundingBoxTernaryTree<int, float, 2> tree(boxes.begin(), boxes.end());
  for (int n = 0; n < 20; ++n) {
    const auto x = static_cast<float>(random() % 25) / 2;
    for (const std::size_t k : {1u, 5u, 16u, 17u, 30u, 300u, 3999u}) {
      compare(tree, boxes, {{x, x / 2}, {x, x / 2}}, k);
    }
  }
}

TEST_CASE("among many that enclose the query, few are looked at") {
  Boxes<double, 2> boxes;
  for (int i = 0; i < 5000; ++i) boxes.push_back({{{-1.0 - i, -1}, {1.0 + i, 1}}, i});
  const spatial::BoundingBoxTernaryTree<int, double, 2> tree(boxes.begin(), boxes.end());
  int looked_at = 0;
  const auto counted = spatial::satisfies([&](int) { return ++looked_at > 0; });
  CHECK(tree.query(spatial::nearest(spatial::Point<double, 2>{0, 0}, 20) && counted, [](int) {}) == 20);
  CHECK(looked_at < 200);
  looked_at = 0;
  CHECK(tree.query(spatial::nearest(spatial::Point<double, 2>{0, 0}, 1) && counted, [](int) {}) == 1);
  CHECK(looked_at == 1);
}

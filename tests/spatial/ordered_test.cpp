// Nearest elements, and elements along rays and segments, in order, against looking at each element.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace {

template <class T, std::size_t D>
struct Scene {
  std::vector<spatial::Box<T, D>> boxes;
  spatial::BoundingBoxTernaryTree<int, T, D> tree;
  explicit Scene(unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 1000; ++i) {
      spatial::Box<T, D> b;
      for (std::size_t a = 0; a < D; ++a) {
        b.min[a] = static_cast<T>(random() % 100);
        b.max[a] = static_cast<T>(b.min[a] + static_cast<T>(random() % 5));
      }
      boxes.push_back(b);
      tree.insert(b, i);
    }
  }
};

template <class T, std::size_t D>
double gap(const spatial::Box<T, D>& e, const spatial::Box<T, D>& q) {
  double sum = 0;
  for (std::size_t a = 0; a < D; ++a) {
    const double g =
        std::max({0.0, double(e.min[a]) - double(q.max[a]), double(q.min[a]) - double(e.max[a])});
    sum += g * g;
  }
  return std::sqrt(sum);
}

/// First t >= 0 with origin + t * direction in the box, or -1.
template <class T, std::size_t D>
double entry(const spatial::Box<T, D>& e, const std::array<double, D>& o, const std::array<double, D>& d,
             double limit) {
  double in = 0;
  double out = limit;
  for (std::size_t a = 0; a < D; ++a) {
    if (d[a] == 0) {
      if (o[a] < double(e.min[a]) || o[a] > double(e.max[a])) return -1;
      continue;
    }
    const double t0 = (double(e.min[a]) - o[a]) / d[a];
    const double t1 = (double(e.max[a]) - o[a]) / d[a];
    in = std::max(in, std::min(t0, t1));
    out = std::min(out, std::max(t0, t1));
  }
  return in <= out ? in : -1;
}

template <class T, std::size_t D>
void nearest_agrees(unsigned seed) {
  const Scene<T, D> scene(seed);
  std::mt19937 random(seed + 77);
  for (std::size_t k : {0u, 1u, 7u, 100u, 1000u, 5000u}) {
    spatial::Box<T, D> q;
    for (std::size_t a = 0; a < D; ++a) {
      q.min[a] = static_cast<T>(random() % 120);
      q.max[a] = static_cast<T>(q.min[a] + static_cast<T>(random() % 3));
    }
    std::vector<double> expected;
    for (const auto& b : scene.boxes) expected.push_back(gap(b, q));
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min(k, expected.size()));
    std::vector<double> found;
    scene.tree.query(spatial::nearest(q, k), [&](int v, spatial::Handle, auto distance) {
      CHECK(double(distance) == doctest::Approx(gap(scene.boxes[std::size_t(v)], q)));
      found.push_back(gap(scene.boxes[std::size_t(v)], q));
    });
    CHECK(found == expected);
    found.clear();
    for (int v : scene.tree.query(spatial::nearest(q, k)))
      found.push_back(gap(scene.boxes[std::size_t(v)], q));
    CHECK(found == expected);
    // Filtered: the nearest of those that pass.
    std::vector<double> even;
    for (std::size_t i = 0; i < scene.boxes.size(); i += 2) even.push_back(gap(scene.boxes[i], q));
    std::sort(even.begin(), even.end());
    even.resize(std::min(k, even.size()));
    found.clear();
    const auto is_even = spatial::satisfies([](int v) { return v % 2 == 0; });
    scene.tree.query(spatial::nearest(q, k) && is_even,
                     [&](int v) { found.push_back(gap(scene.boxes[std::size_t(v)], q)); });
    CHECK(found == even);
  }
}

template <class T, std::size_t D>
void paths_agree(unsigned seed) {
  const Scene<T, D> scene(seed);
  std::mt19937 random(seed + 99);
  for (int n = 0; n < 40; ++n) {
    spatial::Point<double, D> from, to, direction;
    for (std::size_t a = 0; a < D; ++a) {
      from[a] = static_cast<double>(random() % 100);
      to[a] = random() % 3 == 0 ? from[a] : static_cast<double>(random() % 100);
      direction[a] = to[a] - from[a];
    }
    for (const bool ray : {false, true}) {
      std::vector<double> expected;
      for (const auto& b : scene.boxes) {
        const double t = entry<T, D>(b, from, direction, ray ? INFINITY : 1.0);
        if (t >= 0) expected.push_back(t);
      }
      std::sort(expected.begin(), expected.end());
      std::vector<double> found;
      const auto take = [&](int, spatial::Handle, auto t) { found.push_back(double(t)); };
      if (ray) {
        scene.tree.query(spatial::ray_hits(from, direction), take);
      } else {
        scene.tree.query(spatial::segment_hits(from, to), take);
      }
      REQUIRE(found.size() == expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == doctest::Approx(expected[i]));
    }
  }
}

}  // namespace

TEST_CASE("nearest elements, in order") {
  nearest_agrees<float, 2>(1);
  nearest_agrees<double, 3>(2);
  nearest_agrees<std::int32_t, 2>(3);
}

TEST_CASE("elements along rays and segments, in order") {
  paths_agree<double, 2>(1);
  paths_agree<double, 3>(2);
  paths_agree<std::int32_t, 2>(3);
}

TEST_CASE("the first hit of a ray needs no look at the rest") {
  const Scene<double, 2> scene(5);
  int calls = 0;
  const spatial::Point<double, 2> origin{-10, 50};
  const spatial::Point<double, 2> direction{1, 0};
  scene.tree.query(spatial::ray_hits(origin, direction), [&](int) { return ++calls < 1; });
  CHECK(calls == 1);
  auto range = scene.tree.query(spatial::ray_hits(origin, direction));
  auto first = range.begin();
  REQUIRE(first != range.end());
  CHECK(first.distance() == scene.boxes[std::size_t(*first)].min[0] + 10);
}

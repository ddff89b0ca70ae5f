// Leaves of boxes and of points. The parts of a leaf's block are aligned for what they hold, whatever the
// sizes of coordinates and values.
#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/detail/leaf.hpp>
#include <utility>
#include <vector>

namespace {

template <class Value, class T, std::size_t D>
void check() {
  using Leaf = spatial::detail::Leaf<Value, T, D>;
  for (const std::size_t rows : {D, 2 * D}) {
    for (std::size_t capacity = 1; capacity < 100; ++capacity) {
      const std::size_t boxes = Leaf::boxes_offset(capacity, rows);
      const std::size_t ids = Leaf::ids_offset(capacity, rows);
      const std::size_t values = Leaf::values_offset(capacity, rows);
      CHECK(ids % alignof(std::uint32_t) == 0);
      CHECK(values % alignof(Value) == 0);
      CHECK(boxes % alignof(T) == 0);
      CHECK(values >= sizeof(typename Leaf::FrameType) + rows * capacity);
      CHECK(boxes >= values + capacity * sizeof(Value));
      CHECK(ids >= boxes + rows * capacity * sizeof(T));
      CHECK(Leaf::bytes(capacity, rows, true) >= ids + capacity * sizeof(std::uint32_t));
    }
  }
}

}  // namespace

TEST_CASE("boxes, values and slot indices are aligned and apart") {
  check<int, std::uint8_t, 3>();
  check<char, std::int8_t, 1>();
  check<double, std::int16_t, 3>();
  check<std::uint32_t, float, 2>();
  check<long double, double, 3>();
}

TEST_CASE("leaves of points take less memory, and have room for boxes when one comes") {
  using Tree = spatial::BoundingBoxTernaryTree<int, double, 3>;
  using Point = spatial::Point<double, 3>;
  const auto at = [](int i) { return Point{i % 10 * 1.0, i / 10 % 10 * 1.0, i / 100 * 1.0}; };
  Tree points, boxes;
  std::vector<spatial::Handle> handles;
  for (int i = 0; i < 1000; ++i) {
    handles.push_back(points.insert(at(i), i));
    Point high = at(i);
    high[2] += 1e-9;
    boxes.insert(spatial::Box<double, 3>{at(i), high}, i);
  }
  REQUIRE(boxes.size() == 1000);
  CHECK(points.statistics().bytes < boxes.statistics().bytes * 4 / 5);
  for (int round = 0; round < 2; ++round) {
    for (int i = round; i < 1000; i += 3) {
      Point high = at(i);
      high[0] += round == 0 ? 0.25 : 0;
      REQUIRE(points.move(handles[std::size_t(i)], spatial::Box<double, 3>{at(i), high}));
      CHECK(points.box(handles[std::size_t(i)]).max == high);
    }
    CHECK(points.validate().empty());
    for (int i = 0; i < 1000; i += 7) {
      Point beside = at(i);
      beside[0] += 0.125;
      CHECK(points.count(spatial::intersects(beside)) == (i % 3 == 0 ? 1u : 0u));
    }
  }
  for (int i = 0; i < 990; ++i) {
    REQUIRE(points.erase(handles[std::size_t(i)]));
    if (i % 50 == 0) CHECK(points.validate().empty());
  }
  CHECK(points.size() == 10);
  CHECK(points.validate().empty());
}

TEST_CASE("nearest points that are infinitely far, and nearest to infinite points, are as among boxes") {
  const double infinity = std::numeric_limits<double>::infinity();
  using Point = spatial::Point<double, 2>;
  spatial::BoundingBoxTernaryTree<int, double, 2> points, boxes;
  int n = 0;
  for (const double x : {-infinity, -1e300, -1.0, 0.0, 2.0, 1e300, infinity}) {
    for (const double y : {-infinity, 0.0, 3.0, 1e300}) {
      points.insert(Point{x, y}, n);
      boxes.insert(Point{x, y}, n++);
    }
  }
  // A leaf with one box has room for boxes, and takes the general way.
  boxes.insert(spatial::Box<double, 2>{{-infinity, -infinity}, {infinity, infinity}}, -1);
  for (const double x : {-infinity, -1e300, 0.5, infinity}) {
    for (const double y : {-infinity, 1.0, infinity}) {
      std::vector<double> a, b;
      points.query(spatial::nearest(Point{x, y}, 20),
                   [&](int, spatial::Handle, double d) { a.push_back(d); });
      boxes.query(spatial::nearest(Point{x, y}, 21), [&](int i, spatial::Handle, double d) {
        if (i >= 0) b.push_back(d);
      });
      REQUIRE(b.size() >= a.size());
      b.resize(a.size());
      CHECK(a == b);
    }
  }
}

TEST_CASE("a root that grows leaves no long way down") {
  // Pseudo-random points of the unit cube, one after the other: many lie a little outside of those before.
  using Tree = spatial::BoundingBoxTernaryTree<int, double, 3>;
  std::uint64_t state = 1;
  const auto unit = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 40) / (1 << 24);
  };
  Tree inserted;
  std::vector<std::pair<spatial::Point<double, 3>, int>> points;
  for (int i = 0; i < 20000; ++i) {
    const double x = unit();
    const double y = unit();
    points.push_back({{x, y, unit()}, i});
    inserted.insert(points.back().first, i);
  }
  const Tree loaded(points.begin(), points.end());
  CHECK(inserted.statistics().depth <= loaded.statistics().depth + 2);
  CHECK(inserted.validate().empty());
}

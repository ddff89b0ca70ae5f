// Trees that were loaded at once are searched through an overview. What comes out is what a look at every
// element gives: after copying and moving the tree, while elements are erased, and after it changed.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

template <class T, std::size_t D>
using Boxes = std::vector<std::pair<spatial::Box<T, D>, int>>;

// Small boxes, some of which have an infinite or a greatest extent, in a cube or in a far corner.
template <class T, std::size_t D>
spatial::Box<T, D> random_box(std::mt19937& random, int largest) {
  constexpr T greatest = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                                              : std::numeric_limits<T>::max();
  spatial::Box<T, D> box;
  const int offset = random() % 8 == 0 ? 20000 : 0;
  for (std::size_t a = 0; a < D; ++a) {
    const int low = static_cast<int>(random() % 1000) + offset;
    box.min[a] = static_cast<T>(low);
    box.max[a] = static_cast<T>(low + static_cast<int>(random() % static_cast<unsigned>(largest)));
    if (random() % 500 == 0) box.max[a] = greatest;
    if (random() % 500 == 0) box.min[a] = std::numeric_limits<T>::lowest();
  }
  return box;
}

template <class T, std::size_t D>
Boxes<T, D> scene(std::mt19937& random, int count, int largest) {
  Boxes<T, D> result;
  for (int i = 0; i < count; ++i) result.push_back({random_box<T, D>(random, largest), i});
  return result;
}

template <class Tree, class T, std::size_t D>
void compare(const Tree& tree, const Boxes<T, D>& boxes, const spatial::Box<T, D>& q) {
  const auto all = [&](const auto& predicate, const auto& holds) {
    std::vector<int> times(20000, 0);
    tree.query(predicate, [&](int i) { ++times[static_cast<std::size_t>(i)]; });
    for (const auto& [box, i] : boxes) times[static_cast<std::size_t>(i)] -= holds(box) ? 1 : 0;
    CHECK(times == std::vector<int>(times.size(), 0));
  };
  using spatial::encloses;
  all(spatial::intersects(q), [&](const auto& b) { return touch(b, q); });
  all(spatial::covered_by(q), [&](const auto& b) { return encloses(q, b); });
  all(spatial::covers(q), [&](const auto& b) { return encloses(b, q); });
  all(spatial::disjoint(q), [&](const auto& b) { return !touch(b, q); });
  all(spatial::intersects(q) && !spatial::covered_by(q),
      [&](const auto& b) { return touch(b, q) && !encloses(q, b); });
}

template <class T, std::size_t D>
void check(int largest) {
  std::mt19937 random(static_cast<unsigned>(largest));
  auto boxes = scene<T, D>(random, 6000, largest);
  using Tree = spatial::BoundingBoxTernaryTree<int, T, D>;
  Tree loaded(boxes.begin(), boxes.end());
  Tree tree = loaded;
  loaded.clear();
  CHECK(tree.validate().empty());
  const auto ask = [&](const Tree& asked, int sizes) {
    for (int i = 0; i < 6; ++i) compare(asked, boxes, random_box<T, D>(random, sizes));
  };
  for (const int size : {1, 100, 1000}) ask(tree, size);
  // Erasing whole regions empties leaves.
  while (boxes.size() > 200) {
    const auto region = random_box<T, D>(random, 600);
    CHECK(tree.erase_if(spatial::intersects(region)) ==
          std::erase_if(boxes, [&](const auto& each) { return touch(each.first, region); }));
    CHECK(tree.validate().empty());
    ask(tree, 300);
    if (boxes.size() > 3000) continue;
    Tree other;
    swap(tree, other);
    ask(other, 100);
    tree = std::move(other);
  }
  for (int i = 10000; i < 10300; ++i) {
    boxes.push_back({random_box<T, D>(random, largest), i});
    tree.insert(boxes.back().first, i);
  }
  CHECK(tree.validate().empty());
  for (const int size : {1, 1000}) ask(tree, size);
}

}  // namespace

TEST_CASE("a loaded tree finds what is there, while it is erased from and after it changed") {
  check<double, 3>(20);
  check<float, 2>(10);
  check<int, 2>(30);
  check<std::int16_t, 1>(2);
  check<float, 4>(100);
}

TEST_CASE("a tree that was loaded with handles finds elements that moved") {
  std::mt19937 random(1);
  auto boxes = scene<double, 2>(random, 3000, 5);
  spatial::BoundingBoxTernaryTree<int, double, 2> tree;
  std::vector<spatial::Handle> handles;
  tree.insert(boxes.begin(), boxes.end(), std::back_inserter(handles));
  for (std::size_t i = 0; i < boxes.size(); i += 3) {
    boxes[i].first = random_box<double, 2>(random, 5);
    REQUIRE(tree.move(handles[i], boxes[i].first));
    if (i % 300 == 0) compare(tree, boxes, random_box<double, 2>(random, 100));
  }
  CHECK(tree.validate().empty());
}

TEST_CASE("a query of a loaded tree looks at few nodes") {
  std::mt19937 random(1);
  Boxes<double, 2> boxes;
  for (int i = 0; i < 50000; ++i) {
    const double x = static_cast<double>(random() % 100000);
    const double y = static_cast<double>(random() % 100000);
    boxes.push_back({{{x, y}, {x + 100, y + 100}}, i});
  }
  spatial::BoundingBoxTernaryTree<int, double, 2> tree;
  std::vector<spatial::Handle> handles;
  tree.insert(boxes.begin(), boxes.end(), std::back_inserter(handles));
  const auto query = spatial::intersects(spatial::Point<double, 2>{50000, 20000});
  const std::size_t few = tree.query_statistics(query).nodes;
  CHECK(few <= 4);
  const spatial::BoundingBoxTernaryTree<int, double, 2> copy = tree;
  CHECK(copy.query_statistics(query).nodes == few);
  REQUIRE(tree.erase(handles[7]));
  CHECK(tree.query_statistics(query).nodes == few);
  REQUIRE(tree.move(handles[8], boxes[8].first));
  CHECK(tree.query_statistics(query).nodes > few);
}

// Random sequences of operations on the tree, against a plain list of boxes.
#include <doctest/doctest.h>

#include <cstdint>
#include <random>
#include <set>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <vector>

namespace {

template <class T, std::size_t D>
struct Model {
  struct Element {
    spatial::Box<T, D> box;
    int value;
    spatial::Handle handle;
  };
  std::vector<Element> elements;
};

template <class T, std::size_t D>
spatial::Box<T, D> random_box(std::mt19937& random, int range, int size) {
  spatial::Box<T, D> box;
  for (std::size_t a = 0; a < D; ++a) {
    const int low = static_cast<int>(random() % static_cast<unsigned>(range));
    box.min[a] = static_cast<T>(low);
    box.max[a] = static_cast<T>(low + static_cast<int>(random() % static_cast<unsigned>(size)));
  }
  return box;
}

template <class T, std::size_t D>
void run(unsigned seed, int range, int size, int steps) {
  std::mt19937 random(seed);
  spatial::BoundingBoxTernaryTree<int, T, D> tree;
  Model<T, D> model;
  auto& elements = model.elements;
  std::vector<spatial::Handle> stale;
  for (int step = 0; step < steps; ++step) {
    const unsigned what = random() % 16;
    if (what < 7 || elements.empty()) {
      const auto box = random_box<T, D>(random, range, size);
      const auto handle = tree.insert(box, step);
      REQUIRE(handle.valid());
      elements.push_back({box, step, handle});
    } else if (what < 11) {
      const std::size_t at = random() % elements.size();
      REQUIRE(tree.erase(elements[at].handle));
      stale.push_back(elements[at].handle);
      elements[at] = elements.back();
      elements.pop_back();
    } else if (what < 14) {
      auto& element = elements[random() % elements.size()];
      element.box = random_box<T, D>(random, range, size);
      REQUIRE(tree.move(element.handle, element.box));
    } else {
      const auto query = random_box<T, D>(random, range, 2 * size);
      std::multiset<int> expected;
      for (const auto& e : elements) {
        if (spatial::touch(e.box, query)) expected.insert(e.value);
      }
      std::multiset<int> found;
      tree.query(spatial::intersects(query), [&](const int& value) { found.insert(value); });
      REQUIRE(found == expected);
    }
    REQUIRE(tree.size() == elements.size());
    if (step % 4096 == 4095 && random() % 4 == 0) {
      tree.clear();
      for (const auto& e : elements) stale.push_back(e.handle);
      elements.clear();
    }
  }
  for (const auto& handle : stale) CHECK_FALSE(tree.contains(handle));
  for (const auto& e : elements) {
    REQUIRE(tree.contains(e.handle));
    CHECK(tree.value(e.handle) == e.value);
    CHECK(tree.box(e.handle) == e.box);
  }
}

}  // namespace

TEST_CASE("the tree does what a list of boxes does") {
  for (unsigned seed = 0; seed < 4; ++seed) {
    CAPTURE(seed);
    run<float, 2>(seed, 1000, 20, 20000);
    run<double, 3>(seed, 100, 30, 20000);
    run<double, 2>(seed, 10, 3, 20000);
    run<std::int32_t, 2>(seed, 1000000, 5000, 20000);
    run<std::uint8_t, 3>(seed, 100, 20, 20000);
    run<float, 1>(seed, 10000, 10, 20000);
    run<double, 5>(seed, 100, 60, 20000);
  }
}

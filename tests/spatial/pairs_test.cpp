// All intersecting pairs, within a tree and between two, against looking at every pair.
#include <doctest/doctest.h>

#include <random>
#include <set>
#include <spatial/bounding_box_ternary_tree.hpp>

namespace {

template <class T, std::size_t D>
std::vector<spatial::Box<T, D>> boxes(unsigned seed, int count, int range, int size) {
  std::mt19937 random(seed);
  std::vector<spatial::Box<T, D>> result(static_cast<std::size_t>(count));
  for (auto& b : result) {
    for (std::size_t a = 0; a < D; ++a) {
      b.min[a] = static_cast<T>(random() % static_cast<unsigned>(range));
      b.max[a] = static_cast<T>(b.min[a] + static_cast<T>(random() % static_cast<unsigned>(size)));
    }
  }
  return result;
}

template <class T, std::size_t D>
void compare(unsigned seed, int count, int range, int size) {
  const auto a = boxes<T, D>(seed, count, range, size);
  const auto b = boxes<T, D>(seed + 1, count / 2, range, size);
  spatial::BoundingBoxTernaryTree<int, T, D> tree_a;
  spatial::BoundingBoxTernaryTree<std::string, T, D> tree_b;
  for (std::size_t i = 0; i < a.size(); ++i) tree_a.insert(a[i], int(i));
  for (std::size_t i = 0; i < b.size(); ++i) tree_b.insert(b[i], std::to_string(i));
  std::set<std::pair<int, int>> expected, found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (spatial::touch(a[i], a[j])) expected.insert({int(j), int(i)});
    }
  }
  const std::size_t n = tree_a.pairs([&](int i, int j) { found.insert({std::min(i, j), std::max(i, j)}); });
  CHECK(n == expected.size());  // each once
  CHECK(found == expected);
  expected.clear();
  found.clear();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (spatial::touch(a[i], b[j])) expected.insert({int(i), int(j)});
    }
  }
  const std::size_t m =
      tree_a.pairs_with(tree_b, [&](int i, spatial::Handle h, const std::string& j, spatial::Handle g) {
        CHECK(tree_a.value(h) == i);
        CHECK(tree_b.value(g) == j);
        found.insert({i, std::stoi(j)});
      });
  CHECK(m == expected.size());
  CHECK(found == expected);
}

}  // namespace

TEST_CASE("pairs") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    compare<float, 2>(seed, 400, 100, 10);
    compare<double, 3>(seed, 400, 40, 20);
    compare<std::int32_t, 2>(seed, 300, 10, 3);
    compare<float, 1>(seed, 200, 1000, 10);
  }
}

TEST_CASE("no pairs in small and empty trees, and a visitor can stop") {
  spatial::BoundingBoxTernaryTree<int, float, 2> tree, other;
  const auto fail = [](int, int) { FAIL("there is no pair"); };
  CHECK(tree.pairs(fail) == 0);
  CHECK(tree.pairs_with(other, fail) == 0);
  tree.insert(spatial::Point<float, 2>{1, 1}, 1);
  CHECK(tree.pairs(fail) == 0);
  for (int i = 0; i < 100; ++i) tree.insert(spatial::Point<float, 2>{1, 1}, i);
  CHECK(tree.pairs([](int, int) { return false; }) == 1);
  CHECK(tree.pairs([](int, int) {}) == 101 * 100 / 2);
}

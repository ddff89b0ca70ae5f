// The recipes of docs/spatial.md, compiled and run.
#include <doctest/doctest.h>

#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/point_cluster_dictionary.hpp>
#include <spatial/weld.hpp>
#include <string>
#include <vector>

TEST_CASE("recipe: what is here") {
  spatial::BoundingBoxTernaryTree<std::string, float, 2> tree;
  tree.insert(spatial::Box<float, 2>{{0, 0}, {2, 1}}, "table");
  tree.insert(spatial::Point<float, 2>{1, 4}, "lamp");
  std::vector<std::string> found;
  tree.query(spatial::intersects(spatial::Box<float, 2>{{1, 1}, {3, 3}}), std::back_inserter(found));
  CHECK(found == std::vector<std::string>{"table"});
}

TEST_CASE("recipe: things that move") {
  spatial::BoundingBoxTernaryTree<int, double, 3> tree;
  const spatial::Handle ball = tree.insert(spatial::Point<double, 3>{0, 0, 0}, 7);
  CHECK(tree.move(ball, spatial::Point<double, 3>{0, 0, 1}));
  CHECK(tree.erase(ball));
  CHECK_FALSE(tree.move(ball, spatial::Point<double, 3>{0, 0, 2}));  // stale, and known to be
}

TEST_CASE("recipe: the first thing that a ray hits") {
  spatial::BoundingBoxTernaryTree<int, double, 2> tree;
  for (int i = 0; i < 10; ++i) tree.insert(spatial::Box<double, 2>{{i + 0.0, -1.0}, {i + 0.5, 1.0}}, i);
  const spatial::Point<double, 2> eye{20, 0};
  const spatial::Point<double, 2> direction{-1, 0};
  int first = -1;
  tree.query(spatial::ray_hits(eye, direction) && spatial::satisfies([](int i) { return i != 9; }),
             [&](int i) {
               first = i;
               return false;  // one is enough
             });
  CHECK(first == 8);
}

TEST_CASE("recipe: all pairs that touch") {
  using Box = spatial::Box<float, 3>;
  const std::vector<std::pair<Box, int>> boxes{
      {{{0, 0, 0}, {1, 1, 1}}, 0}, {{{1, 1, 1}, {2, 2, 2}}, 1}, {{{3, 3, 3}, {4, 4, 4}}, 2}};
  const spatial::BoundingBoxTernaryTree<int, float, 3> tree(boxes.begin(), boxes.end());
  int pairs = 0;
  tree.pairs([&](int a, int b) {
    CHECK(a + b == 1);
    ++pairs;
  });
  CHECK(pairs == 1);
}

TEST_CASE("recipe: weld the corners of a triangle soup") {
  const std::vector<spatial::Point<double, 3>> corners{{0, 0, 0},    {1, 0, 0}, {0, 1, 0},
                                                       {1, 1e-9, 0}, {1, 1, 0}, {0, 1, 1e-9}};
  const std::vector<std::uint32_t> corner_of = spatial::weld(corners, 1e-6);
  CHECK(corner_of == std::vector<std::uint32_t>{0, 1, 2, 1, 4, 2});
}

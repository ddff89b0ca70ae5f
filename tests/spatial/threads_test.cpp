// Const member functions from several threads at once; the thread sanitizer looks on.
#include <doctest/doctest.h>

#include <atomic>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/point_cluster_dictionary.hpp>
#include <thread>
#include <utility>
#include <vector>

TEST_CASE("many threads may ask one tree and one dictionary") {
  spatial::BoundingBoxTernaryTree<int, double, 2> tree;
  spatial::PointClusterDictionary<double, 2, int> dictionary(0.5);
  for (int i = 0; i < 5000; ++i) {
    const spatial::Point<double, 2> p{i % 71 * 1.0, i % 73 * 1.0};
    tree.insert(p, i);
    dictionary.insert_or_merge(p, i);
  }
  std::vector<std::pair<spatial::Point<double, 2>, int>> points;
  for (auto i = tree.begin(); i != tree.end(); ++i) points.push_back({i.box().min, *i});
  const spatial::BoundingBoxTernaryTree<int, double, 2> loaded(points.begin(), points.end());
  std::atomic<std::size_t> found{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 71; ++i) {
        const spatial::Point<double, 2> p{i * 1.0, i * 1.0};
        found += tree.count(spatial::intersects(p));
        found += loaded.count(spatial::intersects(p));
        found += tree.query(spatial::nearest(p, 3), [](int) {});
        found += tree.pairs([n = 0](int, int) mutable { return ++n < 10; });
        found += dictionary.find_nearest(p).valid() ? 1 : 0;
        for ([[maybe_unused]] int v : tree.query(spatial::intersects(p))) ++found;
        found += tree.bounds().max[0] > 0 ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(found % 4 == 0);
  CHECK(found > 0);
}

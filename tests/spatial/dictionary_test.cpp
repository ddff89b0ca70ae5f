// The point cluster dictionary as a container, against a plain list of clusters.
#include <doctest/doctest.h>

#include <map>
#include <random>
#include <spatial/point_cluster_dictionary.hpp>
#include <spatial/weld.hpp>
#include <string>

namespace {

template <class T, std::size_t D>
struct Model {
  struct Cluster {
    std::vector<std::pair<int, spatial::Point<T, D>>> centres;  // with their age
    std::string value;
  };
  std::map<std::uint32_t, Cluster> clusters;
  int age = 0;
  double distance;

  static double squared(const spatial::Point<T, D>& p, const spatial::Point<T, D>& q) {
    double sum = 0;
    for (std::size_t a = 0; a < D; ++a) sum += (double(p[a]) - double(q[a])) * (double(p[a]) - double(q[a]));
    return sum;
  }
  std::uint32_t nearest(const spatial::Point<T, D>& p) const {
    std::uint32_t best = spatial::ClusterId::invalid_index;
    double best_squared = INFINITY;
    int best_age = 0;
    for (const auto& [id, cluster] : clusters) {
      for (const auto& [centre_age, centre] : cluster.centres) {
        const double s = squared(p, centre);
        if (s > distance * distance || s > best_squared || (s == best_squared && centre_age > best_age))
          continue;
        best = id;
        best_squared = s;
        best_age = centre_age;
      }
    }
    return best;
  }
  std::size_t within(const spatial::Point<T, D>& p) const {
    std::size_t n = 0;
    for (const auto& [id, cluster] : clusters) {
      for (const auto& [centre_age, centre] : cluster.centres)
        n += squared(p, centre) <= distance * distance ? 1 : 0;
    }
    return n;
  }
};

template <class T, std::size_t D>
void run(unsigned seed, int steps, T distance) {
  std::mt19937 random(seed);
  spatial::PointClusterDictionary<T, D, std::string> dictionary(distance);
  Model<T, D> model;
  model.distance = double(distance);
  for (int step = 0; step < steps; ++step) {
    spatial::Point<T, D> p;
    // A lattice of quarters, so that distances of exactly δm and ties are common.
    for (T& x : p) x = static_cast<T>(int(random() % 80) - 40) / 4;
    const auto what = random() % 10;
    const std::uint32_t near = model.nearest(p);
    REQUIRE(dictionary.find_nearest(p).index == near);
    std::size_t within = 0;
    dictionary.for_each_within(p, [&](spatial::ClusterId id, double squared) {
      CHECK(squared <= model.distance * model.distance);
      CHECK(dictionary.contains(id));
      ++within;
    });
    REQUIRE(within == model.within(p));
    if (what < 6) {
      const auto result = dictionary.insert_or_merge(p, std::to_string(step));
      REQUIRE(result.inserted == (near == spatial::ClusterId::invalid_index));
      if (result.inserted) {
        model.clusters[result.cluster.index] = {{{model.age++, p}}, std::to_string(step)};
      } else {
        REQUIRE(result.cluster.index == near);
      }
    } else if (model.clusters.empty()) {
      continue;
    } else {
      const auto which = std::next(model.clusters.begin(), long(random() % model.clusters.size()));
      const spatial::ClusterId id{which->first};
      if (what < 9) {
        REQUIRE(dictionary.erase(id));
        REQUIRE_FALSE(dictionary.erase(id));
        model.clusters.erase(which);
      } else {
        auto& mine = which->second;
        p = mine.centres.front().second;
        p[0] += distance;
        bool taken = false;
        for (const auto& [other, cluster] : model.clusters) {
          for (const auto& [age, centre] : cluster.centres) {
            taken |= other != id.index && model.squared(p, centre) <= model.distance * model.distance;
          }
        }
        REQUIRE(dictionary.add_center(id, p) == !taken);
        if (!taken) mine.centres.push_back({model.age++, p});
      }
    }
    REQUIRE(dictionary.size() == model.clusters.size());
  }
  auto expected = model.clusters.begin();
  for (const spatial::ClusterId id : dictionary) {  // in the order of insertion
    REQUIRE(expected != model.clusters.end());
    CHECK(id.index == expected->first);
    CHECK(dictionary.value(id) == expected->second.value);
    CHECK(dictionary.center(id) == expected->second.centres.front().second);
    ++expected;
  }
  CHECK(expected == model.clusters.end());
}

}  // namespace

TEST_CASE("the dictionary does what a list of clusters does") {
  for (unsigned seed = 0; seed < 5; ++seed) {
    run<double, 2>(seed, 3000, 1.0);
    run<double, 3>(seed, 3000, 2.5);
    run<float, 2>(seed, 3000, 0.75f);
    run<float, 3>(seed, 3000, 3.0f);
  }
}

TEST_CASE("merging two dictionaries") {
  spatial::PointClusterDictionary<double, 2, int> a(1.0), b(1.0);
  const auto a0 = a.insert_or_merge({0, 0}, 1).cluster;
  const auto b0 = b.insert_or_merge({5, 5}, 2).cluster;
  const auto b1 = b.insert_or_merge({0.5, 0}, 3).cluster;
  REQUIRE(b.add_center(b0, {5.8, 5}));
  const auto map = a.merge(b);
  CHECK(a.size() == 2);
  CHECK(map[b1.index] == a0);
  CHECK(a.value(map[b0.index]) == 2);
  CHECK(a.find_nearest({6.7, 5}) == map[b0.index]);
  CHECK(a.value(a0) == 1);
}

TEST_CASE("welding in any order") {
  std::mt19937 random(5);
  std::vector<spatial::Point<double, 2>> points(2000);
  for (auto& p : points) p = {double(random() % 1000) / 100, double(random() % 1000) / 100};
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto first = spatial::weld_in_any_order(points, 0.2);
  std::shuffle(order.begin(), order.end(), random);
  auto shuffled = points;
  for (std::size_t i = 0; i < order.size(); ++i) shuffled[i] = points[order[i]];
  const auto second = spatial::weld_in_any_order(shuffled, 0.2);
  for (std::size_t i = 0; i < order.size(); ++i) CHECK(shuffled[second[i]] == points[first[order[i]]]);
}

TEST_CASE("merge distances without a square are refused") {
  for (const double bad : {0.0, -1.0, 1e-200, 1e200, std::nan("")}) {
    spatial::PointClusterDictionary<double, 2, int> dictionary(bad);
    CHECK_FALSE(dictionary.insert_or_merge({0, 0}, 1).cluster.valid());
  }
}

TEST_CASE("what was erased leaves no memory behind, and its id is not used again") {
  using Dictionary = spatial::PointClusterDictionary<double, 2, int>;
  Dictionary dictionary(0.1);
  std::vector<spatial::ClusterId> ids;
  std::size_t early = 0;
  spatial::ClusterId eldest;
  for (int i = 0; i < 50000; ++i) {
    // Ever new places, so ever new cells; 100 clusters stay, and the very first.
    const auto made = dictionary.insert_or_merge({i * 0.7, i % 13 * 0.3}, i);
    REQUIRE(made.inserted);
    if (i == 0) {
      eldest = made.cluster;
      REQUIRE(dictionary.add_center(eldest, {0.0, 0.15}));
      continue;
    }
    ids.push_back(made.cluster);
    if (ids.size() <= 100) continue;
    const spatial::ClusterId old = ids[ids.size() - 101];
    REQUIRE(dictionary.value(old) == i - 100);
    REQUIRE(dictionary.erase(old));
    REQUIRE_FALSE(dictionary.contains(old));
    REQUIRE_FALSE(dictionary.erase(old));
    if (i == 1000) early = dictionary.bytes();
    if (i > 1000) REQUIRE(dictionary.bytes() <= 2 * early);
  }
  CHECK(dictionary.size() == 101);
  CHECK(dictionary.value(eldest) == 0);
  CHECK(dictionary.find_nearest({0.0, 0.16}) == eldest);
  CHECK(dictionary.contains(ids.back()));
  CHECK_FALSE(dictionary.contains(ids.front()));
  int last = -1;
  for (const spatial::ClusterId id : dictionary) {
    CHECK(dictionary.value(id) > last);
    last = dictionary.value(id);
  }
}

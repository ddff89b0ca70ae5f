// Merging of points: no two centres within the merge distance, the nearest centre wins.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <spatial/point_cluster_dictionary.hpp>
#include <spatial/weld.hpp>

namespace {

template <class T, std::size_t D>
double squared(const spatial::Point<T, D>& p, const spatial::Point<T, D>& q) {
  double sum = 0;
  for (std::size_t a = 0; a < D; ++a) sum += (double(p[a]) - double(q[a])) * (double(p[a]) - double(q[a]));
  return sum;
}

template <class T, std::size_t D>
void compare_with_list(unsigned seed, T distance) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<T> coordinate(-10, 10);
  std::vector<spatial::Point<T, D>> points(3000);
  for (auto& p : points) {
    for (T& x : p) x = coordinate(random);
  }
  const auto result = spatial::weld(points, distance);
  REQUIRE(result.size() == points.size());
  std::vector<std::uint32_t> centres;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::uint32_t best = i;
    double best_squared = double(distance) * double(distance);
    for (const std::uint32_t c : centres) {
      const double s = squared<T, D>(points[i], points[c]);
      if (s < best_squared || (s == best_squared && best == i)) {
        best = c;
        best_squared = s;
      }
    }
    if (best == i) centres.push_back(i);
    REQUIRE(result[i] == best);
  }
}

}  // namespace

TEST_CASE("welding agrees with looking through all centres") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    for (const double distance : {0.01, 0.3, 1.0, 7.0}) {
      compare_with_list<double, 2>(seed, distance);
      compare_with_list<double, 3>(seed, distance);
      compare_with_list<float, 2>(seed, float(distance));
      compare_with_list<float, 3>(seed, float(distance));
    }
  }
}

TEST_CASE("points that no grid index can hold are refused") {
  spatial::PointClusterDictionary<double, 2, int> dictionary(1.0);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_FALSE(dictionary.insert_or_merge({std::nan(""), 0}, 1).cluster.valid());
  CHECK_FALSE(dictionary.insert_or_merge({0, infinity}, 1).cluster.valid());
  CHECK_FALSE(dictionary.insert_or_merge({1e10, 0}, 1).cluster.valid());
  CHECK(dictionary.empty());
  CHECK(dictionary.insert_or_merge({1e9, 0}, 1).inserted);
  CHECK_FALSE(dictionary.insert_or_merge({1e9, 1}, 2).inserted);
  CHECK(dictionary.insert_or_merge({1e9, 1.0000001}, 3).inserted);
}

TEST_CASE("minus zero, zero and denormals are the same place") {
  spatial::PointClusterDictionary<double, 3, int> dictionary(0.5);
  const auto first = dictionary.insert_or_merge({-0.0, 0.0, -0.0}, 1);
  CHECK(dictionary.insert_or_merge({0.0, -0.0, 5e-324}, 2).cluster == first.cluster);
  CHECK(dictionary.insert_or_merge({-5e-324, 0.0, 0.0}, 2).cluster == first.cluster);
  CHECK(dictionary.size() == 1);
}

TEST_CASE("merge distances whose squares a float cannot hold") {
  for (const float unit : {1e-30f, 1e30f}) {
    spatial::PointClusterDictionary<float, 3, int> dictionary(unit);
    std::vector<spatial::Point<float, 3>> centres;
    for (int i = 0; i < 1000; ++i) {
      const spatial::Point<float, 3> p{float(i % 9) * 0.4f * unit, float(i % 11) * 0.7f * unit,
                                       float(i % 7) * 0.3f * unit};
      bool near = false;
      for (const auto& c : centres) near |= squared<float, 3>(p, c) <= double(unit) * double(unit);
      CHECK(dictionary.insert_or_merge(p, i).inserted == !near);
      if (!near) centres.push_back(p);
    }
    CHECK(centres.size() > 10);
  }
}

// The data that the containers are measured with. In: a name, a number, a seed. Out: boxes in the unit cube.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <spatial/box.hpp>
#include <string>
#include <vector>

namespace data {

inline const char* const names[] = {"uniform", "clustered", "heavy_tailed", "overlapping", "grid"};

template <class T, std::size_t D>
std::vector<spatial::Box<T, D>> make(const std::string& name, std::size_t count, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  std::weibull_distribution<double> weibull(0.5, 1);
  // The mean side of a box that covers 1/count of the volume.
  const double side = std::pow(1.0 / static_cast<double>(count), 1.0 / static_cast<double>(D));
  const std::size_t clusters = 1 + count / 1000;
  std::vector<spatial::Point<double, D>> centres(clusters);
  for (auto& c : centres) {
    for (double& x : c) x = unit(random);
  }
  const auto per_axis = static_cast<std::size_t>(std::ceil(1 / side));
  std::vector<spatial::Box<T, D>> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t rest = i;
    const auto& centre = centres[random() % clusters];
    const double tail = std::min(0.5, 0.2 * side * weibull(random) * std::exp(normal(random)));
    for (std::size_t a = 0; a < D; ++a) {
      double low = unit(random);
      double extent = side * unit(random);
      if (name == "clustered") low = centre[a] + 0.005 * normal(random);
      if (name == "heavy_tailed") extent = tail * unit(random);
      if (name == "overlapping") extent = 0.3 * unit(random);
      if (name == "grid") {
        low = static_cast<double>(rest % per_axis) * side;
        rest /= per_axis;
        extent = side;
      }
      boxes[i].min[a] = static_cast<T>(low);
      boxes[i].max[a] = static_cast<T>(low + extent);
    }
  }
  std::shuffle(boxes.begin(), boxes.end(), random);
  return boxes;
}

/// Query boxes around elements, of a size that gives about `hits` hits each. `count(box)` tells the hits of
/// one.
template <class T, std::size_t D, class Count>
std::vector<spatial::Box<T, D>> queries(const std::vector<spatial::Box<T, D>>& boxes, double hits,
                                        std::size_t number, Count&& count) {
  const auto with_half = [&](double half, std::size_t n) {
    std::mt19937_64 random(7);
    std::vector<spatial::Box<T, D>> result(n);
    for (auto& q : result) {
      const auto& b = boxes[random() % boxes.size()];
      for (std::size_t a = 0; a < D; ++a) {
        const double middle = (static_cast<double>(b.min[a]) + static_cast<double>(b.max[a])) / 2;
        q.min[a] = static_cast<T>(middle - half);
        q.max[a] = static_cast<T>(middle + half);
      }
    }
    return result;
  };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 25; ++i) {
    const double half = (low + high) / 2;
    double sum = 0;
    for (const auto& q : with_half(half, 30)) sum += static_cast<double>(count(q));
    (sum / 30 < hits ? low : high) = half;
  }
  return with_half(high, number);
}

/// Points in the unit cube, for the point cluster dictionary.
template <class T, std::size_t D>
std::vector<spatial::Point<T, D>> cloud(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<T> unit(0, 1);
  std::vector<spatial::Point<T, D>> points(count);
  for (auto& p : points) {
    for (T& x : p) x = unit(random);
  }
  return points;
}

/// About one point in three finds a centre.
template <std::size_t D>
double merge_distance(std::size_t count) {
  return 0.5 * std::pow(1.0 / static_cast<double>(count), 1.0 / static_cast<double>(D));
}

}  // namespace data

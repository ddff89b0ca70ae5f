// The k smallest keys are those that sorting gives, for few and many, whatever comes in whatever order; and
// the distances of levels are never too large.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <spatial/detail/level_distances.hpp>
#include <spatial/detail/smallest.hpp>
#include <vector>

namespace {

template <class S>
S random_key(std::mt19937& random, unsigned kind) {
  const S x = static_cast<S>(random() % 100000) / 1000;
  if (kind == 0) return x;
  if (kind == 1) return static_cast<S>(random() % 4);
  if (kind == 2) return std::exp(x);  // most of them in the first bucket
  if (kind == 3) return random() % 3 == 0 ? std::numeric_limits<S>::infinity() : x;
  return std::numeric_limits<S>::min() * x;
}

template <class S>
void check(std::size_t limit, unsigned kind, std::uint32_t count) {
  std::mt19937 random(static_cast<unsigned>(limit) + kind);
  std::vector<S> all;
  spatial::detail::Smallest<S> smallest(limit, count);
  std::uint32_t leaf = 0;
  while (all.size() < count) {
    S keys[64];
    std::uint8_t positions[64];
    std::size_t n = 0;
    const std::size_t most = std::min<std::size_t>(1 + random() % 64, count - all.size());
    for (std::size_t i = 0; i < most; ++i) {
      const S key = random_key<S>(random, kind);
      all.push_back(key);
      keys[n] = key;
      positions[n] = static_cast<std::uint8_t>(i);
      n += key <= smallest.worst() ? 1 : 0;
    }
    smallest.add(leaf++, 0, keys, positions, n);
    if (smallest.full()) {
      // At least `limit` are not beyond the worst.
      const auto kept = std::count_if(all.begin(), all.end(), [&](S x) { return x <= smallest.worst(); });
      CHECK(static_cast<std::size_t>(kept) >= limit);
    }
  }
  std::sort(all.begin(), all.end());
  std::size_t found = 0;
  bool right = true;
  smallest.visit_in_order([&](const auto& item) {
    right &= item.key == all[found++];
    return true;
  });
  CHECK(right);
  CHECK(found == std::min<std::size_t>(limit, count));
}

template <class T, std::size_t D>
void check_distances(const std::vector<T>& numbers) {
  using Box = spatial::Box<T, D>;
  using S = spatial::detail::DistanceOf<T>;
  std::mt19937 random(7);
  const auto box = [&](bool of_points) {
    Box result;
    for (std::size_t a = 0; a < D; ++a) {
      const T x = numbers[random() % numbers.size()];
      const T y = of_points ? x : numbers[random() % numbers.size()];
      result.min[a] = std::min(x, y);
      result.max[a] = std::max(x, y);
    }
    return result;
  };
  for (int n = 0; n < 300; ++n) {
    const auto frame = spatial::detail::Frame<T, D>::around(box(false));
    const Box query = box(n % 2 == 0);
    const spatial::detail::LevelMeasure<T, D> measure(frame, query);
    constexpr std::uint32_t count = 37;  // in the layout of a leaf: 16 + 16 + 5
    spatial::detail::Level levels[2 * D * count + 16];
    Box boxes[count];
    for (std::uint32_t i = 0; i < count; ++i) {
      boxes[i] = box(i % 3 == 0);
      const auto own = frame.bounds(boxes[i].min, boxes[i].max);
      const std::uint32_t block = i / 16 * 16;
      const std::uint32_t stride = std::min(16u, count - block);
      for (std::uint32_t a = 0; a < D; ++a) {
        levels[block * 2 * D + a * stride + i % 16] = own.low[a];
        levels[block * 2 * D + (D + a) * stride + i % 16] = own.high[a];
      }
    }
    spatial::detail::LevelDistances distances;
    distances.compute(measure, levels, 2 * D, 0, D, count, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      long double squared = 0;
      for (std::size_t a = 0; a < D; ++a) {
        const auto gap = std::max(
            {0.0L, static_cast<long double>(static_cast<S>(boxes[i].min[a])) - static_cast<S>(query.max[a]),
             static_cast<long double>(static_cast<S>(query.min[a])) - static_cast<S>(boxes[i].max[a])});
        squared += gap * gap;
      }
      const auto radius =
          static_cast<S>(std::min<long double>(std::sqrt(squared), std::numeric_limits<S>::max()));
      CHECK(((distances.at_most(measure.limit(radius * (1 + std::numeric_limits<S>::epsilon()))) >> i) & 1) ==
            1);
    }
    CHECK(distances.at_most(32766) == spatial::detail::first_level_bits(count));
    for (const std::uint32_t number : {1u, 2u, 20u, 37u}) {
      const auto within = distances.at_most(distances.enclosing(number));
      CHECK(static_cast<std::uint32_t>(std::popcount(within)) >= number);
    }
    std::int16_t last = -1;
    std::uint32_t taken = 0;
    for (std::uint32_t at = 0;; ++taken) {
      const std::int16_t next = distances.least();
      CHECK(next >= last);
      last = next;
      if (!distances.take_nearest(at)) break;
      CHECK(at < count);
    }
    CHECK(taken == count);
  }
}

}  // namespace

TEST_CASE("the smallest keys, in order") {
  for (const std::size_t limit : {1u, 2u, 7u, 15u, 16u, 17u, 18u, 40u, 100u, 999u}) {
    for (unsigned kind = 0; kind < 5; ++kind) {
      for (const std::uint32_t count : {5u, 100u, 1000u, 3000u}) {
        check<float>(limit, kind, count);
        check<double>(limit, kind, count);
      }
    }
  }
}

TEST_CASE("no distance of levels is greater than that of the boxes") {
  using F = std::numeric_limits<float>;
  using N = std::numeric_limits<double>;
  std::vector<double> some;
  std::vector<float> floats;
  for (int i = 0; i < 500; ++i) some.push_back(i * 0.37 - 40);
  for (const double x : some) floats.push_back(static_cast<float>(x));
  check_distances<double, 2>(some);
  check_distances<double, 3>(some);
  check_distances<float, 2>(floats);
  check_distances<float, 4>(floats);
  some.insert(some.end(), {0, 1, 1 + N::epsilon(), 1e9, 1e-9, 1e300, -1e300, N::max(), N::lowest(), N::min(),
                           N::denorm_min(), N::infinity(), -N::infinity()});
  floats.insert(floats.end(), {0, 1, 1 + F::epsilon(), 1e9F, 1e-9F, 1e30F, -1e30F, F::max(), F::lowest(),
                               F::min(), F::denorm_min(), F::infinity(), -F::infinity()});
  for (int i = 0; i < 5; ++i) some.erase(some.begin(), some.begin() + 90);
  for (int i = 0; i < 5; ++i) floats.erase(floats.begin(), floats.begin() + 90);
  check_distances<double, 2>(some);
  check_distances<double, 3>(some);
  check_distances<float, 2>(floats);
  check_distances<std::int64_t, 2>({std::numeric_limits<std::int64_t>::min(), -1, 0, 1, 1000, 123456789,
                                    std::numeric_limits<std::int64_t>::max()});
  check_distances<std::uint8_t, 2>({0, 1, 2, 3, 50, 100, 127, 128, 254, 255});
}

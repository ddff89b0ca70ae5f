// Levels are a monotone function of the coordinate, whatever the frame, so that what they prove is true.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <spatial/detail/levels.hpp>
#include <vector>

namespace {

template <class T>
void check(std::vector<T> numbers) {
  std::sort(numbers.begin(), numbers.end());
  for (const T low : numbers) {
    for (const T high : numbers) {
      if (high < low) continue;
      const auto frame = spatial::detail::Frame<T, 1>::around({{low}, {high}});
      using S = spatial::detail::DistanceOf<T>;
      for (std::size_t i = 1; i < numbers.size(); ++i) {
        CHECK(frame.level(0, static_cast<S>(numbers[i - 1])) <= frame.level(0, static_cast<S>(numbers[i])));
      }
    }
  }
}

template <class T>
std::vector<T> all_kinds() {
  using Limits = std::numeric_limits<T>;
  return {-Limits::infinity(),
          Limits::lowest(),
          T(-1e30),
          T(-1.5),
          -Limits::min(),
          -Limits::denorm_min(),
          T(-0.0),
          T(0),
          Limits::denorm_min(),
          Limits::min(),
          T(1e-30),
          T(1),
          1 + Limits::epsilon(),
          T(2),
          T(1000),
          T(1e9),
          T(1e9) * (1 + Limits::epsilon()),
          Limits::max(),
          Limits::infinity()};
}

}  // namespace

TEST_CASE("levels never fall where coordinates rise") {
  check<float>(all_kinds<float>());
  check<double>(all_kinds<double>());
  using Limits = std::numeric_limits<std::int64_t>;
  check<std::int64_t>({Limits::min(), Limits::min() + 1, -1, 0, 1, 1000, Limits::max() - 1, Limits::max()});
  check<std::uint8_t>({0, 1, 2, 127, 128, 254, 255});
}

TEST_CASE("a box uses nearly all levels, a flat one the middle") {
  const spatial::Box<double, 2> box{{3, 5}, {7, 5}};
  const auto frame = spatial::detail::Frame<double, 2>::around(box);
  const auto inside = frame.bounds(box.min, box.max);
  CHECK(inside.low[0] <= -126);
  CHECK(inside.high[0] >= 125);
  CHECK(inside.high[0] - inside.low[0] > 250);
  CHECK(inside.low[1] == inside.high[1]);
  CHECK(frame.level(0, 2.0) == -128);
  CHECK(frame.level(0, 8.0) == 127);
  CHECK(frame.level(1, 5.1) > inside.high[1]);
}

TEST_CASE("no corner of its box is beside a frame") {
  std::mt19937_64 random(1);
  const auto check = [&](auto zero) {
    using T = decltype(zero);
    for (int i = 0; i < 100000; ++i) {
      // Extents down to some rounding errors of the coordinates, and far beyond.
      const T at = std::uniform_real_distribution<T>(-1, 1)(random);
      const int digits = std::numeric_limits<T>::digits;
      const T extent = std::ldexp(std::uniform_real_distribution<T>(0, 1)(random),
                                  std::uniform_int_distribution<int>(-digits, digits)(random));
      const auto frame = spatial::detail::Frame<T, 1>::around({{at}, {at + extent}});
      REQUIRE(frame.level(0, at) > -128);
      REQUIRE(frame.level(0, at + extent) < 127);
    }
  };
  check(0.0f);
  check(0.0);
}

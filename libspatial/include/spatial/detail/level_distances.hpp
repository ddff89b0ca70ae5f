/// @file
/// Distances that levels (levels.hpp) tell: for each of many boxes a number that its distance from a query is
/// at least, computed for 16 boxes at once. So the nearest are looked at first, and most of the rest never.
/// In: levels, a frame, a query. Out: squared distances as small integers.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "levels.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace spatial::detail {

/// A query among the levels of one frame.
template <class T, std::size_t D>
struct LevelMeasure {
  using S = DistanceOf<T>;
  S scale;                  ///< that of the axis with the widest levels
  std::uint16_t weight[D];  ///< what the square of a difference of one level is worth, by 65536
  LevelBounds<D> query;

  LevelMeasure() = default;
  LevelMeasure(const Frame<T, D>& frame, const Box<T, D>& box)
      : scale(frame.scale[0]), query(frame.bounds(box.min, box.max)) {
    for (std::size_t a = 1; a < D; ++a) scale = frame.scale[a] < scale ? frame.scale[a] : scale;
    for (std::size_t a = 0; a < D; ++a) {
      const auto width = static_cast<float>(scale / frame.scale[a]);
      weight[a] = static_cast<std::uint16_t>(width * width * (65536 * one));
    }
  }
  /// At most the square of the distance from a box to the box that a frame was made around, which no level
  /// tells: good enough for an order.
  [[nodiscard]] static S squared_outside(const Frame<T, D>& frame, const Box<T, D>& box) {
    S sum{};
    for (std::size_t a = 0; a < D; ++a) {
      const S margin = S(1.5) / frame.scale[a];
      const S above = frame.origin[a] + margin - static_cast<S>(box.max[a]);
      const S below = static_cast<S>(box.min[a]) - frame.origin[a] - 169 * margin;
      const S outside = above > below ? above : below;
      const S gap = outside > 0 ? outside : S{0};
      sum += gap * gap;
    }
    return sum;
  }
  /// The square of a length that a distance stands for: good enough for an order.
  [[nodiscard]] S squared(std::int16_t distance) const {
    return static_cast<S>(distance) / (static_cast<S>(one) * scale * scale);
  }
  /// What lies within a radius has at most this distance. Rounding is far smaller than the room for it: a
  /// level is right to a ten thousandth.
  [[nodiscard]] std::int16_t limit(S radius) const {
    constexpr S beyond_all = 10000;
    const S levels = radius * scale;
    const auto r = static_cast<float>(levels < beyond_all ? levels : beyond_all);
    const float squared = r * r * (one * 1.001f);
    return static_cast<std::int16_t>(squared < greatest ? squared : greatest);
  }
  /// No distance is greater: the sum of D squares of 254 is far enough from the end of a signed number.
  static constexpr float greatest = 32766;
  static constexpr float one = 0.5f / static_cast<float>(D);
};

/// The distances of up to level_bits boxes. What is beyond them, and what was taken, is infinitely far.
class LevelDistances {
 public:
  /// Parameters as of sieve(): an element spans from the row `low` to the row `high`. @pre count > 0
  template <class T, std::size_t D>
  void compute(const LevelMeasure<T, D>& to, const Level* levels, std::size_t rows, std::size_t low,
               std::size_t high, std::uint32_t count, std::size_t room) {
    for (std::int16_t& each : distances_) each = never;
    // Two levels that differ by n are more than n - 1 apart.
#ifdef __SSE2__
    const __m128i sign = _mm_set1_epi8(-128);
    const __m128i zero = _mm_setzero_si128();
    __m128i query_low[D], query_high[D], weight[D];
    for (std::size_t a = 0; a < D; ++a) {
      query_low[a] = _mm_xor_si128(_mm_set1_epi8(to.query.low[a]), sign);
      query_high[a] = _mm_xor_si128(_mm_set1_epi8(to.query.high[a]), sign);
      weight[a] = _mm_set1_epi16(static_cast<short>(to.weight[a]));
    }
    const auto load = [&](const Level* from) {
      return _mm_xor_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)), sign);
    };
#endif
    for (std::size_t begin = 0; begin < count; begin += level_block) {
      const Level* block = levels + begin * rows;
      const std::size_t stride = room - begin < level_block ? room - begin : level_block;
#ifdef __SSE2__
      __m128i sum[2] = {zero, zero};
      for (std::size_t a = 0; a < D; ++a) {
        const __m128i above = _mm_subs_epu8(load(block + (low + a) * stride), query_high[a]);
        const __m128i below = _mm_subs_epu8(query_low[a], load(block + (high + a) * stride));
        const __m128i gap = _mm_subs_epu8(_mm_or_si128(above, below), _mm_set1_epi8(1));  // one of them is 0
        const __m128i first = _mm_unpacklo_epi8(gap, zero);
        const __m128i last = _mm_unpackhi_epi8(gap, zero);
        sum[0] = _mm_add_epi16(sum[0], _mm_mulhi_epu16(_mm_mullo_epi16(first, first), weight[a]));
        sum[1] = _mm_add_epi16(sum[1], _mm_mulhi_epu16(_mm_mullo_epi16(last, last), weight[a]));
      }
      std::memcpy(distances_ + begin, sum, sizeof(sum));
#else
      for (std::size_t i = 0; i < level_block; ++i) {
        std::uint32_t sum = 0;
        for (std::size_t a = 0; a < D; ++a) {
          const int above = block[(low + a) * stride + i] - to.query.high[a];
          const int below = to.query.low[a] - block[(high + a) * stride + i];
          const int apart = above > below ? above : below;
          const auto gap = static_cast<std::uint32_t>(apart > 1 ? apart - 1 : 0);
          sum += (gap * gap * to.weight[a]) >> 16;
        }
        distances_[begin + i] = static_cast<std::int16_t>(sum);
      }
#endif
    }
    for (std::size_t i = 0; i < level_block; ++i) distances_[count + i] = never;
  }

  /// The distance of what was not taken yet.
  [[nodiscard]] std::int16_t least() const {
#ifdef __SSE2__
    __m128i least = pack(0);
    for (std::size_t i = 8; i < level_bits; i += 8) least = _mm_min_epi16(least, pack(i));
    least = _mm_min_epi16(least, _mm_shuffle_epi32(least, 0x4e));
    least = _mm_min_epi16(least, _mm_shuffle_epi32(least, 0xb1));
    least = _mm_min_epi16(least, _mm_shufflelo_epi16(least, 0xb1));
    return static_cast<std::int16_t>(_mm_extract_epi16(least, 0));
#else
    std::int16_t result = never;
    for (std::size_t i = 0; i < level_bits; ++i) result = distances_[i] < result ? distances_[i] : result;
    return result;
#endif
  }
  /// The boxes that are not farther than this.
  [[nodiscard]] std::uint64_t at_most(std::int16_t limit) const {
    std::uint64_t result = 0;
#ifdef __SSE2__
    for (std::size_t i = 0; i < level_bits; i += 16) {
      const __m128i beyond = _mm_packs_epi16(_mm_cmpgt_epi16(pack(i), _mm_set1_epi16(limit)),
                                             _mm_cmpgt_epi16(pack(i + 8), _mm_set1_epi16(limit)));
      result |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(beyond))) << i;
    }
    return ~result;
#else
    for (std::size_t i = 0; i < level_bits; ++i) {
      result |= static_cast<std::uint64_t>(distances_[i] <= limit) << i;
    }
    return result;
#endif
  }
  /// Takes one of the nearest. False if all were taken.
  bool take_nearest(std::uint32_t& at) {
    const std::int16_t nearest = least();
    if (nearest == never) return false;
    at = static_cast<std::uint32_t>(std::countr_zero(at_most(nearest)));
    distances_[at] = never;
    return true;
  }
  /// The same of these few. @pre there is one, and none of these was taken
  std::uint32_t take_nearest_of(std::uint64_t these) {
    auto at = static_cast<std::uint32_t>(std::countr_zero(these));
    for (these &= these - 1; these != 0; these &= these - 1) {
      const auto other = static_cast<std::uint32_t>(std::countr_zero(these));
      at = distances_[other] < distances_[at] ? other : at;
    }
    distances_[at] = never;
    return at;
  }
  /// A distance that at least `number` boxes are not beyond, and not many more unless they lie close
  /// together.
  /// @pre 0 < number <= count, none was taken
  [[nodiscard]] std::int16_t enclosing(std::uint32_t number) const {
    int inner = least();
    if (number == 1) return static_cast<std::int16_t>(inner);
    int outer = never - 1;
    constexpr int steps = 8;
    --inner;
    for (int i = 0; i < steps; ++i) {
      const int middle = (inner + outer) / 2;
      const bool is_enough = number_at_most(static_cast<std::int16_t>(middle)) >= number;
      outer = is_enough ? middle : outer;
      inner = is_enough ? inner : middle;
    }
    return static_cast<std::int16_t>(outer);
  }

 private:
  static constexpr std::int16_t never = 32767;

#ifdef __SSE2__
  [[nodiscard]] __m128i pack(std::size_t at) const {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(distances_ + at));
  }
#endif

  [[nodiscard]] std::uint32_t number_at_most(std::int16_t limit) const {
#ifdef __SSE2__
    __m128i beyond = _mm_setzero_si128();
    for (std::size_t i = 0; i < level_bits; i += 8) {
      beyond = _mm_add_epi16(beyond, _mm_cmpgt_epi16(pack(i), _mm_set1_epi16(limit)));
    }
    beyond = _mm_madd_epi16(beyond, _mm_set1_epi16(1));
    beyond = _mm_add_epi32(beyond, _mm_shuffle_epi32(beyond, 0x4e));
    beyond = _mm_add_epi32(beyond, _mm_shuffle_epi32(beyond, 0xb1));
    return level_bits + static_cast<std::uint32_t>(_mm_cvtsi128_si32(beyond));
#else
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < level_bits; ++i) result += distances_[i] <= limit ? 1 : 0;
    return result;
#endif
  }

  std::int16_t distances_[level_bits + level_block];
};

}  // namespace spatial::detail

/// @file
/// Coarse coordinates: one byte for each coordinate of a leaf's boxes (leaf.hpp). A query compares 16 bytes
/// at once, and looks at the exact coordinates only where a byte is equal to its own.
///
/// Exact nevertheless: a byte is a monotone function of the coordinate, the same one for elements and
/// queries; so byte(x) < byte(y) proves x < y, wherever the frame lies. In: bytes and bounds. Out: one bit
/// per element.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "../box.hpp"

namespace spatial::detail {

/// Distances and levels of integers are computed in double.
template <class T>
using DistanceOf = std::conditional_t<std::is_floating_point_v<T>, T, double>;

/// Signed, since that is what SSE2 compares.
using Level = std::int8_t;

/// Elements whose levels lie side by side.
inline constexpr std::size_t level_block = 16;
/// As many elements as one mask of levels has bits.
inline constexpr std::uint32_t level_bits = 64;

/// The levels of two bounds per axis.
template <std::size_t D>
struct LevelBounds {
  Level low[D];
  Level high[D];
};

/// How coordinates become levels: 1 to 253 lie inside of a box, 0 and 255 beside it.
template <class T, std::size_t D>
struct Frame {
  using S = DistanceOf<T>;
  S origin[D];
  S scale[D];

  /// @pre is_valid(box)
  static Frame around(const Box<T, D>& box) {
    constexpr S huge = std::numeric_limits<S>::max() / 4;
    constexpr S tiny = std::numeric_limits<S>::min() * 1024;
    Frame frame;
    for (std::size_t a = 0; a < D; ++a) {
      S low = static_cast<S>(box.min[a]);
      S high = static_cast<S>(box.max[a]);
      low = low < -huge ? -huge : low > huge ? huge : low;
      high = high < -huge ? -huge : high > huge ? huge : high;
      S extent = high - low;
      // From this extent on, rounding the origin moves the box by less than half a level. Below, the middle
      // level is where it begins.
      const S rounding = (low < 0 ? -low : low) * (256 * std::numeric_limits<S>::epsilon());
      const S least = rounding > tiny ? rounding : tiny;
      const bool flat = extent < least;
      if (flat) extent = 2 * least;
      frame.scale[a] = 252 / extent;
      frame.origin[a] = low - (flat ? least : extent * S(1.5) / 252);
    }
    return frame;
  }

  /// Monotone in x, whatever is rounded. NaN has the lowest level.
  [[nodiscard]] Level level(std::size_t axis, S x) const {
    S v = (x - origin[axis]) * scale[axis];
    v = v > 0 ? v : S{0};
    v = v < 255 ? v : S{255};
    return static_cast<Level>(static_cast<int>(v) - 128);
  }
  template <class X>
  [[nodiscard]] LevelBounds<D> bounds(const X& low, const X& high) const {
    LevelBounds<D> result;
#if defined(__GNUC__) && defined(__SSE2__)
    // As level() does it, two at a time: without branches, which are taken at random for a query's bounds.
    if constexpr (std::is_same_v<S, double> || std::is_same_v<S, float>) {
      typedef S V __attribute__((vector_size(16)));
      for (std::size_t a = 0; a < D; ++a) {
        V v{static_cast<S>(low[a]), static_cast<S>(high[a])};
        v = (v - origin[a]) * scale[a];
        v = v > V{} ? v : V{};
        v = v < V{} + 255 ? v : V{} + 255;
        result.low[a] = static_cast<Level>(static_cast<int>(v[0]) - 128);
        result.high[a] = static_cast<Level>(static_cast<int>(v[1]) - 128);
      }
      return result;
    }
#endif
    for (std::size_t a = 0; a < D; ++a) {
      result.low[a] = level(a, static_cast<S>(low[a]));
      result.high[a] = level(a, static_cast<S>(high[a]));
    }
    return result;
  }
};

/// What levels tell: `sure` satisfies strictly, what is not in `maybe` does not satisfy.
struct Sieved {
  std::uint64_t maybe;
  std::uint64_t sure;
  [[nodiscard]] std::uint64_t open() const { return maybe & ~sure; }
};

inline std::uint64_t first_level_bits(std::uint32_t count) {
  return count >= level_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// Compares one row of each of two levels per axis: an element satisfies if first[a] <= upper[a] and
/// lower[a] <= second[a] on every axis. Block b begins at levels + b * rows * level_block; its rows are as
/// far apart as it is wide, which is what is left of `room` for the last one. `first` and `second` are the
/// rows of axis 0. Levels beyond a row are readable up to a whole block. @pre count <= level_bits
template <std::size_t D>
Sieved sieve(const Level* levels, std::size_t rows, std::size_t first, std::size_t second,
             std::uint32_t count, std::size_t room, const Level (&upper)[D], const Level (&lower)[D]) {
  Sieved result{0, 0};
  for (std::uint32_t begin = 0; begin < count; begin += level_block) {
    const Level* block = levels + begin * rows;
    const std::size_t stride = room - begin < level_block ? room - begin : level_block;
    std::uint64_t outside_bits = 0;
    std::uint64_t sure_bits = 0;
#if defined(__GNUC__) && defined(__SSE2__)
    typedef signed char V __attribute__((vector_size(16)));
    typedef char Chars __attribute__((vector_size(16)));
    V outside{};
    V sure = ~V{};
    for (std::size_t a = 0; a < D; ++a) {
      V x, y;
      std::memcpy(&x, block + (first + a) * stride, sizeof(V));
      std::memcpy(&y, block + (second + a) * stride, sizeof(V));
      const V high = V{} + upper[a];
      const V low = V{} + lower[a];
      outside |= (x > high) | (low > y);
      sure &= (high > x) & (y > low);
    }
    outside_bits = static_cast<std::uint32_t>(__builtin_ia32_pmovmskb128(reinterpret_cast<Chars>(outside)));
    sure_bits = static_cast<std::uint32_t>(__builtin_ia32_pmovmskb128(reinterpret_cast<Chars>(sure)));
#else
    for (std::size_t i = 0; i < level_block; ++i) {
      bool outside = false;
      bool sure = true;
      for (std::size_t a = 0; a < D; ++a) {
        const Level x = block[(first + a) * stride + i];
        const Level y = block[(second + a) * stride + i];
        outside |= x > upper[a] || lower[a] > y;
        sure &= upper[a] > x && y > lower[a];
      }
      outside_bits |= static_cast<std::uint64_t>(outside) << i;
      sure_bits |= static_cast<std::uint64_t>(sure) << i;
    }
#endif
    result.maybe |= (outside_bits ^ 0xffffu) << begin;
    result.sure |= sure_bits << begin;
  }
  const std::uint64_t alive = first_level_bits(count);
  return {result.maybe & alive, result.sure & alive};
}

}  // namespace spatial::detail

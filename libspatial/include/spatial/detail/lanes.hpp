/// @file
/// Tests one box against many at once. The many are given as rows of coordinates (node.hpp, cell_grid.hpp).
/// In: rows and two bounds per axis. Out: one bit per box. Plain C++ where the compiler has no x86 vectors;
/// same answer everywhere.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../box.hpp"

namespace spatial::detail {

/// Rows of coordinates: min[a] begins at first + a * stride, max[a] at that + upper, which is 0 where all
/// boxes are points.
template <class T, std::size_t D>
struct Rows {
  const T* first;
  std::size_t stride;
  std::size_t upper;
  [[nodiscard]] T min(std::size_t axis, std::size_t i) const { return low(axis)[i]; }
  [[nodiscard]] T max(std::size_t axis, std::size_t i) const { return high(axis)[i]; }
  [[nodiscard]] const T* low(std::size_t axis) const { return first + axis * stride; }
  [[nodiscard]] const T* high(std::size_t axis) const { return first + upper + axis * stride; }
  [[nodiscard]] Box<T, D> box(std::size_t i) const {
    Box<T, D> result;
    for (std::size_t a = 0; a < D; ++a) {
      result.min[a] = min(a, i);
      result.max[a] = max(a, i);
    }
    return result;
  }
};

/// As many boxes as one mask has bits.
inline constexpr std::size_t mask_bits = 32;

#if defined(__GNUC__) && defined(__SSE2__)
#define SPATIAL_WIDE 1
template <class T>
struct Pack {
  static constexpr std::size_t width = 0;
};
#if defined(__AVX__)
template <>
struct Pack<float> {
  static constexpr std::size_t width = 8;
  typedef float V __attribute__((vector_size(32)));
  typedef std::int32_t M __attribute__((vector_size(32)));
  static std::uint32_t bits(M m) {
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<V>(m)));
  }
};
template <>
struct Pack<double> {
  static constexpr std::size_t width = 4;
  typedef double V __attribute__((vector_size(32)));
  typedef std::int64_t M __attribute__((vector_size(32)));
  static std::uint32_t bits(M m) {
    return static_cast<std::uint32_t>(__builtin_ia32_movmskpd256(reinterpret_cast<V>(m)));
  }
};
#else
template <>
struct Pack<float> {
  static constexpr std::size_t width = 4;
  typedef float V __attribute__((vector_size(16)));
  typedef std::int32_t M __attribute__((vector_size(16)));
  static std::uint32_t bits(M m) {
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<V>(m)));
  }
};
template <>
struct Pack<double> {
  static constexpr std::size_t width = 2;
  typedef double V __attribute__((vector_size(16)));
  typedef std::int64_t M __attribute__((vector_size(16)));
  static std::uint32_t bits(M m) {
    return static_cast<std::uint32_t>(__builtin_ia32_movmskpd(reinterpret_cast<V>(m)));
  }
};
#endif
#endif

inline void prefetch([[maybe_unused]] const void* address) {
#ifdef __GNUC__
  __builtin_prefetch(address);
#endif
}

inline std::uint32_t first_bits(std::size_t count) {
  return count >= mask_bits ? 0xffffffffu : (1u << count) - 1u;
}

/// Which of the numbers are below a bound; with `or_equal`, not above it. Numbers beyond `count` are readable
/// up to a whole pack. @pre count <= mask_bits
template <class T>
std::uint32_t below(const T* numbers, std::size_t count, T bound, bool or_equal) {
  std::uint32_t result = 0;
#ifdef SPATIAL_WIDE
  if constexpr (Pack<T>::width != 0) {
    using V = typename Pack<T>::V;
    for (std::size_t i = 0; i < count; i += Pack<T>::width) {
      V v;
      std::memcpy(&v, numbers + i, sizeof(V));
      result |= Pack<T>::bits(or_equal ? v <= bound : v < bound) << i;
    }
    return result & first_bits(count);
  }
#endif
  for (std::size_t i = 0; i < count; ++i) {
    result |= static_cast<std::uint32_t>(or_equal ? numbers[i] <= bound : numbers[i] < bound) << i;
  }
  return result;
}

/// Of the boxes of a node's three children those with first[a] <= upper[a] and lower[a] <= second[a] on every
/// axis, where row a of each begins at first + a * stride. Numbers beyond the third are readable up to a
/// whole pack.
template <class T, std::size_t D>
std::uint32_t three_between(const T* first, const T* second, std::size_t stride, const Point<T, D>& upper,
                            const Point<T, D>& lower) {
#ifdef SPATIAL_WIDE
  if constexpr (Pack<T>::width != 0) {
    using P = Pack<T>;
    using V = typename P::V;
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < 3; i += P::width) {
      typename P::M inside{};
      for (std::size_t a = 0; a < D; ++a) {
        V x, y;
        std::memcpy(&x, first + a * stride + i, sizeof(V));
        std::memcpy(&y, second + a * stride + i, sizeof(V));
        const auto both = (x <= upper[a]) & (y >= lower[a]);
        inside = a == 0 ? both : inside & both;
      }
      result |= P::bits(inside) << i;
    }
    return result & 7u;
  }
#endif
  std::uint32_t result = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    bool inside = true;
    for (std::size_t a = 0; a < D; ++a) {
      inside &= first[a * stride + i] <= upper[a] && second[a * stride + i] >= lower[a];
    }
    result |= static_cast<std::uint32_t>(inside) << i;
  }
  return result;
}

/// The children with min <= high and max >= low on every axis: with low, high = q.min, q.max those that touch
/// q; with q.max, q.min those that cover it.
template <class T, std::size_t D>
std::uint32_t reaching(const Rows<T, D>& rows, const Point<T, D>& low, const Point<T, D>& high) {
  return three_between<T, D>(rows.low(0), rows.high(0), rows.stride, high, low);
}

/// The children with low <= min and max <= high on every axis.
template <class T, std::size_t D>
std::uint32_t covered(const Rows<T, D>& rows, const Point<T, D>& low, const Point<T, D>& high) {
  return three_between<T, D>(rows.high(0), rows.low(0), rows.stride, high, low);
}

/// The points with a squared distance of at most `bound` from `point`; row r begins at rows + r * stride.
/// @pre count <= mask_bits
template <class T, std::size_t D>
std::uint32_t in_reach(const T* rows, std::size_t stride, std::size_t count, const Point<T, D>& point,
                       T bound) {
  std::uint32_t result = 0;
#ifdef SPATIAL_WIDE
  if constexpr (Pack<T>::width != 0) {
    using P = Pack<T>;
    using V = typename P::V;
    for (std::size_t i = 0; i < count; i += P::width) {
      V sum{};
      for (std::size_t a = 0; a < D; ++a) {
        V x;
        std::memcpy(&x, rows + a * stride + i, sizeof(V));
        const V gap = x - point[a];
        sum += gap * gap;
      }
      result |= P::bits(sum <= bound) << i;
    }
    return result & first_bits(count);
  }
#endif
  for (std::size_t i = 0; i < count; ++i) {
    T sum{};
    for (std::size_t a = 0; a < D; ++a) {
      const T gap = rows[a * stride + i] - point[a];
      sum += gap * gap;
    }
    result |= static_cast<std::uint32_t>(sum <= bound) << i;
  }
  return result;
}

}  // namespace spatial::detail

/// @file
/// Points and boxes, and the traits by which foreign types are understood (§5.1: "bounding box" is always an
/// axis-aligned one). In: any type with a GeometryTraits specialisation. Out: Box<T, D>.
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace spatial {

/// A point with D coordinates.
template <class T, std::size_t D>
using Point = std::array<T, D>;

/// A closed axis-aligned box: it contains its border. It may be a point (min == max). A box with min > max on
/// an axis, or with a NaN, is not valid; infinite coordinates are.
template <class T, std::size_t D>
struct Box {
  Point<T, D> min;
  Point<T, D> max;
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// How a type is read as a box. Specialise it for a type of your own with
///   using Scalar = ...;  static constexpr std::size_t dimension = ...;
///   static Scalar min(const G&, std::size_t axis);  static Scalar max(const G&, std::size_t axis);
/// A point returns the same coordinate twice.
template <class G>
struct GeometryTraits;

template <class T, std::size_t D>
struct GeometryTraits<Box<T, D>> {
  using Scalar = T;
  static constexpr std::size_t dimension = D;
  static constexpr T min(const Box<T, D>& box, std::size_t axis) { return box.min[axis]; }
  static constexpr T max(const Box<T, D>& box, std::size_t axis) { return box.max[axis]; }
};

template <class T, std::size_t D>
  requires std::is_arithmetic_v<T>
struct GeometryTraits<std::array<T, D>> {
  using Scalar = T;
  static constexpr std::size_t dimension = D;
  static constexpr T min(const std::array<T, D>& point, std::size_t axis) { return point[axis]; }
  static constexpr T max(const std::array<T, D>& point, std::size_t axis) { return point[axis]; }
};

/// A type that is read as a box of D coordinates, each of which T holds without loss.
template <class G, class T, std::size_t D>
concept Geometry = requires(const G& g) {
  T{GeometryTraits<G>::min(g, std::size_t{})};
  T{GeometryTraits<G>::max(g, std::size_t{})};
  requires GeometryTraits<G>::dimension == D;
};

/// The box of any geometry.
template <class T, std::size_t D, class G>
  requires Geometry<G, T, D>
[[nodiscard]] constexpr Box<T, D> to_box(const G& geometry) {
  Box<T, D> box{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    box.min[axis] = GeometryTraits<G>::min(geometry, axis);
    box.max[axis] = GeometryTraits<G>::max(geometry, axis);
  }
  return box;
}

/// True if min <= max on every axis; false for inverted boxes and for NaN.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool is_valid(const Box<T, D>& box) {
  bool valid = true;
  for (std::size_t axis = 0; axis < D; ++axis) valid &= box.min[axis] <= box.max[axis];
  return valid;
}

/// True if the box has no extent on any axis.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool is_point(const Box<T, D>& box) {
  bool result = true;
  for (std::size_t axis = 0; axis < D; ++axis) result &= box.min[axis] == box.max[axis];
  return result;
}

/// The box that contains nothing and that extend() grows from: min > max on every axis.
template <class T, std::size_t D>
[[nodiscard]] constexpr Box<T, D> empty_box() {
  using Limits = std::numeric_limits<T>;
  Box<T, D> box{};
  for (std::size_t axis = 0; axis < D; ++axis) {
    box.min[axis] = Limits::has_infinity ? Limits::infinity() : Limits::max();
    box.max[axis] = Limits::has_infinity ? -Limits::infinity() : Limits::lowest();
  }
  return box;
}

/// Grows `box` until it contains `other`.
template <class T, std::size_t D>
constexpr void extend(Box<T, D>& box, const Box<T, D>& other) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    box.min[axis] = other.min[axis] < box.min[axis] ? other.min[axis] : box.min[axis];
    box.max[axis] = other.max[axis] > box.max[axis] ? other.max[axis] : box.max[axis];
  }
}

/// True if no point of `inner` is outside of `outer`.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool encloses(const Box<T, D>& outer, const Box<T, D>& inner) {
  bool result = true;
  for (std::size_t axis = 0; axis < D; ++axis) {
    result &= outer.min[axis] <= inner.min[axis] && inner.max[axis] <= outer.max[axis];
  }
  return result;
}

/// True if the closed boxes have a point in common.
template <class T, std::size_t D>
[[nodiscard]] constexpr bool touch(const Box<T, D>& a, const Box<T, D>& b) {
  bool result = true;
  for (std::size_t axis = 0; axis < D; ++axis) {
    result &= a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis];
  }
  return result;
}

}  // namespace spatial

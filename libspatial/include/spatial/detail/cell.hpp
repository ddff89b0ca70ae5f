/// @file
/// The volume of a tree node (§5.1): where it may be split, what falls below, above or across the split
/// plane, and how the volume of the root grows when something lies outside. In: boxes. Out: axes, planes and
/// sides.
#pragma once
#include <cstdint>
#include <limits>
#include <type_traits>

#include "../box.hpp"

namespace spatial::detail {

enum Side : std::uint32_t { lower = 0, higher = 1, centric = 2 };

/// Half the distance from lo to hi, in a type that cannot overflow.
template <class T>
constexpr auto half_extent(T lo, T hi) {
  if constexpr (std::is_floating_point_v<T>) {
    return hi / 2 - lo / 2;
  } else {
    using U = std::make_unsigned_t<T>;
    return static_cast<U>(static_cast<U>(static_cast<U>(hi) - static_cast<U>(lo)) / 2);
  }
}

/// The middle of lo and hi, or lo if there is no number between them.
template <class T>
constexpr T centre(T lo, T hi) {
  if constexpr (std::is_floating_point_v<T>) {
    const T sum = lo + hi;
    const T limit = std::numeric_limits<T>::max();
    const T middle = -limit <= sum && sum <= limit ? sum / 2 : lo / 2 + hi / 2;
    return lo < middle && middle < hi ? middle : lo;
  } else {
    using U = std::make_unsigned_t<T>;
    return static_cast<T>(static_cast<U>(lo) + half_extent(lo, hi));
  }
}

/// x + distance or x - distance, held within the finite numbers. distance is given by its half.
template <class T, class H>
constexpr T saturated_up(T x, H half) {
  const T limit = std::numeric_limits<T>::max();
  const H room = half_extent(x, limit);
  if (half >= room) return limit;
  if constexpr (std::is_floating_point_v<T>) {
    return x + half + half;
  } else {
    return static_cast<T>(static_cast<H>(x) + half + half);
  }
}
template <class T, class H>
constexpr T saturated_down(T x, H half) {
  const T limit = std::numeric_limits<T>::lowest();
  const H room = half_extent(limit, x);
  if (half >= room) return limit;
  if constexpr (std::is_floating_point_v<T>) {
    return x - half - half;
  } else {
    return static_cast<T>(static_cast<H>(x) - half - half);
  }
}

/// Where [lo, hi] lies to the plane. What touches the plane from one side belongs to that side.
template <class T>
constexpr Side side_of(T lo, T hi, T plane) {
  // Arithmetic instead of branches: while the tree is walked, the side is as good as random.
  const auto not_lower = static_cast<std::uint32_t>(!(hi <= plane));
  const auto is_higher = static_cast<std::uint32_t>(lo >= plane);
  return static_cast<Side>(not_lower * (2u - is_higher));
}

/// A split: the axis and where on it. axis == D says that there is none.
template <class T, std::size_t D>
struct Split {
  std::size_t axis = D;
  T plane{};
  [[nodiscard]] constexpr bool exists() const { return axis != D; }
};

/// The volume of a node. On an axis that is no longer divisible, min == max == the plane that everything in
/// the node crosses.
template <class T, std::size_t D>
struct Cell {
  Box<T, D> box;
  std::uint32_t divisible = 0;  ///< one bit per axis

  static constexpr std::uint32_t all_axes = D >= 32 ? 0xffffffffu : (1u << D) - 1u;

  [[nodiscard]] constexpr bool is_divisible(std::size_t axis) const {
    return ((divisible >> axis) & 1u) != 0;
  }

  /// True if `element` belongs into this volume.
  [[nodiscard]] constexpr bool holds(const Box<T, D>& element) const {
    bool result = true;
    for (std::size_t a = 0; a < D; ++a) {
      result &= is_divisible(a) ? box.min[a] <= finite(element.min[a]) && finite(element.max[a]) <= box.max[a]
                                : element.min[a] < box.min[a] && box.min[a] < element.max[a];
    }
    return result;
  }

  /// The split of §5.1: at the centre of the longest axis that is divisible and still has a number inside.
  [[nodiscard]] constexpr Split<T, D> split() const {
    Split<T, D> best;
    decltype(half_extent(T{}, T{})) best_extent{};
    for (std::size_t a = 0; a < D; ++a) {
      if (!is_divisible(a)) continue;
      const auto extent = half_extent(box.min[a], box.max[a]);
      const T middle = centre(box.min[a], box.max[a]);
      if (box.min[a] < middle && (!best.exists() || extent > best_extent)) {
        best = {a, middle};
        best_extent = extent;
      }
    }
    return best;
  }

  /// The volume of a child of this node: trimmed to the plane, or without the axis.
  [[nodiscard]] constexpr Cell child(const Split<T, D>& at, Side side) const {
    Cell cell = *this;
    if (side != higher) cell.box.max[at.axis] = at.plane;
    if (side != lower) cell.box.min[at.axis] = at.plane;
    if (side == centric) cell.divisible &= ~(1u << at.axis);
    return cell;
  }

  /// The first volume of a root: the cube at the lower corner of what it has to hold. A cube, since then
  /// doubling one axis after the other always doubles the longest one, so that a grown root is split as §5.1
  /// says.
  /// @param roomy adds a margin on all sides, for what will lie a little outside: each doubling of the root
  /// is a node more on every way down
  static constexpr Cell cube_around(const Box<T, D>& bounds, bool roomy = false) {
    Cell cell{bounds, all_axes};
    decltype(half_extent(T{}, T{})) side{};
    for (std::size_t a = 0; a < D; ++a) {
      cell.box.min[a] = finite(bounds.min[a]);
      cell.box.max[a] = finite(bounds.max[a]);
      const auto extent = half_extent(cell.box.min[a], cell.box.max[a]);
      side = extent > side ? extent : side;
    }
    const auto margin = roomy ? static_cast<decltype(side)>(side / 16) : decltype(side){};
    side = static_cast<decltype(side)>(side + 2 * margin);
    for (std::size_t a = 0; a < D; ++a) {
      cell.box.min[a] = saturated_down(cell.box.min[a], margin);
      const T high = saturated_up(cell.box.min[a], side);
      cell.box.max[a] = high > cell.box.max[a] ? high : cell.box.max[a];
    }
    return cell;
  }

  /// Doubles this volume, shortest axis first and towards `element`, until it holds the element. Returns the
  /// split of the grown volume; the old volume lies wholly on side `old_side` of it, and the element does
  /// not.
  /// @pre !holds(element), and all axes are divisible
  constexpr Split<T, D> grow_to_hold(const Box<T, D>& element, Side& old_side) {
    Split<T, D> last;
    while (!holds(element)) {
      std::size_t axis = D;
      bool best_out = false;
      decltype(half_extent(T{}, T{})) best_extent{};
      for (std::size_t a = 0; a < D; ++a) {
        const bool out = finite(element.min[a]) < box.min[a] || finite(element.max[a]) > box.max[a];
        const bool can_grow =
            box.min[a] > std::numeric_limits<T>::lowest() || box.max[a] < std::numeric_limits<T>::max();
        if (!can_grow) continue;
        const auto extent = half_extent(box.min[a], box.max[a]);
        if (axis == D || extent < best_extent || (extent == best_extent && out && !best_out)) {
          axis = a;
          best_out = out;
          best_extent = extent;
        }
      }
      const bool down =
          finite(element.min[axis]) < box.min[axis] || box.max[axis] == std::numeric_limits<T>::max();
      // A volume whose extent is lost in rounding would never double.
      const T border = down ? box.min[axis] : box.max[axis];
      const auto step = best_extent > smallest_step(border) ? best_extent : smallest_step(border);
      if (down) {
        last = {axis, box.min[axis]};
        old_side = higher;
        box.min[axis] = saturated_down(box.min[axis], step);
      } else {
        last = {axis, box.max[axis]};
        old_side = lower;
        box.max[axis] = saturated_up(box.max[axis], step);
      }
    }
    return last;
  }

 private:
  // An infinite side lies in the outermost cell.
  static constexpr T finite(T x) {
    if constexpr (std::numeric_limits<T>::has_infinity) {
      const T limit = std::numeric_limits<T>::max();
      return x < -limit ? -limit : x > limit ? limit : x;
    } else {
      return x;
    }
  }
  static constexpr auto smallest_step([[maybe_unused]] T x) {
    if constexpr (std::is_floating_point_v<T>) {
      const T step = (x < 0 ? -x : x) * std::numeric_limits<T>::epsilon();
      return step > std::numeric_limits<T>::min() ? step : std::numeric_limits<T>::min();
    } else {
      return static_cast<decltype(half_extent(T{}, T{}))>(1);
    }
  }
};

}  // namespace spatial::detail

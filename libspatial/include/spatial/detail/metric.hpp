/// @file
/// The orders in which ordered queries find elements: distance from a box, and distance along a path. In:
/// rows of boxes. Out: a number per box, smaller for a box that encloses another, or `never`.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "../box.hpp"
#include "../predicates.hpp"
#include "lanes.hpp"
#include "levels.hpp"

namespace spatial::detail {

/// Room for the keys of one mask of boxes, and what a wide write adds to them.
inline constexpr std::size_t keys_room = mask_bits + 8;

/// Squared Euclidean distance from a box. Squares that overflow are infinite, and tie.
template <class T, std::size_t D>
class BoxMetric {
 public:
  using S = DistanceOf<T>;
  static constexpr S never = std::numeric_limits<S>::quiet_NaN();
  explicit BoxMetric(const Box<T, D>& query) : q_(query), valid_(is_valid(query)) {}

  /// keys[i] is the key of box i, or NaN for one that is never reached. There is room for keys_room of them;
  /// those beyond `count` mean nothing. @pre count <= mask_bits
  void keys(const Rows<T, D>& rows, std::size_t count, S* keys) const {
#ifdef SPATIAL_WIDE
    if constexpr (Pack<T>::width != 0) {
      using V = typename Pack<T>::V;
      for (std::size_t i = 0; i < count; i += Pack<T>::width) {
        V sum = V{} + (valid_ ? S{0} : never);
        for (std::size_t a = 0; a < D; ++a) {
          V low, high;
          std::memcpy(&low, rows.low(a) + i, sizeof(V));
          std::memcpy(&high, rows.high(a) + i, sizeof(V));
          const V above = low - q_.max[a];
          const V below = q_.min[a] - high;
          const V outside = above > below ? above : below;
          const V gap = outside > V{} ? outside : V{};
          sum += gap * gap;
        }
        std::memcpy(keys + i, &sum, sizeof(V));
      }
      return;
    }
#endif
    for (std::size_t i = 0; i < count; ++i) keys[i] = valid_ ? S{0} : never;
    for (std::size_t a = 0; a < D; ++a) {
      const T* low = rows.low(a);
      const T* high = rows.high(a);
      const S least = static_cast<S>(q_.min[a]);
      const S greatest = static_cast<S>(q_.max[a]);
      for (std::size_t i = 0; i < count; ++i) {
        const S above = static_cast<S>(low[i]) - greatest;
        const S below = least - static_cast<S>(high[i]);
        const S outside = above > below ? above : below;
        const S gap = outside > 0 ? outside : S{0};
        keys[i] += gap * gap;
      }
    }
  }
  /// The key of one box, by its corners. Without branches, which would be taken at random.
  [[nodiscard]] S key(const T* min, const T* max) const {
    S sum = valid_ ? S{0} : never;
    std::size_t a = 0;
#ifdef __SSE2__
    // Two axes at a time, each rounded as in keys().
    if constexpr (std::is_same_v<T, double>) {
      for (; a + 2 <= D; a += 2) {
        const __m128d above = _mm_sub_pd(_mm_loadu_pd(min + a), _mm_loadu_pd(&q_.max[a]));
        const __m128d below = _mm_sub_pd(_mm_loadu_pd(&q_.min[a]), _mm_loadu_pd(max + a));
        const __m128d gap = _mm_max_pd(_mm_max_pd(above, below), _mm_setzero_pd());
        sum += gap[0] * gap[0];
        sum += gap[1] * gap[1];
      }
      if (a < D) {
        const __m128d above = _mm_sub_sd(_mm_load_sd(min + a), _mm_load_sd(&q_.max[a]));
        const __m128d below = _mm_sub_sd(_mm_load_sd(&q_.min[a]), _mm_load_sd(max + a));
        const __m128d gap = _mm_max_sd(_mm_max_sd(above, below), _mm_setzero_pd());
        sum += gap[0] * gap[0];
      }
      return sum;
    }
    if constexpr (std::is_same_v<T, float>) {
      const auto two = [](const float* from) {
        return _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
      };
      for (; a + 2 <= D; a += 2) {
        const __m128 above = _mm_sub_ps(two(min + a), two(&q_.max[a]));
        const __m128 below = _mm_sub_ps(two(&q_.min[a]), two(max + a));
        const __m128 gap = _mm_max_ps(_mm_max_ps(above, below), _mm_setzero_ps());
        sum += gap[0] * gap[0];
        sum += gap[1] * gap[1];
      }
      if (a < D) {
        const __m128 above = _mm_sub_ss(_mm_load_ss(min + a), _mm_load_ss(&q_.max[a]));
        const __m128 below = _mm_sub_ss(_mm_load_ss(&q_.min[a]), _mm_load_ss(max + a));
        const __m128 gap = _mm_max_ss(_mm_max_ss(above, below), _mm_setzero_ps());
        sum += gap[0] * gap[0];
      }
      return sum;
    }
#endif
    for (; a < D; ++a) {
      const S above = static_cast<S>(min[a]) - static_cast<S>(q_.max[a]);
      const S below = static_cast<S>(q_.min[a]) - static_cast<S>(max[a]);
      const S outside = above > below ? above : below;
      const S gap = outside > 0 ? outside : S{0};
      sum += gap * gap;
    }
    return sum;
  }
  [[nodiscard]] S key(const Box<T, D>& box) const { return key(box.min.data(), box.max.data()); }
  [[nodiscard]] const Box<T, D>& query() const { return q_; }
  /// False if no box is ever reached: the query is empty or NaN.
  [[nodiscard]] bool reaches_any() const { return valid_; }
  /// What has a key of at most `worst` lies within this distance, with some room for what is rounded.
  static constexpr bool has_reach = true;
  [[nodiscard]] static S radius(S worst) {
    return std::sqrt(worst) * (1 + slack) + 2 * std::sqrt(std::numeric_limits<S>::min());
  }
  /// Every box within a radius reaches into [low, high].
  void reach(S radius, Point<S, D>& low, Point<S, D>& high) const {
    for (std::size_t a = 0; a < D; ++a) {
      const S least = static_cast<S>(q_.min[a]) - radius;
      const S greatest = static_cast<S>(q_.max[a]) + radius;
      low[a] = least - std::abs(least) * slack;
      high[a] = greatest + std::abs(greatest) * slack;
    }
  }
  /// On which side of a plane to look first.
  [[nodiscard]] bool is_higher(std::size_t axis, T plane) const { return q_.min[axis] > plane; }
  [[nodiscard]] static S distance(S key) { return std::sqrt(key); }

 private:
  static constexpr S slack = 8 * std::numeric_limits<S>::epsilon();
  Box<T, D> q_;
  bool valid_;
};

/// The t at which a path enters a box.
template <class T, std::size_t D>
class PathMetric {
 public:
  using S = DistanceOf<T>;
  static constexpr S never = std::numeric_limits<S>::quiet_NaN();
  template <class P, class L>
  PathMetric(const P& origin, const P& direction, L limit) : limit_(static_cast<S>(limit)) {
    for (std::size_t a = 0; a < D; ++a) {
      origin_[a] = static_cast<S>(origin[a]);
      direction_[a] = static_cast<S>(direction[a]);
      valid_ &= std::abs(origin_[a]) <= std::numeric_limits<S>::max() &&
                std::abs(direction_[a]) <= std::numeric_limits<S>::max();
    }
  }

  /// Division, unlike multiplication by an inverse, is monotone after rounding: what a box holds is never
  /// reached before the box is, and never missed when the box is hit.
  void keys(const Rows<T, D>& rows, std::size_t count, S* keys) const {
    S leave[mask_bits];
    for (std::size_t i = 0; i < count; ++i) {
      keys[i] = valid_ ? S{0} : never;
      leave[i] = limit_;
    }
    for (std::size_t a = 0; a < D; ++a) {
      const T* low = rows.low(a);
      const T* high = rows.high(a);
      const S o = origin_[a];
      const S d = direction_[a];
      if (d == 0) {
        for (std::size_t i = 0; i < count; ++i) {
          if (!(static_cast<S>(low[i]) <= o && o <= static_cast<S>(high[i]))) keys[i] = never;
        }
        continue;
      }
      const T* near = d > 0 ? low : high;
      const T* far = d > 0 ? high : low;
      for (std::size_t i = 0; i < count; ++i) {
        const S in = (static_cast<S>(near[i]) - o) / d;
        const S out = (static_cast<S>(far[i]) - o) / d;
        keys[i] = in > keys[i] ? in : keys[i];
        leave[i] = out < leave[i] ? out : leave[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) keys[i] = keys[i] <= leave[i] ? keys[i] : never;
  }
  [[nodiscard]] S key(const Box<T, D>& box) const { return key(box.min.data(), box.max.data()); }
  [[nodiscard]] S key(const T* min, const T* max) const {
    S enter = valid_ ? S{0} : never;
    S leave = limit_;
    for (std::size_t a = 0; a < D; ++a) {
      const S low = static_cast<S>(min[a]);
      const S high = static_cast<S>(max[a]);
      const S o = origin_[a];
      const S d = direction_[a];
      if (d == 0) {
        if (!(low <= o && o <= high)) return never;
        continue;
      }
      const S in = ((d > 0 ? low : high) - o) / d;
      const S out = ((d > 0 ? high : low) - o) / d;
      enter = in > enter ? in : enter;
      leave = out < leave ? out : leave;
    }
    return enter <= leave ? enter : never;
  }
  static constexpr bool has_reach = false;
  [[nodiscard]] static S distance(S key) { return key; }

 private:
  Point<S, D> origin_{};
  Point<S, D> direction_{};
  S limit_;
  bool valid_ = true;
};

template <class T, std::size_t D, class G>
  requires Geometry<G, T, D>
auto metric(const NearestPredicate<G>& p) {
  return BoxMetric<T, D>(to_box<T, D>(p.geometry));
}
template <class T, std::size_t D, class P, class L>
auto metric(const PathPredicate<P, L>& p) {
  return PathMetric<T, D>(p.origin, p.direction, p.limit);
}
template <class G>
std::size_t count_limit(const NearestPredicate<G>& p) {
  return p.count;
}
template <class P, class L>
std::size_t count_limit(const PathPredicate<P, L>&) {
  return static_cast<std::size_t>(-1);
}

}  // namespace spatial::detail

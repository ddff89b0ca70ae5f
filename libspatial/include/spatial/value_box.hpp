/// @file
/// How a tree reads the box of a value, and compares values, unless told otherwise. In: values. Out: boxes.
#pragma once
#include <cstddef>

#include "box.hpp"

namespace spatial {

/// Reads the box of a value: the value itself if it is a geometry, else its member `first` (as of a pair).
template <class T, std::size_t D>
struct DefaultBoxOf {
  template <class V>
    requires Geometry<V, T, D>
  constexpr Box<T, D> operator()(const V& value) const {
    return to_box<T, D>(value);
  }
  template <class V>
    requires(!Geometry<V, T, D>) && requires(const V& v) { to_box<T, D>(v.first); }
  constexpr Box<T, D> operator()(const V& value) const {
    return to_box<T, D>(value.first);
  }
};

/// Compares values with ==.
struct DefaultEqual {
  template <class V>
  constexpr bool operator()(const V& a, const V& b) const {
    return a == b;
  }
};

}  // namespace spatial

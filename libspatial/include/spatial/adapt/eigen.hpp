/// @file
/// Eigen's vectors as points and Eigen::AlignedBox as boxes. An empty AlignedBox is inverted, and so is not
/// accepted.
#pragma once
#include <Eigen/Geometry>

#include "../box.hpp"

namespace spatial {

template <class T, int D, int Options, int MaxRows, int MaxCols>
  requires(D > 0)
struct GeometryTraits<Eigen::Matrix<T, D, 1, Options, MaxRows, MaxCols>> {
  using Scalar = T;
  static constexpr std::size_t dimension = static_cast<std::size_t>(D);
  using G = Eigen::Matrix<T, D, 1, Options, MaxRows, MaxCols>;
  static T min(const G& point, std::size_t axis) { return point[static_cast<Eigen::Index>(axis)]; }
  static T max(const G& point, std::size_t axis) { return point[static_cast<Eigen::Index>(axis)]; }
};

template <class T, int D>
  requires(D > 0)
struct GeometryTraits<Eigen::AlignedBox<T, D>> {
  using Scalar = T;
  static constexpr std::size_t dimension = static_cast<std::size_t>(D);
  using G = Eigen::AlignedBox<T, D>;
  static T min(const G& box, std::size_t axis) { return box.min()[static_cast<Eigen::Index>(axis)]; }
  static T max(const G& box, std::size_t axis) { return box.max()[static_cast<Eigen::Index>(axis)]; }
};

}  // namespace spatial

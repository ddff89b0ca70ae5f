/// @file
/// A tension-free triangle laid into a plane: coordinates for what needs some (clusters of points, neighbours
/// that are unfolded). In: a metric, or a triangle that lies there already. Out: points of the plane.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "lattice/metric.hpp"

namespace cut::lattice {

struct PlanePoint {
  double x;
  double y;
  friend constexpr PlanePoint operator-(PlanePoint a, PlanePoint b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr PlanePoint operator+(PlanePoint a, PlanePoint b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr PlanePoint operator*(double s, PlanePoint a) { return {s * a.x, s * a.y}; }
};
constexpr double cross(PlanePoint a, PlanePoint b) { return a.x * b.y - a.y * b.x; }
constexpr double dot(PlanePoint a, PlanePoint b) { return a.x * b.x + a.y * b.y; }

/// Where the three corners lie.
using PlaneTriangle = std::array<PlanePoint, 3>;

/// Corner 0 at the origin, corner 1 on the x axis, corner 2 above it.
inline PlaneTriangle laid_out(const Metric& metric) {
  const Vector to_1 = lattice_corner(1) - lattice_corner(0);
  const Vector to_2 = lattice_corner(2) - lattice_corner(0);
  const double u = std::sqrt(metric.squared_length(to_1));
  const double x = metric.inner_product(to_1, to_2) / u;
  return {{{0, 0}, {u, 0}, {x, std::sqrt(std::max(metric.squared_length(to_2) - x * x, 0.0))}}};
}

inline PlanePoint in_plane(const PlaneTriangle& corners, LatticePoint p) {
  return corners[0] + static_cast<double>(p.x) / lattice_size * (corners[1] - corners[0]) +
         static_cast<double>(p.y) / lattice_size * (corners[2] - corners[0]);
}

}  // namespace cut::lattice

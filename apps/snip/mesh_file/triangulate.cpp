// Ear clipping; see the header.
#include "snip/mesh_file/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace snip {
namespace {

using Point = Eigen::Vector2d;

// Twice the area of the triangle, positive when counterclockwise.
double orient(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// How far a triangle is from a needle: its area over its longest side squared; not positive when turned over.
double shape(const Point& a, const Point& b, const Point& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? orient(a, b, c) / longest : 0;
}

// The polygon in the plane across Newell's normal, counterclockwise. Empty when it has no area at all.
std::vector<Point> project(std::span<const Eigen::Vector3d> polygon) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  const double length = normal.stableNorm();
  if (!(length > 0)) return {};
  normal /= length;
  const Eigen::Vector3d x_axis = normal.unitOrthogonal();
  const Eigen::Vector3d y_axis = normal.cross(x_axis);
  std::vector<Point> points;
  points.reserve(polygon.size());
  for (const Eigen::Vector3d& p : polygon)
    points.emplace_back((p - polygon[0]).dot(x_axis), (p - polygon[0]).dot(y_axis));
  return points;
}

// The corners not yet clipped, as a ring, and for each the shape of its ear, 0 where it has none.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Point> points) : points_(std::move(points)) {
    Point low = points_[0];
    Point high = points_[0];
    for (const Point& p : points_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    on_line_ = 1e-13 * (high - low).squaredNorm();
    const auto n = static_cast<std::uint32_t>(points_.size());
    previous_.resize(n);
    next_.resize(n);
    ear_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_[i] = i == 0 ? n - 1 : i - 1;
      next_[i] = i + 1 == n ? 0 : i + 1;
    }
  }

  void clip_all(std::vector<Triangle>& triangles) {
    std::size_t left = points_.size();
    std::uint32_t start = 0;
    rate_all(start);
    // A corner that blocks an ear may be clipped itself, which neighbours alone do not notice: rate all anew
    // when no ear is left. A simple polygon hardly needs it; one that goes on asking for it is not simple.
    int rounds_left = 16;
    while (left > 3) {
      std::uint32_t best = best_ear(start);
      if (!(ear_[best] > 0) && rounds_left-- > 0) {
        rate_all(start);
        best = best_ear(start);
      }
      if (!(ear_[best] > 0)) rounds_left = 0;
      const std::uint32_t a = previous_[best];
      const std::uint32_t c = next_[best];
      triangles.push_back({a, best, c});
      next_[a] = c;
      previous_[c] = a;
      start = a;
      --left;
      if (rounds_left > 0 || ear_[best] > 0) {
        ear_[a] = rate(a);
        ear_[c] = rate(c);
      }
    }
    triangles.push_back({previous_[start], start, next_[start]});
  }

 private:
  void rate_all(std::uint32_t start) {
    std::uint32_t i = start;
    do {
      ear_[i] = rate(i);
      i = next_[i];
    } while (i != start);
  }

  // The corner with the best ear; among equals the first behind `start`.
  [[nodiscard]] std::uint32_t best_ear(std::uint32_t start) const {
    std::uint32_t best = next_[start];
    for (std::uint32_t i = next_[best]; i != next_[start]; i = next_[i])
      if (ear_[i] > ear_[best]) best = i;
    return best;
  }

  // The shape of the triangle that would be clipped at b; 0 if it is no ear.
  [[nodiscard]] double rate(std::uint32_t b) const {
    const Point& pa = points_[previous_[b]];
    const Point& pb = points_[b];
    const Point& pc = points_[next_[b]];
    const double quality = shape(pa, pb, pc);
    if (!(quality > 0)) return 0;
    const Point low = pa.cwiseMin(pb).cwiseMin(pc);
    const Point high = pa.cwiseMax(pb).cwiseMax(pc);
    const double margin = 1e-12 * (high - low).maxCoeff();
    const auto in_cone_at_b = [&](const Point& p) { return orient(pa, pb, p) > 0 && orient(pb, pc, p) > 0; };
    for (std::uint32_t i = next_[next_[b]]; i != previous_[b]; i = next_[i]) {
      const Point& p = points_[i];
      if (p.x() < low.x() - margin || p.x() > high.x() + margin || p.y() < low.y() - margin ||
          p.y() > high.y() + margin)
        continue;
      if (p == pa || p == pc) continue;
      if (p == pb) {
        // The polygon touches itself at the tip: no ear if it comes out of the tip into the ear.
        if (in_cone_at_b(points_[previous_[i]]) || in_cone_at_b(points_[next_[i]])) return 0;
        continue;
      }
      // A corner on the diagonal, to within rounding, would be left behind in a flat rest.
      if (orient(pa, pb, p) >= 0 && orient(pb, pc, p) >= 0 && orient(pc, pa, p) >= -on_line_) return 0;
    }
    return quality;
  }

  std::vector<Point> points_;
  double on_line_ = 0;  // twice the area of a triangle that rounding leaves of a flat one
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<double> ear_;
};

void fan(std::size_t corners, std::vector<Triangle>& triangles) {
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
}

void split_quadrilateral(const std::vector<Point>& p, std::vector<Triangle>& triangles) {
  const double along_02 = std::min(shape(p[0], p[1], p[2]), shape(p[0], p[2], p[3]));
  const double along_13 = std::min(shape(p[0], p[1], p[3]), shape(p[1], p[2], p[3]));
  if (along_13 > along_02) {
    triangles.push_back({0, 1, 3});
    triangles.push_back({1, 2, 3});
  } else {
    fan(4, triangles);
  }
}

}  // namespace

void triangulate_polygon(std::span<const Eigen::Vector3d> polygon, std::vector<Triangle>& triangles) {
  if (polygon.size() <= 3) return fan(polygon.size(), triangles);
  std::vector<Point> points = project(polygon);
  if (points.empty()) return fan(polygon.size(), triangles);
  if (points.size() == 4) return split_quadrilateral(points, triangles);
  EarClipper(std::move(points)).clip_all(triangles);
}

}  // namespace snip

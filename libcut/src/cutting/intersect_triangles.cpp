#include "cutting/intersect_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lattice/orientation.hpp"
#include "lattice/sort_unique.hpp"
#include "mesh/area_vector.hpp"
#include "mesh/vector3.hpp"

namespace cut {
namespace {

using Vector3 = Eigen::Vector3d;
using lattice::operator-;

bool less(const Vector3& a, const Vector3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Unit vectors in the plane with this normal that point to the left of each edge.
std::array<Vector3, 3> inward_vectors(const std::array<Vector3, 3>& corners, const Vector3& normal) {
  std::array<Vector3, 3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 v = cross(normal, corners[next_corner(k)] - corners[k]);
    result[k] = v / length(v);
  }
  return result;
}

/// @return false when the triangle has no area to speak of
bool unit_normal(const std::array<Vector3, 3>& corners, Vector3& normal) {
  const Vector3 across = area_vector(corners[0], corners[1], corners[2]);
  const double area = length(across);
  if (!(area > 0)) return false;
  normal = across / area;
  return true;
}

/// Signed distances of p from the three edges are at least -slack.
bool within(const std::array<Vector3, 3>& corners, const std::array<Vector3, 3>& inward, const Vector3& p,
            double slack) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(dot(inward[k], p - corners[k]) >= -slack)) return false;
  return true;
}

/// Of three points above a plane; 0 within the slack.
std::array<double, 3> heights(const std::array<Vector3, 3>& points, const Vector3& normal,
                              const Vector3& origin, double slack) {
  std::array<double, 3> h;
  for (std::size_t k = 0; k < 3; ++k) {
    h[k] = dot(normal, points[k] - origin);
    if (std::abs(h[k]) <= slack) h[k] = 0;
  }
  return h;
}

/// Whether a triangle with these heights lies on one side of the plane, or in it: it cuts nothing there.
bool one_sided(const std::array<double, 3>& h) {
  return (h[0] > 0 && h[1] > 0 && h[2] > 0) || (h[0] < 0 && h[1] < 0 && h[2] < 0) ||
         (h[0] == 0 && h[1] == 0 && h[2] == 0);
}

std::int32_t to_lattice(double b) {
  if (!(b > 0)) return 0;
  return static_cast<std::int32_t>(std::floor(std::min(b, 1.0) * lattice_size + 0.5));
}

/// Barycentric coordinates of points of a triangle's plane. By areas: products of lengths cancel in a needle.
struct PlaneCoordinates {
  Vector3 origin, u, v, normal;
  double area;

  explicit PlaneCoordinates(const std::array<Vector3, 3>& c)
      : origin(c[0]), u(c[1] - c[0]), v(c[2] - c[0]), normal(cross(u, v)), area(squared_length(normal)) {}

  [[nodiscard]] LatticePoint operator()(const Vector3& p) const {
    const Vector3 w = p - origin;
    LatticePoint result{to_lattice(dot(cross(w, v), normal) / area),
                        to_lattice(dot(cross(u, w), normal) / area)};
    result.y = std::min(result.y, lattice_size - result.x);
    return result;
  }
};

/// Orders points along the line through the two that are furthest apart.
void sort_along_line(std::vector<LatticePoint>& points) {
  lattice::sort_unique(points);
  if (points.size() < 3) return;
  std::int64_t furthest = -1;
  LatticePoint from;
  LatticePoint to;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const lattice::Vector d = points[j] - points[i];
      if (dot(d, d) <= furthest) continue;
      furthest = dot(d, d);
      from = points[i];
      to = points[j];
    }
  const auto along = [&](LatticePoint p) { return lattice::dot(p - from, to - from); };
  std::stable_sort(points.begin(), points.end(),
                   [&](LatticePoint a, LatticePoint b) { return along(a) < along(b); });
}

}  // namespace

bool CutterFace::prepare(std::array<Vector3, 3> points) {
  std::sort(points.begin(), points.end(), less);
  corners = points;
  if (!unit_normal(corners, normal)) return false;
  inward = inward_vectors(corners, normal);
  return true;
}

bool CutterFace::contains(const Vector3& p, double slack) const { return within(corners, inward, p, slack); }

bool CutterFace::misses(const std::array<Vector3, 3>& triangle, double slack) const {
  return one_sided(heights(triangle, normal, corners[0], slack));
}

void intersect(const PhysicsFace& triangle, const CutterFace& cutter, double slack,
               std::vector<LatticePoint>& points) {
  points.clear();
  const std::array<double, 3> h = heights(triangle.corners, cutter.normal, cutter.corners[0], slack);
  if (one_sided(h)) return;
  PhysicsFace face = triangle;
  Vector3 normal;
  if (!unit_normal(face.corners, normal)) return;
  const std::array<double, 3> g = heights(cutter.corners, normal, face.corners[0], slack);
  if (one_sided(g)) return;

  for (std::size_t k = 0; k < 3; ++k)
    if (h[k] == 0 && cutter.contains(face.corners[k], slack)) points.push_back(lattice_corner(k));
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t from = k;
    std::size_t to = next_corner(k);
    if (triangle.reversed[k]) std::swap(from, to);
    if (!((h[from] < 0 && h[to] > 0) || (h[from] > 0 && h[to] < 0))) continue;
    const double t = h[from] / (h[from] - h[to]);
    if (!cutter.contains(face.corners[from] + (face.corners[to] - face.corners[from]) * t, slack)) continue;
    const std::int32_t units = to_lattice(t);
    points.push_back(lattice_point_on_edge(k, triangle.reversed[k] ? lattice_size - units : units));
  }

  const PlaneCoordinates coordinates(face.corners);
  const std::array<Vector3, 3> inward = inward_vectors(face.corners, normal);
  const auto add_when_inside = [&](const Vector3& p) {
    if (within(face.corners, inward, p, slack)) points.push_back(coordinates(p));
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (g[k] == 0) add_when_inside(cutter.corners[k]);
    std::size_t from = k;
    std::size_t to = next_corner(k);
    if (to < from)
      std::swap(from, to);  // corners are sorted: both cutter triangles at an edge use the same order
    if ((g[from] < 0 && g[to] > 0) || (g[from] > 0 && g[to] < 0))
      add_when_inside(cutter.corners[from] +
                      (cutter.corners[to] - cutter.corners[from]) * (g[from] / (g[from] - g[to])));
  }
  sort_along_line(points);
}

std::optional<Pierced> pierce(const PhysicsFace& triangle, const Vector3& a, const Vector3& b, double slack) {
  Vector3 normal;
  if (!unit_normal(triangle.corners, normal)) return std::nullopt;
  const bool turned = less(b, a);  // in the order in which `intersect` looks at the edge
  const Vector3& from = turned ? b : a;
  const Vector3& to = turned ? a : b;
  const std::array<double, 3> g = heights({from, to, to}, normal, triangle.corners[0], slack);
  if ((g[0] > 0 && g[1] > 0) || (g[0] < 0 && g[1] < 0) || (g[0] == 0 && g[1] == 0)) return std::nullopt;
  const double t = g[0] / (g[0] - g[1]);
  const Vector3 p = g[1] == 0 ? to : Vector3(from + (to - from) * t);
  if (!within(triangle.corners, inward_vectors(triangle.corners, normal), p, slack)) return std::nullopt;
  return Pierced{turned ? 1 - t : t, PlaneCoordinates(triangle.corners)(p)};
}

}  // namespace cut

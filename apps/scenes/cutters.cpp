// Cutting meshes, see cutters.hpp.
#include "scenes/cutters.hpp"

#include <cstdint>
#include <utility>

#include "scenes/circle.hpp"

namespace scenes {
namespace {

using cut::TriangleMesh;
using Eigen::Vector3d;

void add_quad(TriangleMesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  const auto i = [](std::size_t index) { return static_cast<std::uint32_t>(index); };
  mesh.triangles.push_back({i(a), i(b), i(c)});
  mesh.triangles.push_back({i(a), i(c), i(d)});
}

/// The rims of a ribbon: the points of path point k are 2k and 2k + 1.
TriangleMesh rims(const Path& path, const Vector3d& through) {
  TriangleMesh mesh;
  for (const Vector3d& p : path) {
    mesh.positions.push_back(p - through / 2);
    mesh.positions.push_back(p + through / 2);
  }
  return mesh;
}

void add_strip(TriangleMesh& mesh, std::size_t from, std::size_t to) {
  add_quad(mesh, 2 * from, 2 * to, 2 * to + 1, 2 * from + 1);
}

}  // namespace

TriangleMesh triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {{a, b, c}, {{0, 1, 2}}};
}

TriangleMesh quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh plane(const Vector3d& centre, const Vector3d& u, const Vector3d& v) {
  const Vector3d hu = u / 2, hv = v / 2;
  return quad(centre - hu - hv, centre + hu - hv, centre + hu + hv, centre - hu + hv);
}

TriangleMesh ribbon(const Path& path, const Vector3d& through) {
  TriangleMesh mesh = rims(path, through);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) add_strip(mesh, i, i + 1);
  return mesh;
}

TriangleMesh tube(const Path& path, const Vector3d& through) {
  TriangleMesh mesh = rims(path, through);
  for (std::size_t i = 0; i < path.size(); ++i) add_strip(mesh, i, (i + 1) % path.size());
  return mesh;
}

TriangleMesh e_shape(const Vector3d& foot, const Vector3d& up, const Vector3d& across,
                     const Vector3d& through) {
  const Vector3d middle = foot + up / 2, top = foot + up;
  TriangleMesh mesh = rims({foot, middle, top, foot + across, middle + across, top + across}, through);
  add_strip(mesh, 0, 1);
  add_strip(mesh, 1, 2);
  for (std::size_t arm = 0; arm < 3; ++arm) add_strip(mesh, arm, arm + 3);
  return mesh;
}

TriangleMesh swept(const Path& before, const Path& after) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < before.size(); ++i) {
    mesh.positions.push_back(before[i]);
    mesh.positions.push_back(after[i]);
    if (i > 0) add_strip(mesh, i - 1, i);
  }
  return mesh;
}

TriangleMesh star(const Vector3d& centre, const Vector3d& u, const Vector3d& v, const Vector3d& through,
                  std::size_t count) {
  std::vector<TriangleMesh> parts;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d turn = circle_point(static_cast<double>(i) / static_cast<double>(2 * count));
    const Vector3d arm = turn.x() * u + turn.y() * v;
    parts.push_back(ribbon({centre - arm, centre + arm}, through));
  }
  return joined(parts);
}

TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
  TriangleMesh mesh;
  for (const TriangleMesh& part : parts) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vector3d& offset) {
  for (Vector3d& p : mesh.positions) p += offset;
  return mesh;
}

Path circle_path(const Vector3d& centre, const Vector3d& u, const Vector3d& v, std::size_t count) {
  Path path;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d turn = circle_point(static_cast<double>(i) / static_cast<double>(count));
    path.push_back(centre + turn.x() * u + turn.y() * v);
  }
  return path;
}

Path wave_path(const Vector3d& from, const Vector3d& to, const Vector3d& swing, double waves,
               std::size_t segments) {
  Path path;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(segments);
    path.push_back(from + t * (to - from) + circle_point(waves * t).y() * swing);
  }
  return path;
}

}  // namespace scenes

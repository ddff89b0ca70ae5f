/// @file
/// Cutting meshes and the paths along which they run. Used by the app, tests and benchmarks.
/// Every function gives the same bits on every compiler and machine.
///
/// A ribbon is a path that is wide: `through` is the vector from one rim to the other, and the path runs in
/// the middle, so a path drawn on the cloth makes a ribbon that reaches through it by half of `through`.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cut/triangle_mesh.hpp>
#include <vector>

namespace scenes {

using Path = std::vector<Eigen::Vector3d>;

/// One triangle.
cut::TriangleMesh triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Two triangles with the corners a b c d in turn, split from a to c.
cut::TriangleMesh quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       const Eigen::Vector3d& d);

/// The parallelogram with the middle `centre` and the sides `u` and `v`: a plane, as far as it reaches.
cut::TriangleMesh plane(const Eigen::Vector3d& centre, const Eigen::Vector3d& u, const Eigen::Vector3d& v);

/// Two triangles per segment of the path. @pre at least two points
cut::TriangleMesh ribbon(const Path& path, const Eigen::Vector3d& through);

/// A ribbon along the closed path; the last point is joined to the first. Cuts a piece out.
/// @pre at least three points
cut::TriangleMesh tube(const Path& path, const Eigen::Vector3d& through);

/// The paper's E (§6, Figure 8): a spine of two quads and three arms of one, ten triangles. The spine runs
/// from `foot` to `foot + up`; an arm begins at each end and in the middle of it and runs along `across`.
cut::TriangleMesh e_shape(const Eigen::Vector3d& foot, const Eigen::Vector3d& up,
                          const Eigen::Vector3d& across, const Eigen::Vector3d& through);

/// What a blade sweeps in one step: two triangles for each segment of the blade, which moved from `before` to
/// `after`. A point of the blade that stood still leaves a triangle without area. @pre equally many points, ≥
/// 2
cut::TriangleMesh swept(const Path& before, const Path& after);

/// `count` ribbons that cross in `centre`, evenly turned in the plane of the perpendicular vectors u and v,
/// each as long as 2|u|.
cut::TriangleMesh star(const Eigen::Vector3d& centre, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                       const Eigen::Vector3d& through, std::size_t count);

/// All triangles of the parts, one part after the other, points not shared between parts.
cut::TriangleMesh joined(const std::vector<cut::TriangleMesh>& parts);

/// The mesh with `offset` added to each point.
cut::TriangleMesh moved(cut::TriangleMesh mesh, const Eigen::Vector3d& offset);

/// `count` points on the ellipse centre + u cos + v sin, from centre + u on; the end is not repeated.
Path circle_path(const Eigen::Vector3d& centre, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                 std::size_t count);

/// segments + 1 points from `from` to `to`, off the straight line by swing · sin of `waves` turns.
Path wave_path(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& swing,
               double waves, std::size_t segments);

}  // namespace scenes

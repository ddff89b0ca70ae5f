// Tells triangles from needles that rounding has left no plane (cut/triangle_mesh.hpp).
#include <algorithm>

#include "cut/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

namespace cut {

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double longest = std::max({squared_length(ab), squared_length(ac), squared_length(c - b)});
  return length(cross(ab, ac)) > 1e-14 * longest;
}

}  // namespace cut

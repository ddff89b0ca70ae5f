#include "mesh/area_vector.hpp"

#include <algorithm>

#include "cut/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

namespace cut {

Eigen::Vector3d area_vector(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  Eigen::Vector3d across = cross(ab, ac);
  const double longest = std::max({squared_length(ab), squared_length(ac), squared_length(c - b)});
  if (length(across) > 1e-14 * longest) return across;
  return Eigen::Vector3d::Zero();
}

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return squared_length(area_vector(a, b, c)) > 0;
}

}  // namespace cut

// Runs the cutter under test on a scene.
#include "oracle/scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "cut/cutter.hpp"
#include "cut/pieces.hpp"
#include "cut/validate.hpp"

namespace oracle {

std::vector<double> cut_pieces(const cut::TriangleMesh& cloth, const Calls& calls, double merge) {
  auto built = cut::HybridMesh::build(cloth);
  REQUIRE(built.has_value());
  cut::HybridMesh mesh = std::move(built.value());
  const double edge = 10 * cut::default_merge_distances(mesh).cut;
  const auto distances = cut::checked({merge * edge, merge * edge, merge * edge}, mesh);
  REQUIRE(distances.has_value());
  cut::Cutter cutter(*distances);
  for (const auto& cutters : calls) {
    REQUIRE(cutter.cut(mesh, scenes::joined(cutters)).has_value());
    std::string found;
    for (const cut::Violation& v : cut::validate(mesh, 5)) found += v.rule + ": " + v.message + "\n";
    CHECK(found == "");
  }
  std::vector<double> areas;
  for (const cut::Piece& p : cut::pieces(mesh).list) areas.push_back(p.rest_area);
  return areas;
}

Eigen::Vector3d shaken(const Eigen::Vector3d& point, double distance, scenes::Random& random) {
  return point + Eigen::Vector3d(random.between(-distance, distance), random.between(-distance, distance),
                                 random.between(-distance, distance));
}

bool same_pieces(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= tolerance)) return false;
  return true;
}

}  // namespace oracle

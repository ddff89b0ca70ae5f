// Curved surfaces: the cutter's pieces against CGAL's exact split with the same cutters.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <scenes/cloths.hpp>
#include <scenes/surfaces.hpp>

#include "oracle/cgal_oracle.hpp"
#include "oracle/scenes.hpp"

using namespace oracle;
using Eigen::Vector3d;
using scenes::Random;

namespace {

/// Two perpendicular unit vectors.
struct Axes {
  Vector3d u;
  Vector3d v;
};

Vector3d random_direction(Random& random) {
  for (;;) {
    const Vector3d d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    if (d.squaredNorm() > 0.1 && d.squaredNorm() < 1) return d.normalized();
  }
}

Axes random_axes(Random& random) {
  const Vector3d u = random_direction(random);
  return {u, u.cross(random_direction(random)).normalized()};
}

cut::TriangleMesh random_surface(Random& random) {
  switch (random.below(4)) {
    case 0:
      return scenes::sphere(1 + random.below(2));
    case 1:
      return scenes::torus(6 + random.below(8), 4 + random.below(5));
    case 2:
      return scenes::cylinder(5 + random.below(8), 1 + random.below(6));
    default:
      return scenes::moved(scenes::curved_sheet(3 + random.below(7), 2, 0.3), {-1, -1, 0});
  }
}

/// A cutter that does not meet itself.
cut::TriangleMesh random_cutter(Random& random) {
  const Axes axes = random_axes(random);
  const Vector3d centre = random_direction(random) * random.between(0, 1);
  const Vector3d w = axes.u.cross(axes.v);
  switch (random.below(4)) {
    case 0:
      return scenes::plane(centre, 8 * axes.u, 8 * axes.v);  // right through
    case 1:
      return scenes::plane(centre, random.between(0.3, 2) * axes.u, random.between(0.3, 2) * axes.v);
    case 2: {
      const double radius = random.between(0.1, 0.8);
      return scenes::tube(scenes::circle_path(centre, radius * axes.u, radius * axes.v, 3 + random.below(6)),
                          4 * w);
    }
    default:
      return scenes::ribbon(scenes::wave_path(centre - 1.5 * axes.u, centre + 1.5 * axes.u, 0.2 * axes.v,
                                              random.between(0.5, 2), 6),
                            random.between(0.5, 3) * w);
  }
}

}  // namespace

TEST_CASE("the exact oracle knows simple answers") {
  const cut::TriangleMesh cloth = scenes::grid(2, 2);
  const auto wall = [](double from, double to) {
    return scenes::quad({from, 0.5, -1}, {to, 0.5, -1}, {to, 0.5, 1}, {from, 0.5, 1});
  };
  CHECK(same_pieces(split_pieces(cloth, {}), {4}, 1e-12));
  CHECK(same_pieces(split_pieces(cloth, {wall(-1, 3)}), {3, 1}, 1e-12));
  CHECK(same_pieces(split_pieces(cloth, {wall(-1, 1.9)}), {4}, 1e-12));
  CHECK(same_pieces(split_pieces(cloth, {wall(-1, 1.2), wall(0.7, 3)}), {3, 1}, 1e-12));
}

TEST_CASE("random cutters through curved surfaces") {
  constexpr double merge = 1e-6;
  constexpr double tolerance = 1e-4;
  const char* wanted = std::getenv("SNIP_ORACLE_SCENES");
  const std::uint64_t count = wanted ? std::strtoull(wanted, nullptr, 10) : 300;
  std::uint64_t compared = 0;
  std::uint64_t divided = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    Random random(seed + 3'000'000);
    const cut::TriangleMesh cloth = random_surface(random);
    std::vector<cut::TriangleMesh> cutters;
    for (std::uint64_t i = 1 + random.below(3); i > 0; --i) cutters.push_back(random_cutter(random));
    const std::vector<double> pieces = split_pieces(cloth, cutters);
    // The number of pieces must not hang on a hair.
    std::vector<cut::TriangleMesh> moved = cutters;
    for (cut::TriangleMesh& m : moved)
      m = scenes::moved(
          m, {random.between(-1e-4, 1e-4), random.between(-1e-4, 1e-4), random.between(-1e-4, 1e-4)});
    if (split_pieces(cloth, moved).size() != pieces.size()) continue;
    ++compared;
    if (pieces.size() > 1) ++divided;
    Calls calls;
    const bool at_once = random.below(2) == 0;
    if (at_once) calls.push_back(cutters);
    for (std::size_t i = 0; !at_once && i < cutters.size(); ++i) calls.push_back({cutters[i]});
    const std::vector<double> ours = cut_pieces(cloth, calls, merge);
    CAPTURE(cloth.triangles.size());
    CAPTURE(cutters.size());
    CHECK(ours.size() == pieces.size());
    if (ours.size() == pieces.size()) CHECK(same_pieces(pieces, ours, tolerance));
  }
  MESSAGE(compared, " of ", count, " scenes compared, ", divided, " of them in several pieces");
  CHECK(compared > count * 9 / 10);
  CHECK(divided > count / 2);
}

// Corner weights: known values, and that a partition of the triangle adds up without any rounding.
#include "lattice/weights.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "lattice/triangulation.hpp"
#include "polygons.hpp"
#include "random_polygons.hpp"

using namespace cut;
using namespace cut::lattice;

namespace {

constexpr std::int32_t half = lattice_size / 2;
const std::vector<std::uint32_t> one_triangle = {3};

void add(Moments& sum, const Moments& part) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
}

Moments sum_over(const Polygon& p, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Moments sum{};
  for (const auto& t : triangles) add(sum, triangle_moments(p.points[t[0]], p.points[t[1]], p.points[t[2]]));
  return sum;
}

}  // namespace

TEST_CASE("the whole triangle weighs one at each corner") {
  const std::vector<LatticePoint> whole = {lattice_corner(0), lattice_corner(1), lattice_corner(2)};
  CHECK(polygon_moments(whole, one_triangle) == Moments{whole_moment, whole_moment, whole_moment});
  CHECK(corner_weights(whole, one_triangle) == std::array<double, 3>{1, 1, 1});
}

TEST_CASE("weights that are known") {
  // A quarter of the area around corner i, where the mean of N_i is 2/3 and that of the others 1/6.
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<LatticePoint> quarter = {lattice_corner(i), lattice_point_on_edge(i, half),
                                               lattice_point_on_edge(last_corner(i), half)};
    std::array<double, 3> expected = {0.125, 0.125, 0.125};
    expected[i] = 0.5;
    CHECK(corner_weights(quarter, one_triangle) == expected);
  }
  // Half of the triangle, cut along the median from corner 0.
  const std::vector<LatticePoint> median = {lattice_corner(0), lattice_corner(1),
                                            lattice_point_on_edge(1, half)};
  CHECK(corner_weights(median, one_triangle) == std::array<double, 3>{0.5, 0.75, 0.25});
}

TEST_CASE("a hole takes away what it covers") {
  Polygon p;
  p.add_loop({lattice_corner(0), lattice_corner(1), lattice_corner(2)});
  p.add_loop(
      {lattice_point_on_edge(0, half), lattice_point_on_edge(2, half), lattice_point_on_edge(1, half)});
  CHECK(corner_weights(p.points, p.loop_ends) == std::array<double, 3>{0.75, 0.75, 0.75});
}

TEST_CASE("the smallest triangle weighs something") {
  const std::vector<LatticePoint> speck = {{5, 5}, {6, 5}, {5, 6}};
  const auto weights = corner_weights(speck, one_triangle);
  CHECK(weights[0] > 0);
  CHECK(weights[1] == 16.0 / static_cast<double>(whole_moment));
  CHECK(weights[2] == 16.0 / static_cast<double>(whole_moment));
}

TEST_CASE("the weights of a partition of the triangle sum to one, exactly") {
  CHECK(rc::check([] {
    // Split a random triangle at a random lattice point, again and again. A point on a common edge would
    // leave a triangle flat: it is skipped.
    std::vector<std::array<LatticePoint, 3>> parts = {
        {lattice_corner(0), lattice_corner(1), lattice_corner(2)}};
    for (int n = *rc::gen::inRange(0, 60); n > 0; --n) {
      const auto [a, b, c] =
          parts[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(parts.size())))];
      const std::int64_t s = *rc::gen::inRange(0, 1001), t = *rc::gen::inRange(0, 1001 - static_cast<int>(s));
      const auto mix = [&](std::int32_t u, std::int32_t v, std::int32_t w) {
        return static_cast<std::int32_t>((s * u + t * v + (1000 - s - t) * w) / 1000);
      };
      const LatticePoint p = {mix(a.x, b.x, c.x), mix(a.y, b.y, c.y)};
      if (orientation(a, b, p) <= 0 || orientation(b, c, p) <= 0 || orientation(c, a, p) <= 0) continue;
      std::erase(parts, std::array{a, b, c});
      parts.push_back({a, b, p});
      parts.push_back({b, c, p});
      parts.push_back({c, a, p});
    }
    Moments sum{};
    for (const auto& [a, b, c] : parts) {
      const std::vector<LatticePoint> loop = {a, b, c};
      const Moments part = triangle_moments(a, b, c);
      RC_ASSERT(part == polygon_moments(loop, one_triangle));
      // N0 + N1 + N2 = 1.
      RC_ASSERT(part[0] + part[1] + part[2] == Moment{3 * std::int64_t{lattice_size}} * orientation(a, b, c));
      for (const double w : corner_weights(part)) RC_ASSERT(w >= 0 && w <= 1);
      add(sum, part);
    }
    RC_ASSERT(sum == (Moments{whole_moment, whole_moment, whole_moment}));
  }));
}

TEST_CASE("the loops of a polygon and its triangles have the same moments") {
  CHECK(rc::check([] {
    for (const Polygon& p : random_cell_polygons(AtPinch::stay)) {
      const Moments moments = polygon_moments(p.points, p.loop_ends);
      RC_ASSERT(moments == sum_over(p, triangulate(p.points, p.loop_ends, Metric({1.0, 1.0, 1.0}))));
    }
  }));
}

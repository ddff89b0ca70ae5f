// Lengths on the tension-free triangle, against the same triangle laid out in the plane.
#include "lattice/metric.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

using namespace cut;
using namespace cut::lattice;

namespace {

struct Place {
  double x, y;
};

/// The triangle in the plane: corner 0 at the origin, corner 1 on the x axis.
struct Layout {
  explicit Layout(std::array<double, 3> squared) {
    x1 = std::sqrt(squared[0]);
    x2 = (squared[0] + squared[2] - squared[1]) / (2 * x1);
    y2 = std::sqrt(squared[2] - x2 * x2);
  }
  [[nodiscard]] Place operator()(LatticePoint p) const {
    const double u = p.x / static_cast<double>(lattice_size), v = p.y / static_cast<double>(lattice_size);
    return {u * x1 + v * x2, v * y2};
  }
  double x1, x2, y2;
};

double distance(Place a, Place b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::array<double, 3> any_triangle() {
  const auto coordinate = [] { return *rc::gen::inRange(-100, 101) / 10.0; };
  const Place a = {coordinate(), coordinate()}, b = {coordinate(), coordinate()},
              c = {coordinate(), coordinate()};
  RC_PRE(std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) > 0.5);
  const auto squared = [](Place p, Place q) { return std::pow(p.x - q.x, 2) + std::pow(p.y - q.y, 2); };
  return {squared(a, b), squared(b, c), squared(c, a)};
}

LatticePoint any_point() {
  const std::int32_t x = *rc::gen::inRange(0, lattice_size + 1);
  return {x, *rc::gen::inRange(0, lattice_size - x + 1)};
}

}  // namespace

TEST_CASE("edges have their rest lengths, to the bit") {
  const Metric metric({0.37, 0.91, 0.53});
  const std::array<double, 3> squared = {0.37, 0.91, 0.53};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector edge = lattice_corner(next_corner(i)) - lattice_corner(i);
    CHECK(metric.squared_length(edge) == squared[i]);
    CHECK(metric.length(lattice_corner(i), lattice_corner(next_corner(i))) == std::sqrt(squared[i]));
  }
}

TEST_CASE("neighbours agree on lengths along their common edge, to the bit") {
  CHECK(rc::check([] {
    const double common = *rc::gen::inRange(1, 1000) / 7.0;
    const std::int32_t s = *rc::gen::inRange(0, lattice_size + 1), t = *rc::gen::inRange(0, lattice_size + 1);
    const double expected =
        Metric({common, 1.1, 2.2}).length(lattice_point_on_edge(0, s), lattice_point_on_edge(0, t));
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<double, 3> other = {3.3, 4.4, 5.5};
      other[i] = common;
      RC_ASSERT(Metric(other).length(lattice_point_on_edge(i, lattice_size - t),
                                     lattice_point_on_edge(i, lattice_size - s)) == expected);
    }
  }));
}

TEST_CASE("lengths and inner products are those of the plane") {
  CHECK(rc::check([] {
    const auto squared = any_triangle();
    const Metric metric(squared);
    const Layout place(squared);
    const LatticePoint a = any_point(), b = any_point(), c = any_point();
    RC_ASSERT(std::abs(metric.length(a, b) - distance(place(a), place(b))) < 1e-9);
    const Place pa = place(a), pb = place(b), pc = place(c);
    const double product = (pb.x - pa.x) * (pc.x - pa.x) + (pb.y - pa.y) * (pc.y - pa.y);
    RC_ASSERT(std::abs(metric.inner_product(b - a, c - a) - product) < 1e-9);
    RC_ASSERT(metric.inner_product(b - a, c - a) == metric.inner_product(c - a, b - a));
  }));
}

TEST_CASE("distance from a segment is the smallest distance from its points") {
  CHECK(rc::check([] {
    const auto squared = any_triangle();
    const Metric metric(squared);
    const Layout place(squared);
    const LatticePoint p = any_point(), a = any_point(), b = any_point();
    const SegmentDistance d = metric.distance_to_segment(p, a, b);
    RC_ASSERT(d.parameter >= 0 && d.parameter <= 1);
    const Place pa = place(a), pb = place(b), pp = place(p);
    const auto at = [&](double t) {
      return distance(pp, {pa.x + t * (pb.x - pa.x), pa.y + t * (pb.y - pa.y)});
    };
    RC_ASSERT(std::abs(std::sqrt(d.squared) - at(d.parameter)) < 1e-8);
    for (int i = 0; i <= 100; ++i) RC_ASSERT(at(d.parameter) < at(i / 100.0) + 1e-8);
  }));
}

TEST_CASE("distance from a segment at its ends and on it") {
  const Metric metric({1.0, 1.0, 1.0});
  const LatticePoint a = {1000, 1000}, b = {4000, 7000};
  CHECK(metric.distance_to_segment({2000, 3000}, a, b).squared == 0);
  CHECK(metric.distance_to_segment({2000, 3000}, a, b).parameter == doctest::Approx(1.0 / 3));
  CHECK(metric.distance_to_segment(a, a, b).parameter == 0);
  CHECK(metric.distance_to_segment(b, a, b).parameter == 1);
  CHECK(metric.distance_to_segment({0, 0}, a, b).squared == metric.squared_length(a - LatticePoint{0, 0}));
  // A segment without length is a point.
  CHECK(metric.distance_to_segment(b, a, a).squared == metric.squared_length(b - a));
  // One unit off the longest segment: the distance is not lost in rounding.
  const auto hair = metric.distance_to_segment({lattice_size / 2, 1}, lattice_corner(0), lattice_corner(1));
  CHECK(std::sqrt(hair.squared) == doctest::Approx(std::sqrt(0.75) / lattice_size).epsilon(1e-12));
}

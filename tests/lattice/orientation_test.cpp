// The exact predicates, against brute force on small vectors and against 128-bit integers at the extremes.
#include "lattice/orientation.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

using namespace cut;
using namespace cut::lattice;

namespace {

__extension__ typedef __int128 Wide;

/// All vectors but zero with coordinates in [-r, r].
std::vector<Vector> small_vectors(std::int64_t r) {
  std::vector<Vector> all;
  for (std::int64_t x = -r; x <= r; ++x)
    for (std::int64_t y = -r; y <= r; ++y)
      if (x != 0 || y != 0) all.push_back({x, y});
  return all;
}

/// The angle in [0, 2π). Different directions of small vectors differ by far more than its rounding error.
double angle(Vector v) {
  const std::int64_t divisor = std::gcd(v.x, v.y);
  const double a = std::atan2(static_cast<double>(v.y / divisor), static_cast<double>(v.x / divisor));
  return a < 0 ? a + 2 * std::numbers::pi : a;
}

/// Walks counterclockwise through all directions from `from` until it meets `to`; did it meet d before?
bool met_on_the_way(const std::vector<double>& directions, Vector from, Vector d, Vector to) {
  const auto place = [&](Vector v) {
    return static_cast<std::size_t>(std::find(directions.begin(), directions.end(), angle(v)) -
                                    directions.begin());
  };
  for (std::size_t i = (place(from) + 1) % directions.size(); i != place(to) && i != place(from);
       i = (i + 1) % directions.size())
    if (i == place(d)) return true;
  return false;
}

int sign(Wide v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

Wide wide_orientation(LatticePoint a, LatticePoint b, LatticePoint c) {
  return Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x);
}

/// Lattice points, often with large coordinates and often nearly collinear.
rc::Gen<LatticePoint> any_point() {
  return rc::gen::exec([] {
    const auto near = [](std::int32_t v) {
      return std::clamp(v + *rc::gen::inRange(-2, 3), 0, lattice_size);
    };
    LatticePoint p;
    if (*rc::gen::inRange(0, 2) == 0) {
      p.x = *rc::gen::inRange(0, lattice_size + 1);
      p.y = *rc::gen::inRange(0, lattice_size - p.x + 1);
    } else {
      const std::int32_t t = *rc::gen::element(0, lattice_size / 3, lattice_size / 2, lattice_size - 1);
      p = lattice_point_on_edge(static_cast<std::size_t>(*rc::gen::inRange(0, 3)), near(t));
      p = {near(p.x), near(p.y)};
    }
    return p;
  });
}

}  // namespace

TEST_CASE("orientation is twice the area, and positive counterclockwise") {
  CHECK(orientation({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(orientation({0, 0}, {0, 1}, {1, 0}) == -1);
  CHECK(orientation({0, 0}, {2, 3}, {4, 6}) == 0);
  constexpr std::int64_t n = lattice_size;
  CHECK(orientation(lattice_corner(0), lattice_corner(1), lattice_corner(2)) == n * n);
  // One unit beside the longest edge.
  CHECK(orientation({0, 0}, {lattice_size, 0}, {lattice_size - 1, 1}) == n);
  CHECK(orientation(lattice_corner(1), lattice_corner(2), {lattice_size / 2, lattice_size / 2 - 1}) == n);
  CHECK(orientation({0, 0}, {lattice_size, lattice_size - 1}, {lattice_size - 1, lattice_size - 2}) == -1);
}

TEST_CASE("orientation never overflows and does not depend on where it starts") {
  CHECK(rc::check([] {
    const auto a = *any_point(), b = *any_point(), c = *any_point();
    RC_ASSERT(Wide{orientation(a, b, c)} == wide_orientation(a, b, c));
    RC_ASSERT(orientation(a, b, c) == orientation(b, c, a));
    RC_ASSERT(orientation(a, b, c) == -orientation(b, a, c));
  }));
}

TEST_CASE("angle_less is the order of the angles in [0, 2π)") {
  const auto vectors = small_vectors(4);
  for (const Vector a : vectors)
    for (const Vector b : vectors)
      if (angle_less(a, b) != (angle(a) < angle(b))) FAIL_CHECK("differs from the order of the angles");
}

TEST_CASE("angle_less is a strict weak order") {
  const auto holds = [](Vector a, Vector b, Vector c) {
    const auto equivalent = [](Vector u, Vector v) { return !angle_less(u, v) && !angle_less(v, u); };
    return !angle_less(a, a) && !(angle_less(a, b) && angle_less(b, a)) &&
           (!(angle_less(a, b) && angle_less(b, c)) || angle_less(a, c)) &&
           (!(equivalent(a, b) && equivalent(b, c)) || equivalent(a, c));
  };
  const auto vectors = small_vectors(2);
  for (const Vector a : vectors)
    for (const Vector b : vectors)
      for (const Vector c : vectors)
        if (!holds(a, b, c)) FAIL_CHECK("no strict weak order");
  CHECK(rc::check("of long vectors that hardly differ", [&] {
    const auto o = *any_point(), a = *any_point(), b = *any_point(), c = *any_point();
    RC_PRE(a != o && b != o && c != o);
    RC_ASSERT(holds(a - o, b - o, c - o));
  }));
}

TEST_CASE("strictly_between agrees with walking around") {
  const auto vectors = small_vectors(2);
  std::vector<double> directions;
  for (const Vector v : vectors) directions.push_back(angle(v));
  std::sort(directions.begin(), directions.end());
  directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
  CHECK(directions.size() == 16);
  for (const Vector from : vectors)
    for (const Vector d : vectors)
      for (const Vector to : vectors)
        if (strictly_between(from, d, to) != met_on_the_way(directions, from, d, to))
          FAIL_CHECK("wrong for (", from.x, ", ", from.y, ") (", d.x, ", ", d.y, ") (", to.x, ", ", to.y,
                     ")");
}

TEST_CASE("strictly_between at the extremes of the lattice") {
  constexpr std::int64_t n = lattice_size;
  // Two directions that differ by about 2^-50.
  const Vector low = {n, n - 1}, high = {n - 1, n - 2};
  REQUIRE(cross(low, high) == -1);
  CHECK(strictly_between(high, low, {0, n}));
  CHECK_FALSE(strictly_between(low, high, {0, n}));
  CHECK(strictly_between(low, high, low));  // the whole turn
  CHECK_FALSE(strictly_between(low, low, low));
  CHECK(strictly_between({n, 0}, {-n, 0}, {n, 0}));
  CHECK(strictly_between({n, 0}, {-n, 1}, {-n, 0}));
  CHECK_FALSE(strictly_between({n, 0}, {-n, -1}, {-n, 0}));
  CHECK(rc::check("exactly one side of a wedge", [] {
    const auto o = *any_point(), a = *any_point(), b = *any_point(), p = *any_point();
    RC_PRE(a != o && b != o && p != o);
    const auto same = [](Vector u, Vector v) { return cross(u, v) == 0 && dot(u, v) > 0; };
    RC_PRE(!same(a - o, b - o));
    const int sides = strictly_between(a - o, p - o, b - o) + strictly_between(b - o, p - o, a - o);
    RC_ASSERT(sides == (same(p - o, a - o) || same(p - o, b - o) ? 0 : 1));
  }));
}

TEST_CASE("on_segment and cross_properly on all small segments") {
  std::vector<LatticePoint> grid;
  for (std::int32_t x = 0; x < 4; ++x)
    for (std::int32_t y = 0; y < 3; ++y) grid.push_back({x, y});
  for (const LatticePoint a : grid)
    for (const LatticePoint b : grid)
      for (const LatticePoint c : grid) {
        // p = a + t (b - a) for one of the t in [0, 1] at which a grid point can lie.
        bool on = false;
        for (int t = 0; t <= 6; ++t)
          on |= 6 * c.x == 6 * a.x + t * (b.x - a.x) && 6 * c.y == 6 * a.y + t * (b.y - a.y);
        if (on_segment(a, b, c) != on) FAIL_CHECK("on_segment");
        for (const LatticePoint d : grid) {
          // Solve a + s/k (b - a) = c + t/k (d - c) for s and t.
          const std::int64_t k = cross(b - a, d - c);
          const std::int64_t s = cross(c - a, d - c), t = cross(c - a, b - a);
          const auto open = [k](std::int64_t v) { return k > 0 ? v > 0 && v < k : v < 0 && v > k; };
          if (cross_properly(a, b, c, d) != (open(s) && open(t))) FAIL_CHECK("cross_properly");
        }
      }
}

TEST_CASE("cross_properly and on_segment do not depend on the direction of a segment") {
  CHECK(rc::check([] {
    const auto a = *any_point(), b = *any_point(), c = *any_point(), d = *any_point();
    const bool crossing = cross_properly(a, b, c, d);
    RC_ASSERT(crossing == cross_properly(b, a, c, d));
    RC_ASSERT(crossing == cross_properly(c, d, b, a));
    RC_ASSERT(crossing == (sign(wide_orientation(a, b, c)) * sign(wide_orientation(a, b, d)) < 0 &&
                           sign(wide_orientation(c, d, a)) * sign(wide_orientation(c, d, b)) < 0));
    RC_ASSERT(on_segment(a, b, c) == on_segment(b, a, c));
    RC_ASSERT(on_segment(a, b, a));
  }));
}

// Triangulation of weakly simple polygons: hand-made cases, then random ones, all properties checked exactly.
#include "lattice/triangulation.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <map>

#include "polygons.hpp"
#include "random_polygons.hpp"

using namespace cut;
using namespace cut::lattice;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const Metric equilateral({1.0, 1.0, 1.0});
const Metric right_angled({1.0, 2.0, 1.0});  // the plane of the lattice coordinates
const std::vector<LatticePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};

Triangles checked(const Polygon& p, std::size_t expected, bool by_corner = true,
                  const Metric& metric = equilateral) {
  Triangles triangles;
  TriangulationScratch scratch;
  CHECK(triangulate(p.points, p.loop_ends, metric, triangles, scratch));
  CHECK(fault(p, triangles, by_corner) == "");
  CHECK(triangles.size() == expected);
  return triangles;
}

std::size_t holes(const Polygon& p) { return p.loop_ends.size() - 1; }

/// A staircase spiral with 4 corners per turn and side.
Polygon spiral(std::int32_t turns) {
  std::vector<LatticePoint> inner, outer;
  for (std::int32_t k = 0; k < turns; ++k) {
    const std::int32_t r = 2 * k + 2;
    for (const LatticePoint p : {LatticePoint{r, -r}, {r, r}, {-r, r}, {-r, -r - 2}}) inner.push_back(p);
    for (const LatticePoint p :
         {LatticePoint{r + 1, -r - 1}, {r + 1, r + 1}, {-r - 1, r + 1}, {-r - 1, -r - 3}})
      outer.push_back(p);
  }
  std::vector<LatticePoint> loop = outer;
  loop.insert(loop.end(), inner.rbegin(), inner.rend());
  return polygon({loop}, 1000, {1 << 24, 1 << 24});
}

/// Long thin teeth that see each other only past their tips.
Polygon comb(std::int32_t teeth) {
  std::vector<LatticePoint> loop = {{0, 0}, {2 * teeth, 0}};
  for (std::int32_t k = teeth; k > 0; --k) {
    loop.push_back({2 * k, 1000});
    loop.push_back({2 * k - 1, 1});
  }
  loop.push_back({0, 1000});
  return polygon({loop}, 100);
}

/// Smallest angle of a triangle in the plane in which the edges of the physics triangle are 1, √l12, √l20
/// long.
double smallest_angle(LatticePoint a, LatticePoint b, LatticePoint c, double l12, double l20) {
  const double x2 = (1 + l20 - l12) / 2, y2 = std::sqrt(l20 - x2 * x2);
  const auto angle = [&](LatticePoint p, LatticePoint q, LatticePoint r) {
    const auto place = [&](Vector v) {
      const auto x = static_cast<double>(v.x), y = static_cast<double>(v.y);
      return std::pair{x + x2 * y, y2 * y};
    };
    const auto [ux, uy] = place(q - p);
    const auto [vx, vy] = place(r - p);
    return std::atan2(std::abs(ux * vy - uy * vx), ux * vx + uy * vy);
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

/// The largest gain that flipping one edge would still bring, in radians.
double largest_gain(const Polygon& p, const Triangles& triangles, double l12, double l20) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (p.next(t[k]) != t[(k + 1) % 3]) opposite[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  double gain = 0;
  for (const auto& [edge, apex] : opposite) {
    const auto twin = opposite.find({edge.second, edge.first});
    if (twin == opposite.end()) continue;
    const LatticePoint u = p.points[edge.first], v = p.points[edge.second];
    const LatticePoint w = p.points[apex], x = p.points[twin->second];
    if (orientation(w, u, x) <= 0 || orientation(x, v, w) <= 0) continue;
    const auto worse = [&](auto a, auto b, auto c, auto d, auto e, auto f) {
      return std::min(smallest_angle(a, b, c, l12, l20), smallest_angle(d, e, f, l12, l20));
    };
    gain = std::max(gain, worse(w, u, x, x, v, w) - worse(u, v, w, v, u, x));
  }
  return gain;
}

}  // namespace

TEST_CASE("convex and concave polygons") {
  checked(polygon({{{0, 0}, {1, 0}, {0, 1}}}), 1);
  checked(polygon({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}), 2);
  checked(polygon({{{0, 0}, {4, 0}, {1, 1}, {0, 4}}}), 2);
  checked(polygon({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}), 4);
  Polygon whole;
  whole.add_loop({lattice_corner(0), lattice_corner(1), lattice_corner(2)});
  checked(whole, 1);
}

TEST_CASE("corners on straight sides make no flat triangle and are not lost") {
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 1}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}}), 7);
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}}}), 3);
  // All but one corner on one line.
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {9, 0}, {0, 1}}}), 4);
  // The same, starting at a straight corner.
  checked(polygon({{{2, 0}, {3, 0}, {9, 0}, {0, 1}, {0, 0}, {1, 0}}}), 4);
}

TEST_CASE("the thinnest triangles that the lattice has") {
  Polygon along_edge, unit;
  along_edge.add_loop({{0, 0}, {lattice_size, 0}, {lattice_size - 1, 1}, {lattice_size - 2, 2}});
  checked(along_edge, 2);
  // Two triangles of the smallest area, 2^25 long.
  unit.add_loop({{0, 0}, {lattice_size - 1, 1}, {lattice_size - 2, 1}, {lattice_size - 3, 1}});
  REQUIRE(unit.doubled_area() == 2);
  checked(unit, 2);
}

TEST_CASE("holes") {
  checked(polygon({square, {{3, 3}, {3, 6}, {6, 6}, {6, 3}}}), 8);
  // The hull may come second.
  checked(polygon({{{3, 3}, {3, 6}, {6, 6}, {6, 3}}, square}), 8);
  // Holes that see only each other to the left, with corners at equal heights.
  checked(polygon({square,
                   {{1, 1}, {1, 8}, {2, 8}, {2, 1}},
                   {{3, 1}, {3, 8}, {4, 8}, {4, 1}},
                   {{5, 1}, {5, 8}, {6, 1}}}),
          4 + 4 + 4 + 3 + 6 - 2);
  // A hole beside an edge that leans over it: what it sees upwards on the left is below it.
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}}, {{5, 3}, {5, 4}, {6, 4}}}), 6);
  checked(polygon({{{0, 9}, {9, 0}, {9, 9}}, {{5, 6}, {5, 7}, {6, 7}}}), 6);
}

TEST_CASE("a hole that touches the hull opens it") {
  checked(polygon({square, {{0, 0}, {3, 6}, {6, 3}}}), 5, false);
  // As one loop, the hull touches itself.
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 6}, {6, 3}}}), 5);
}

TEST_CASE("a hole that touches the hull twice leaves two parts") {
  const std::vector<LatticePoint> hole = {{0, 0}, {3, 6}, {9, 9}, {6, 3}};
  checked(polygon({square, hole}), 8 - 2 * 2, false);
}

TEST_CASE("holes that touch each other are one hole") {
  checked(polygon({square, {{2, 2}, {2, 4}, {4, 4}}, {{4, 4}, {6, 6}, {6, 4}}}), 10 - 2 + 2, false);
  checked(polygon({square, {{2, 2}, {2, 4}, {4, 4}, {6, 6}, {6, 4}, {4, 4}}}), 10 - 2 + 2);
  // Three around one point, which is also where their joint hole is joined to the hull.
  checked(polygon({square, {{4, 4}, {2, 5}, {3, 7}}, {{4, 4}, {5, 7}, {7, 6}}, {{4, 4}, {6, 3}, {5, 2}}}),
          13 - 2 + 2, false);
}

TEST_CASE("a ring of holes that touch each other cuts the inside off") {
  const std::vector<LatticePoint> left = {{2, 2}, {4, 7}, {3, 4}}, right = {{4, 7}, {7, 2}, {4, 4}};
  const std::vector<LatticePoint> below = {{7, 2}, {5, 1}, {2, 2}, {5, 2}};
  // Outside: 4 + 4 corners and a hole. Inside: 6 corners.
  checked(polygon({square, left, right, below}), 8 + 4, false);
}

TEST_CASE("what a hole sees to its left") {
  // Two edges that start at one point; the hole has to find the nearer one, in whichever order they come.
  const std::vector<LatticePoint> wedge = {{0, 9}, {3, 2}, {1, 2}}, far = {{5, 4}, {5, 5}, {6, 5}};
  checked(polygon({square, wedge, far}), 10 + 2 - 2, false);
  checked(polygon({wedge, square, far}), 10 + 2 - 2, false);
  // A corner at the height of its smallest point, below which an edge hangs down.
  checked(polygon({square, {{1, 1}, {3, 5}, {3, 1}}, {{5, 5}, {5, 7}, {7, 5}}}), 10 + 4 - 2);
  // Two corners in line: the nearer one hides the other.
  checked(polygon({square, {{3, 6}, {4, 8}, {5, 7}}, {{6, 3}, {6, 4}, {7, 3}}}), 10 + 4 - 2);
  // A point where the hull touches itself has two corners, of which one is visible.
  checked(polygon({{{0, 0}, {3, 6}, {6, 3}, {0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{4, 1}, {5, 2}, {5, 1}}}),
          10 + 2 - 2);
  // A hole that touches itself at its smallest point has two corners there, of which one looks left.
  const std::vector<LatticePoint> up = {{2, 4}, {4, 8}, {5, 6}}, down = {{2, 4}, {5, 3}, {4, 1}};
  checked(polygon({square, up, down}), 10 + 2 - 2, false);
  checked(polygon({square, down, up}), 10 + 2 - 2, false);
}

TEST_CASE("what hides behind what, where angles alone do not tell") {
  const std::vector<LatticePoint> hull = {{0, 0}, {90, 0}, {90, 90}, {0, 90}};
  // Left of the last hole two edges start at (0, 90). The speck between them is not visible, though it would
  // be past the nearer edge.
  const std::vector<LatticePoint> wedge = {{0, 90}, {30, 20}, {10, 20}}, speck = {{2, 45}, {2, 48}, {4, 46}};
  checked(polygon({hull, wedge, speck, {{50, 40}, {50, 50}, {60, 50}}}), 13 + 4 - 2, false);
  // The same after another joint at (0, 90).
  checked(polygon({hull, wedge, speck, {{20, 80}, {22, 84}, {24, 80}}, {{50, 40}, {50, 50}, {60, 50}}}),
          16 + 6 - 2, false);
  // (30, 60) is in line with (0, 90) and hides it from (60, 30).
  checked(polygon({hull, {{20, 85}, {40, 80}, {30, 60}}, {{60, 30}, {60, 40}, {70, 30}}}), 10 + 4 - 2);
}

TEST_CASE("the joints between holes and hull do not show") {
  // Every joint starts as a long edge to the corner (0, 900).
  for (std::int32_t count = 1; count < 20; ++count)
    for (std::size_t start = 0; start < 4; ++start) {
      std::vector<std::vector<LatticePoint>> loops = {{{0, 0}, {200, 0}, {200, 900}, {0, 900}}};
      std::rotate(loops[0].begin(), loops[0].begin() + static_cast<std::ptrdiff_t>(start), loops[0].end());
      for (std::int32_t k = 0; k < count; ++k)
        loops.push_back({{30 + k, 20 + 40 * k}, {40 + k, 50 + 40 * k}, {60 + k, 40 + 40 * k}});
      const auto p = polygon(loops);
      const auto n = static_cast<std::size_t>(count);
      CHECK(largest_gain(p, checked(p, 4 + 3 * n + 2 * n - 2), 1, 1) < 1e-6);
    }
}

TEST_CASE("random holes that share the corner they are joined to") {
  CHECK(rc::check([] {
    std::vector<std::vector<LatticePoint>> loops = {{{0, 0}, {200, 0}, {200, 900}, {0, 900}}};
    for (std::int32_t k = 0; k < 20; ++k) {
      const auto x = [] { return *rc::gen::inRange(1, 199); };
      const LatticePoint a = {x(), 20 + 40 * k + *rc::gen::inRange(0, 10)};
      const LatticePoint b = {x(), 32 + 40 * k + *rc::gen::inRange(0, 10)}, c = {x(), 44 + 40 * k};
      const auto turn = orientation(a, b, c);
      if (turn < 0) loops.push_back({a, b, c});
      if (turn > 0) loops.push_back({a, c, b});
    }
    const Polygon p = polygon(loops);
    Triangles triangles;
    TriangulationScratch scratch;
    RC_ASSERT(triangulate(p.points, p.loop_ends, equilateral, triangles, scratch));
    RC_ASSERT(fault(p, triangles) == "");
    RC_ASSERT(largest_gain(p, triangles, 1, 1) < 1e-6);
  }));
}

TEST_CASE("slits: edges that occur once in each direction") {
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}, {5, 5}, {9, 9}, {0, 9}}}), 4);
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 4}, {6, 5}}}), 6);
  // From side to side, with a corner in the middle.
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 4}, {5, 6}, {7, 4}, {5, 6}}}), 8);
}

TEST_CASE("spirals and combs") {
  for (const std::int32_t n : {1, 2, 10, 60}) {
    const Polygon s = spiral(n), c = comb(n);
    checked(s, s.points.size() - 2);
    checked(c, c.points.size() - 2);
  }
}

TEST_CASE("ten thousand corners") {
  const auto check = [](const Polygon& p) {
    REQUIRE(p.points.size() >= 10000);
    CHECK(fault(p, triangulate(p.points, p.loop_ends, equilateral), true, false) == "");
  };
  check(spiral(1250));
  check(comb(5000));
  std::vector<std::vector<LatticePoint>> loops = {{{0, 0}, {300, 0}, {300, 300}, {0, 300}}};
  for (std::int32_t i = 0; i < 58; ++i)
    for (std::int32_t k = 0; k < 58; ++k)
      loops.push_back({{5 * i + 1, 5 * k + 1}, {5 * i + 2, 5 * k + 4}, {5 * i + 4, 5 * k + 2}});
  check(polygon(loops));
}

TEST_CASE("random unions of grid cells") {
  CHECK(rc::check("wedges disjoint", [] {
    for (const Polygon& p : random_cell_polygons(AtPinch::stay)) {
      Triangles triangles;
      TriangulationScratch scratch;
      RC_ASSERT(triangulate(p.points, p.loop_ends, equilateral, triangles, scratch));
      RC_ASSERT(fault(p, triangles) == "");
      RC_ASSERT(triangles.size() == p.points.size() + 2 * holes(p) - 2);
      RC_ASSERT(largest_gain(p, triangles, 1, 1) < 1e-6);
    }
  }));
  CHECK(rc::check("touching loops given as separate", [] {
    for (const Polygon& p : random_cell_polygons(AtPinch::cross)) {
      Triangles triangles;
      TriangulationScratch scratch;
      RC_ASSERT(triangulate(p.points, p.loop_ends, right_angled, triangles, scratch));
      RC_ASSERT(fault(p, triangles, false) == "");
    }
  }));
}

TEST_CASE("random stars; no flip is left that would help") {
  CHECK(rc::check([] {
    const Polygon p = random_star(40);
    const double l12 = *rc::gen::inRange(50, 200) / 100.0, l20 = *rc::gen::inRange(50, 200) / 100.0;
    Triangles triangles;
    TriangulationScratch scratch;
    RC_ASSERT(triangulate(p.points, p.loop_ends, Metric({1.0, l12, l20}), triangles, scratch));
    RC_ASSERT(fault(p, triangles) == "");
    RC_ASSERT(triangles.size() == p.points.size() - 2);
    RC_ASSERT(largest_gain(p, triangles, l12, l20) < 1e-6);
  }));
}

TEST_CASE("the metric decides which diagonal is taken") {
  // A lattice square is a rhombus on an equilateral triangle and a square on a right-angled one.
  const auto rhombus = polygon({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  const auto diagonal_at_0 = [&](const Metric& metric) {
    const auto triangles = checked(rhombus, 2, true, metric);
    return std::all_of(triangles.begin(), triangles.end(),
                       [](const auto& t) { return std::find(t.begin(), t.end(), 0u) != t.end(); });
  };
  CHECK_FALSE(diagonal_at_0(equilateral));
  CHECK(diagonal_at_0(Metric({1.0, 3.0, 1.0})));  // 120 degrees at corner 0
}

TEST_CASE("memory that is used again does not show in the result") {
  CHECK(rc::check([] {
    TriangulationScratch scratch;
    Triangles triangles;
    for (const Polygon& p : random_cell_polygons(AtPinch::stay)) {
      triangulate(p.points, p.loop_ends, equilateral, triangles, scratch);
      RC_ASSERT(triangles == triangulate(p.points, p.loop_ends, equilateral));
    }
  }));
}

TEST_CASE("the same triangles on every compiler") {
  std::uint64_t hash = 14695981039346656037u, state = 1;
  const auto random = [&](std::uint32_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::int32_t>((state >> 33) % below);
  };
  for (int round = 0; round < 50; ++round) {
    std::vector<LatticePoint> top, bottom;
    for (std::int32_t x = 0; x < 40; ++x) {
      bottom.push_back({1000 * x + random(900), random(100000)});
      top.push_back({1000 * x + random(900), 100000 + random(100000)});
    }
    bottom.insert(bottom.end(), top.rbegin(), top.rend());
    const auto p = polygon({bottom}, 100);
    const Metric metric({1.0, 0.1 * (5 + random(10)), 0.1 * (5 + random(10))});
    for (const auto& t : checked(p, p.points.size() - 2, true, metric))
      for (const std::uint32_t corner : t) hash = (hash ^ corner) * 1099511628211u;
  }
  CHECK(hash == 16730691750354029636u);
}

TEST_CASE("broken input ends, and no triangle is flat or turned over") {
  CHECK(triangulate({}, {}, equilateral).empty());
  const auto one_loop = [](const std::vector<LatticePoint>& loop) {
    Polygon p;
    p.add_loop(loop);
    Triangles triangles;
    TriangulationScratch scratch;
    CHECK_FALSE(triangulate(p.points, p.loop_ends, equilateral, triangles, scratch));
    return triangles.size();
  };
  CHECK(one_loop({{5, 5}}) == 0);
  CHECK(one_loop({{5, 5}, {9, 5}}) == 0);
  CHECK(one_loop({{5, 5}, {9, 5}, {7, 5}}) == 0);
  CHECK(one_loop({{5, 5}, {5, 9}, {9, 5}}) == 0);                    // clockwise
  CHECK(one_loop({{5, 5}, {9, 5}, {9, 5}, {5, 9}}) == 1);            // edge without length
  CHECK(one_loop({{0, 0}, {2147483647, 0}, {0, 2147483647}}) == 0);  // off the lattice
  CHECK(one_loop({{0, -2147483647 - 1}, {2147483647, 0}, {0, 9}}) == 0);
  // Loop ends that do not divide the points.
  const std::vector<LatticePoint> points = {{0, 0}, {9, 0}, {0, 9}};
  for (const std::vector<std::uint32_t>& ends :
       {std::vector<std::uint32_t>{}, {2}, {4}, {2, 1}, {4, 3}, {3, 2}})
    CHECK(triangulate(points, ends, equilateral).empty());

  CHECK(rc::check("random points in random loops", [] {
    const auto bits = *rc::gen::inRange(1, 25);
    const auto coordinate = rc::gen::inRange(0, 1 << bits);
    Polygon p;
    for (int loop = *rc::gen::inRange(1, 5); loop > 0; --loop) {
      std::vector<LatticePoint> corners;
      for (int n = *rc::gen::inRange(0, 15); n > 0; --n) corners.push_back({*coordinate, *coordinate});
      p.add_loop(corners);
    }
    const double length = *rc::gen::element(1.0, 0.0, -1.0, 1e300, std::nan(""), HUGE_VAL);
    for (const auto& t : triangulate(p.points, p.loop_ends, Metric({1.0, length, 1.0}))) {
      for (const std::uint32_t corner : t) RC_ASSERT(corner < p.points.size());
      RC_ASSERT(orientation(p.points[t[0]], p.points[t[1]], p.points[t[2]]) > 0);
    }
  }));
}

// Joining cutting lines: the same lines however a path is divided and in whatever order its parts come,
// nothing lost, and a bounded cost for the longest chains.
#include "cutting/join_collinear_lines.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "lattice/check_many.hpp"
#include "lattice/orientation.hpp"

namespace {

using cut::CuttingLine;
using cut::lattice_size;
using cut::LatticePoint;
using cut::LineEnd;
using cut::lattice::operator-;

using Points = std::vector<LatticePoint>;

std::vector<CuttingLine> lines_along(const Points& path, std::uint32_t polygon = 0) {
  std::vector<CuttingLine> lines;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) lines.push_back({polygon, {path[i]}, {path[i + 1]}});
  return lines;
}

std::vector<CuttingLine> joined(std::vector<CuttingLine> lines) {
  cut::join_collinear_lines(lines);
  return lines;
}

/// The lines in any order, each in either direction.
std::vector<CuttingLine> shuffled(std::vector<CuttingLine> lines) {
  for (std::size_t i = lines.size(); i > 1; --i)
    std::swap(lines[i - 1], lines[*rc::gen::inRange<std::size_t>(0, i)]);
  for (CuttingLine& l : lines)
    if (*rc::gen::arbitrary<bool>()) std::swap(l.a, l.b);
  return lines;
}

std::string name(const std::vector<CuttingLine>& lines) {
  std::string text;
  for (const CuttingLine& l : lines)
    text += " (" + std::to_string(l.a.point.x) + ", " + std::to_string(l.a.point.y) + ")-(" +
            std::to_string(l.b.point.x) + ", " + std::to_string(l.b.point.y) + ")";
  return text + "\n";
}

double distance(LatticePoint p, LatticePoint a, LatticePoint b) {
  const auto ab = b - a, ap = p - a;
  const double t = std::clamp(static_cast<double>(dot(ab, ap)) / static_cast<double>(dot(ab, ab)), 0.0, 1.0);
  return std::hypot(static_cast<double>(ap.x) - t * static_cast<double>(ab.x),
                    static_cast<double>(ap.y) - t * static_cast<double>(ab.y));
}

/// Up to 12 steps that are multiples of 12 lattice units, so that they can be divided exactly; the path does
/// not meet itself in a corner.
Points random_path() {
  const bool small = *rc::gen::arbitrary<bool>();
  const std::int32_t unit = small ? 12 : 12 * 4000;
  Points path{{lattice_size / 3, lattice_size / 3}};
  const int steps = *rc::gen::inRange(1, 13);
  for (int i = 0; i < steps; ++i) {
    LatticePoint p = path.back();
    p.x += unit * *rc::gen::inRange(-8, 9);
    p.y += unit * *rc::gen::inRange(-8, 9);
    if (!p.inside() || std::find(path.begin(), path.end(), p) != path.end()) continue;
    path.push_back(p);
  }
  return path;
}

/// The path with points put between its points, exactly in line.
Points divided(const Points& path) {
  Points result;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto step = path[i + 1] - path[i];
    for (int k = 0; k < 12; ++k)
      if (k == 0 || *rc::gen::inRange(0, 4) == 0)
        result.push_back({path[i].x + static_cast<std::int32_t>(step.x / 12 * k),
                          path[i].y + static_cast<std::int32_t>(step.y / 12 * k)});
  }
  result.push_back(path.back());
  return result;
}

/// No point twice: where a path meets itself, more than two lines meet, and nothing is joined there.
bool meets_itself(Points path) {
  std::sort(path.begin(), path.end());
  return std::adjacent_find(path.begin(), path.end()) != path.end();
}

/// What is wrong with the lines of a path that is given in parts, empty when nothing is.
std::string fault(const Points& path, const Points& parts) {
  const std::vector<CuttingLine> whole = joined(lines_along(path));
  const std::vector<CuttingLine> from_parts = joined(shuffled(lines_along(parts)));
  if (whole == from_parts) return {};
  return "path" + name(lines_along(path)) + "in parts" + name(lines_along(parts)) + "joined" + name(whole) +
         "parts joined" + name(from_parts);
}

TEST_CASE("a path gives the same lines however it is divided, and in any order") {
  check_many(5000, "open paths", [] {
    const Points path = random_path();
    const Points parts = divided(path);
    RC_PRE(path.size() > 1 && !meets_itself(parts));
    if (const std::string f = fault(path, parts); !f.empty()) RC_FAIL(f);
  });
}

TEST_CASE("a closed path gives the same lines however it is divided, and in any order") {
  check_many(5000, "closed paths", [] {
    Points path = random_path();
    RC_PRE(path.size() > 2);
    path.push_back(path.front());
    Points parts = divided(path);
    RC_PRE(!meets_itself({parts.begin() + 1, parts.end()}));
    if (const std::string f = fault(path, parts); !f.empty()) RC_FAIL(f);
  });
}

/// A walk to any neighbouring points in a block of 12 × 12 lattice points: lines meet, cross and turn back.
std::vector<CuttingLine> random_lines_in_block() {
  const LatticePoint block = *rc::gen::elementOf(
      Points{{lattice_size / 3, lattice_size / 3}, {0, 0}, {lattice_size - 11, 0}, {0, lattice_size / 2}});
  const auto draw = [&] {
    LatticePoint p{block.x + *rc::gen::inRange(0, 12), block.y + *rc::gen::inRange(0, 12)};
    p.y = std::min(p.y, lattice_size - p.x);
    return p;
  };
  std::vector<CuttingLine> lines;
  const int count = *rc::gen::inRange(0, 25);
  LatticePoint at = draw();
  for (int i = 0; i < count; ++i) {
    if (*rc::gen::inRange(0, 5) == 0) at = draw();
    const LatticePoint to = draw();
    lines.push_back({static_cast<std::uint32_t>(*rc::gen::inRange(0, 2)), {at}, {to}});
    if (at != to) at = to;
  }
  return lines;
}

TEST_CASE("any lines give the same in any order, and again when they are joined again") {
  check_many(5000, "order", [] {
    const std::vector<CuttingLine> lines = random_lines_in_block();
    const std::vector<CuttingLine> once = joined(lines);
    const std::vector<CuttingLine> other = joined(shuffled(lines));
    if (once != other)
      RC_FAIL("lines" + name(lines) + "joined" + name(once) + "in another order" + name(other));
  });
}

TEST_CASE(
    "no line is lost: each stays within two lattice units of one that comes out, which ends at given "
    "points") {
  check_many(5000, "coverage", [] {
    const std::vector<CuttingLine> lines = random_lines_in_block();
    const std::vector<CuttingLine> result = joined(lines);
    for (const CuttingLine& l : lines) {
      if (l.a.point == l.b.point) continue;
      const bool covered = std::any_of(result.begin(), result.end(), [&](const CuttingLine& r) {
        return r.polygon == l.polygon && distance(l.a.point, r.a.point, r.b.point) <= 2 &&
               distance(l.b.point, r.a.point, r.b.point) <= 2;
      });
      if (!covered) RC_FAIL("lines" + name(lines) + "joined" + name(result) + "lost" + name({l}));
    }
    for (const CuttingLine& r : result)
      for (const LineEnd& end : {r.a, r.b})
        RC_ASSERT(std::any_of(lines.begin(), lines.end(), [&](const CuttingLine& l) {
          return l.polygon == r.polygon && (l.a == end || l.b == end);
        }));
    RC_ASSERT(std::is_sorted(result.begin(), result.end()));
    RC_ASSERT(std::adjacent_find(result.begin(), result.end()) == result.end());
  });
}

const LatticePoint origin{1000, 1000};

std::size_t joined_count(const Points& path) { return joined(lines_along(path)).size(); }

TEST_CASE("points within two lattice units of the chord are left out, others are kept") {
  for (const std::int32_t off : {-3, -2, -1, 0, 1, 2, 3})
    CHECK(joined_count({origin, {1500, 1000 + off}, {2000, 1000}}) == (std::abs(off) <= 2 ? 1 : 2));
  CHECK(joined_count({origin, {2000, 1000}, {1500, 1000}}) == 2);  // turns back
}

TEST_CASE("only free points where two lines meet are left out") {
  const Points straight{origin, {1500, 1000}, {2000, 1000}};
  CHECK(joined_count(straight) == 1);
  CHECK(joined_count({{0, 500}, {0, 1000}, {0, 2000}}) == 2);  // on a side
  std::vector<CuttingLine> crossing = lines_along(straight);
  crossing.push_back({0, {{1500, 1000}}, {{1500, 1500}}});
  CHECK(joined(crossing).size() == 3);
  std::vector<CuttingLine> at_node = lines_along(straight);
  at_node[0].b.on = at_node[1].a.on = LineEnd::On::node;
  CHECK(joined(at_node).size() == 2);
  std::vector<CuttingLine> of_two_polygons = lines_along(straight);
  of_two_polygons[1].polygon = 1;
  CHECK(joined(of_two_polygons).size() == 2);
  std::vector<CuttingLine> twice = lines_along(straight);
  for (const CuttingLine& l : lines_along({straight.rbegin(), straight.rend()})) twice.push_back(l);
  CHECK(joined(twice).size() == 1);
}

TEST_CASE("chains of 100,000 lines come to an end") {
  constexpr std::int32_t count = 100000;
  const auto path = [](const auto& point) {
    Points result;
    for (std::int32_t i = 0; i <= count; ++i) result.push_back(point(i));
    return result;
  };
  CHECK(joined_count(path([](std::int32_t i) { return LatticePoint{1000 + 100 * i, 1000 + 50 * i}; })) == 1);
  CHECK(joined_count(path([](std::int32_t i) { return LatticePoint{1000 + 100 * i, 1000 + i % 2}; })) == 1);
  CHECK(joined_count(path([](std::int32_t i) { return LatticePoint{1000 + 100 * i, 1000 + i % 2 * 100}; })) ==
        count);
  // Longer and longer: the point furthest from the chord is always near an end.
  CHECK(joined_count(path([](std::int32_t i) {
          return LatticePoint{1000 + 10 * i, 2000000 + (i % 2 == 0 ? -10 : 10) * i};
        })) == count);
  // Back and forth, hardly higher each time.
  CHECK(joined_count(path(
            [](std::int32_t i) { return LatticePoint{1000 + i % 2 * 1000000, 1000 + 5 * i}; })) == count);
  // A square spiral.
  LatticePoint at{10000000, 10000000};
  CHECK(joined_count(path([&](std::int32_t i) {
          (i % 2 == 0 ? at.x : at.y) += (i % 4 < 2 ? 1 : -1) * 50 * i;
          return at;
        })) >= 1);
  // A saw with 100,000 edges, closed.
  Points saw = path([](std::int32_t i) { return LatticePoint{1000 + 100 * i, 1000 + i % 2 * 100}; });
  saw.push_back({10000000, 10000000});
  saw.push_back(saw.front());
  CHECK(joined_count(saw) == count + 2);
  // All from one point.
  std::vector<CuttingLine> star;
  for (std::int32_t i = 0; i < count; ++i) star.push_back({0, {origin}, {{2000 + i, 3000}}});
  CHECK(joined(star).size() == count);
}

}  // namespace

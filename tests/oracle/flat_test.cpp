// Flat sheets: the cutter's pieces against those of GEOS on the same lines, over thousands of random scenes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <scenes/cloths.hpp>
#include <sstream>

#include "oracle/flat_oracle.hpp"
#include "oracle/scenes.hpp"

using namespace oracle;
using Eigen::Vector3d;
using scenes::Random;

namespace {

struct Scene {
  cut::TriangleMesh sheet;
  std::vector<Stroke> strokes;
  std::size_t calls = 1;

  void add(Stroke stroke) {
    stroke.call = strokes.size() % calls;
    strokes.push_back(std::move(stroke));
  }
};

cut::TriangleMesh random_cloth(Random& random) {
  const std::size_t columns = 1 + random.below(5);
  const std::size_t rows = 1 + random.below(5);
  switch (random.below(5)) {
    case 0:
      return scenes::grid(columns, rows, 1, scenes::Diagonals::alternating);
    case 1:
      return scenes::hexagon(1 + random.below(2));
    case 2:
      return scenes::twelve_triangles();
    case 3:
      return scenes::fan(3 + random.below(7), 2);
    default:
      return scenes::random_sheet(columns, rows, 1, random.bits());
  }
}

/// The box round the sheet, a little enlarged.
struct Frame {
  Vector3d low;
  Vector3d size;
  explicit Frame(const cut::TriangleMesh& sheet) : low(sheet.positions[0]), size(low) {
    for (const Vector3d& p : sheet.positions) {
      low = low.cwiseMin(p);
      size = size.cwiseMax(p);
    }
    size -= low;
    low -= size / 8;
    size *= 1.25;
  }
  [[nodiscard]] Vector3d at(double x, double y) const {
    return low + Vector3d(x * size.x(), y * size.y(), 0);
  }
};

Stroke random_stroke(const Frame& frame, Random& random) {
  const auto anywhere = [&] { return frame.at(random.unit(), random.unit()); };
  switch (random.below(5)) {
    case 0:
      return {{anywhere(), anywhere()}};
    case 1:
      return {{frame.at(0, random.unit()), frame.at(1, random.unit())}};  // right through
    case 2: {
      const double width = random.between(0.05, 0.4);
      const double height = random.between(0.05, 0.4);
      return {scenes::circle_path(anywhere(), {width * frame.size.x(), 0, 0}, {0, height * frame.size.y(), 0},
                                  3 + random.below(8)),
              true};
    }
    case 3:
      return {scenes::wave_path(anywhere(), anywhere(), {0, 0.3, 0}, random.between(0.5, 3), 12)};
    default: {
      Stroke walk;
      for (std::uint64_t i = 2 + random.below(4); i > 0; --i) walk.points.push_back(anywhere());
      walk.closed = walk.points.size() > 2 && random.below(2) == 0;
      return walk;
    }
  }
}

Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene{random_cloth(random), {}, 1 + random.below(4)};
  const Frame frame(scene.sheet);
  for (std::uint64_t i = 1 + random.below(6); i > 0; --i) scene.add(random_stroke(frame, random));
  return scene;
}

/// Lines between corners, middles and quarters of cells: they meet nodes, edges and each other's ends
/// exactly.
Scene scene_on_grid_points(std::uint64_t seed) {
  Random random(seed + 1'000'000);
  const std::size_t columns = 1 + random.below(4);
  const std::size_t rows = 1 + random.below(4);
  const bool alternating = random.below(2) == 0;
  Scene scene{scenes::grid(columns, rows, 1,
                           alternating ? scenes::Diagonals::alternating : scenes::Diagonals::uniform),
              {},
              1 + random.below(3)};
  const double steps = random.below(2) == 0 ? 1 : (random.below(2) == 0 ? 2 : 4);
  const auto coordinate = [&](std::size_t cells) {
    const auto range = static_cast<std::uint64_t>(static_cast<double>(cells) * steps) + 3;
    return (static_cast<double>(random.below(range)) - 1) / steps;
  };
  for (std::uint64_t i = 1 + random.below(7); i > 0; --i) {
    const Vector3d from{coordinate(columns), coordinate(rows), 0};
    const Vector3d to{coordinate(columns), coordinate(rows), 0};
    if (from != to) scene.add({{from, to}});
  }
  return scene;
}

std::vector<Segment> segments_of(const std::vector<Stroke>& strokes) {
  std::vector<Segment> segments;
  for (const Stroke& s : strokes)
    for (std::size_t i = 0; i + (s.closed ? 0 : 1) < s.points.size(); ++i)
      segments.push_back({s.points[i].head<2>(), s.points[(i + 1) % s.points.size()].head<2>()});
  return segments;
}

std::vector<double> expected(const Scene& scene) {
  return flat_pieces(scene.sheet, segments_of(scene.strokes), 1e-9);
}

/// Both ends of an open stroke moved outwards, or inwards when `by` is negative.
void lengthen(Stroke& stroke, double by) {
  if (stroke.closed) return;
  const Vector3d start = (stroke.points[0] - stroke.points[1]).normalized();
  const Vector3d end = (stroke.points.back() - stroke.points[stroke.points.size() - 2]).normalized();
  stroke.points[0] += by * start;
  stroke.points.back() += by * end;
}

/// True when the number of pieces stays when the points of all strokes move a little, and when the strokes
/// become longer or shorter.
bool stable(const Scene& scene, std::size_t pieces, double distance, int trials, Random& random) {
  for (int i = 0; i < trials; ++i) {
    Scene moved = scene;
    for (Stroke& s : moved.strokes) {
      for (Vector3d& p : s.points) p = shaken(p, distance, random);
      if (i < 2) lengthen(s, i == 0 ? distance : -distance);
    }
    if (expected(moved).size() != pieces) return false;
  }
  return true;
}

std::vector<double> actual(const Scene& scene, double merge) {
  Calls calls(scene.calls);
  for (const Stroke& s : scene.strokes) {
    const Vector3d through{0.1, -0.05, 2};
    calls[s.call].push_back(s.closed ? scenes::tube(s.points, through) : scenes::ribbon(s.points, through));
  }
  return cut_pieces(scene.sheet, calls, merge);
}

std::string describe(const Scene& scene, double merge) {
  std::ostringstream text;
  text.precision(17);
  text << "areas by GEOS:";
  for (const double area : expected(scene)) text << ' ' << area;
  text << "\nby the cutter:";
  for (const double area : actual(scene, merge)) text << ' ' << area;
  text << '\n';
  text << scene.sheet.triangles.size() << " triangles, last node " << scene.sheet.positions.back().transpose()
       << ", " << scene.calls << " calls, strokes:";
  for (const Stroke& stroke : scene.strokes)
    for (const Segment& s : segments_of({stroke}))
      text << "\n  call " << stroke.call << ": " << s[0].x() << ' ' << s[0].y() << "  " << s[1].x() << ' '
           << s[1].y();
  return text.str();
}

bool agree(const Scene& scene, double merge, double tolerance) {
  return same_pieces(expected(scene), actual(scene, merge), tolerance);
}

/// Leaves out what the disagreement does not need: strokes, segments of them, calls.
Scene smallest(Scene scene, double merge, double tolerance) {
  const auto accept = [&](const Scene& less) {
    if (less.strokes.empty() || agree(less, merge, tolerance)) return false;
    scene = less;
    return true;
  };
  Scene split = scene;
  split.strokes.clear();
  for (const Stroke& s : scene.strokes)
    for (const Segment& part : segments_of({s}))
      split.strokes.push_back(
          {{{part[0].x(), part[0].y(), 0}, {part[1].x(), part[1].y(), 0}}, false, s.call});
  accept(split);
  for (std::size_t i = 0; i < scene.strokes.size();) {
    Scene less = scene;
    less.strokes.erase(less.strokes.begin() + static_cast<std::ptrdiff_t>(i));
    if (!accept(less)) ++i;
  }
  Scene at_once = scene;
  for (Stroke& s : at_once.strokes) s.call = 0;
  at_once.calls = 1;
  accept(at_once);
  return scene;
}

/// How many scenes; a long run sets SNIP_ORACLE_SCENES.
std::uint64_t scene_count(std::uint64_t normal) {
  const char* wanted = std::getenv("SNIP_ORACLE_SCENES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : normal;
}

}  // namespace

TEST_CASE("the flat oracle knows simple answers") {
  const cut::TriangleMesh sheet = scenes::grid(2, 2);
  const auto at = [](double x, double y) { return Eigen::Vector2d(x, y); };
  const auto check = [&](const std::vector<Segment>& segments, const std::vector<double>& areas) {
    CHECK(same_pieces(flat_pieces(sheet, segments, 1e-9), areas, 1e-8));
  };
  check({}, {4});
  check({{at(-1, 0.5), at(3, 0.5)}}, {3, 1});
  check({{at(-1, 0.5), at(1.9, 0.5)}}, {4});
  const std::vector<Segment> square{
      {at(0.5, 0.5), at(1, 0.5)}, {at(1, 0.5), at(1, 1)}, {at(1, 1), at(0.5, 1)}, {at(0.5, 1), at(0.5, 0.5)}};
  check(square, {3.75, 0.25});
}

TEST_CASE("random strokes on flat sheets") {
  constexpr double merge = 1e-6;
  constexpr double tolerance = 1e-4;
  std::uint64_t compared = 0;
  const std::uint64_t count = scene_count(4000);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    const Scene scene = random_scene(seed);
    const std::vector<double> pieces = expected(scene);
    Random random(seed ^ 0x5eed);
    if (!stable(scene, pieces.size(), 2e-5, 4, random)) continue;
    ++compared;
    if (same_pieces(pieces, actual(scene, merge), tolerance)) continue;
    const Scene small = smallest(scene, merge, tolerance);
    FAIL_CHECK("GEOS finds ", expected(small).size(), " pieces, the cutter ", actual(small, merge).size(),
               ": ", describe(small, merge));
  }
  MESSAGE(compared, " of ", count, " scenes compared");
  CHECK(compared > count * 9 / 10);
}

TEST_CASE("strokes through nodes and along edges") {
  constexpr double merge = 1e-6;
  constexpr double tolerance = 1e-4;
  const std::uint64_t count = scene_count(2000);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    const Scene scene = scene_on_grid_points(seed);
    if (scene.strokes.empty() || agree(scene, merge, tolerance)) continue;
    const Scene small = smallest(scene, merge, tolerance);
    FAIL_CHECK("GEOS finds ", expected(small).size(), " pieces, the cutter ", actual(small, merge).size(),
               ": ", describe(small, merge));
  }
}

TEST_CASE("strokes that stay clear of each other agree with the usual merge distances too") {
  constexpr double merge = 0.025;
  std::uint64_t compared = 0;
  const std::uint64_t count = scene_count(1000);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    Random random(seed + 2'000'000);
    Scene scene{random_cloth(random), {}, 1 + random.below(3)};
    const Frame frame(scene.sheet);
    for (std::uint64_t i = 1 + random.below(3); i > 0; --i) scene.add(random_stroke(frame, random));
    const std::vector<double> pieces = expected(scene);
    if (pieces.back() < 0.1 || !stable(scene, pieces.size(), 0.15, 16, random)) continue;
    ++compared;
    const std::vector<double> ours = actual(scene, merge);
    INFO(describe(scene, merge));
    // What merging leaves between a stroke and a physics edge beside it is far smaller than any piece here.
    CHECK(std::count_if(ours.begin(), ours.end(), [](double area) { return area > 0.05; }) ==
          static_cast<std::ptrdiff_t>(pieces.size()));
  }
  MESSAGE(compared, " of ", count, " scenes compared");
  CHECK(compared > count / 5);
}

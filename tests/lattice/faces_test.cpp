// Faces: they partition the triangle exactly, each point lies in one of them, and each half-edge knows the
// face on its left, for whatever graph snap rounding leaves: holes, loose slits, faces that touch themselves
// (§4.9).
#include "lattice/faces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

#include "check_many.hpp"
#include "drawings.hpp"
#include "lattice/intersection.hpp"
#include "lattice/orientation.hpp"

using namespace cut;
using namespace cut::lattice;

namespace {

struct Drawing {
  std::vector<LatticePoint> points;
  std::vector<FaceEdge> border;
  std::vector<FaceEdge> inner;

  /// The graph, without edges along the sides; the sides are divided at its nodes.
  explicit Drawing(const PlanarGraph& graph) : points(graph.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<std::uint32_t> on_side;
      for (std::uint32_t n = 0; n < points.size(); ++n)
        if (points[n][last_corner(i)] == 0) on_side.push_back(n);
      std::sort(on_side.begin(), on_side.end(), [&](std::uint32_t a, std::uint32_t b) {
        return points[a][next_corner(i)] < points[b][next_corner(i)];
      });
      for (std::size_t k = 0; k + 1 < on_side.size(); ++k) border.push_back({on_side[k], on_side[k + 1]});
    }
    for (const GraphEdge& e : graph.edges)
      if ((sides_of(points[e.from]) & sides_of(points[e.to])) == 0) inner.push_back({e.from, e.to});
  }
  [[nodiscard]] std::size_t half_edges() const { return 2 * (border.size() + inner.size()); }
  [[nodiscard]] FaceEdge half_edge(std::size_t h) const {
    const FaceEdge e = h / 2 < border.size() ? border[h / 2] : inner[h / 2 - border.size()];
    return h % 2 == 0 ? e : FaceEdge{e.to, e.from};
  }
};

/// A point in units of 1/4 of the lattice.
using Quarters = Vector;

Quarters quarters(LatticePoint p) { return {4 * std::int64_t{p.x}, 4 * std::int64_t{p.y}}; }

/// How often the loops of a face wind around a point that lies on none of them.
int winding(const Drawing& drawing, const Face& face, Quarters at) {
  int result = 0;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : face.loop_ends) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const Quarters a = quarters(drawing.points[face.corners[i]]);
      const Quarters b = quarters(drawing.points[face.corners[i + 1 == end ? begin : i + 1]]);
      if ((a.y > at.y) == (b.y > at.y)) continue;
      const std::int64_t side = cross({b.x - a.x, b.y - a.y}, {at.x - a.x, at.y - a.y});
      if (b.y > a.y && side > 0) ++result;
      if (b.y < a.y && side < 0) --result;
    }
    begin = end;
  }
  return result;
}

std::int64_t doubled_area(const Drawing& drawing, const Face& face, std::size_t begin, std::size_t end) {
  std::int64_t area = 0;
  for (std::size_t i = begin; i < end; ++i)
    area += orientation({}, drawing.points[face.corners[i]],
                        drawing.points[face.corners[i + 1 == end ? begin : i + 1]]);
  return area;
}

/// What is wrong with the faces, empty when nothing is. `samples` are points that must lie in one face each.
std::string fault(const Drawing& drawing, const Faces& faces, const std::vector<Quarters>& samples) {
  std::int64_t whole = 0;
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> contours;  // face, from, to
  for (std::uint32_t f = 0; f < faces.faces.size(); ++f) {
    const Face& face = faces.faces[f];
    std::uint32_t begin = 0;
    for (const std::uint32_t end : face.loop_ends) {
      const std::int64_t area = doubled_area(drawing, face, begin, end);
      if ((begin == 0) != (area > 0) || area == 0) return "a loop turns the wrong way";
      whole += area;
      for (std::uint32_t i = begin; i < end; ++i)
        if (!contours.emplace(f, face.corners[i], face.corners[i + 1 == end ? begin : i + 1]).second)
          return "a loop runs along an edge twice";
      begin = end;
    }
    if (begin != face.corners.size() || begin == 0) return "corners without a loop";
  }
  if (whole != std::int64_t{lattice_size} * lattice_size) return "the areas do not add up";

  if (faces.face_of_half_edge.size() != drawing.half_edges()) return "half-edges are missing";
  std::size_t on_contours = 0;
  for (std::size_t h = 0; h < drawing.half_edges(); ++h) {
    const std::uint32_t face = faces.face_of_half_edge[h];
    const std::uint32_t other = faces.face_of_half_edge[h ^ 1u];
    if (h % 2 == 1 && h / 2 < drawing.border.size()) {
      if (face != Faces::no_face) return "a face outside of the triangle";
      continue;
    }
    if (face >= faces.faces.size()) return "a half-edge without a face";
    const auto [from, to] = drawing.half_edge(h);
    if (face != other) {
      if (!contours.contains({face, from, to})) return "a contour that is not in the face's loops";
      ++on_contours;
    } else {
      const Quarters a = quarters(drawing.points[from]), b = quarters(drawing.points[to]);
      if (winding(drawing, faces.faces[face], {(a.x + b.x) / 2, (a.y + b.y) / 2}) != 1)
        return "an edge with one face on both sides that does not lie in it";
    }
  }
  if (on_contours != contours.size()) return "a loop along an edge that does not bound its face";

  for (const Quarters at : samples) {
    bool on_an_edge = false;
    for (std::size_t h = 0; h < drawing.half_edges(); h += 2) {
      const Quarters a = quarters(drawing.points[drawing.half_edge(h).from]);
      const Quarters b = quarters(drawing.points[drawing.half_edge(h).to]);
      on_an_edge = on_an_edge || cross({b.x - a.x, b.y - a.y}, {at.x - a.x, at.y - a.y}) == 0;
    }
    if (on_an_edge || at.x <= 0 || at.y <= 0 || at.x + at.y >= 4 * std::int64_t{lattice_size}) continue;
    int inside = 0;
    for (const Face& face : faces.faces) {
      const int times = winding(drawing, face, at);
      if (times < 0 || times > 1) return "a hole outside of its face, or a hull that overlaps itself";
      inside += times;
    }
    if (inside != 1) return "a point in " + std::to_string(inside) + " faces";
  }
  return {};
}

std::string fault(const Drawing& drawing, const std::vector<Quarters>& samples) {
  return fault(drawing, find_faces(drawing.points, drawing.border, drawing.inner), samples);
}

/// Number of corners of each loop, by face.
std::vector<std::vector<std::size_t>> shapes(const Faces& faces) {
  std::vector<std::vector<std::size_t>> result;
  for (const Face& face : faces.faces) {
    auto& loops = result.emplace_back();
    std::size_t begin = 0;
    for (const std::uint32_t end : face.loop_ends) {
      loops.push_back(end - begin);
      begin = end;
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The closed path over these points.
std::vector<Segment> ring(const std::vector<LatticePoint>& points) {
  std::vector<Segment> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.emplace_back(points[i], points[(i + 1) % points.size()]);
  return result;
}

std::vector<Segment> square(std::int32_t x, std::int32_t y, std::int32_t size) {
  return ring({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}});
}

/// Faces of the segments, checked.
Faces faces_of(const std::vector<Segment>& segments) {
  PlanarGraph graph = empty_graph();
  draw(graph, segments);
  const Drawing drawing(graph);
  Faces faces = find_faces(drawing.points, drawing.border, drawing.inner);
  CHECK(fault(drawing, faces, {{4040, 4044}, {4401, 4402}, {8001, 8003}}) == "");
  return faces;
}

using Shapes = std::vector<std::vector<std::size_t>>;

}  // namespace

TEST_CASE("faces partition the triangle, whatever is drawn into it") {
  check_many(20000, "faces", [] {
    PlanarGraph graph = empty_graph();
    const PointSource source = random_source();
    std::string log;
    const int steps = *rc::gen::inRange(1, 5);
    for (int step = 0; step < steps; ++step) {
      const std::vector<Segment> segments = random_segments(source, 10);
      for (const auto& [a, b] : segments)
        log += "(" + std::to_string(a.x) + ", " + std::to_string(a.y) + ")-(" + std::to_string(b.x) + ", " +
               std::to_string(b.y) + ")\n";
      draw(graph, segments);
    }
    std::vector<Quarters> samples;
    for (int i = 0; i < 30; ++i) {
      const Quarters corner = quarters(source.block);
      samples.push_back({corner.x + *rc::gen::inRange(0, 48), corner.y + *rc::gen::inRange(0, 48)});
    }
    if (const std::string f = fault(Drawing(graph), samples); !f.empty()) RC_FAIL(log + f);
  });
}

TEST_CASE("a triangle without cuts is one face") { CHECK(shapes(faces_of({})) == Shapes{{3}}); }

TEST_CASE("a slit shows in no face, whether it is loose or begins at a side") {
  CHECK(shapes(faces_of({{{1000, 1000}, {1100, 1200}}})) == Shapes{{3}});
  CHECK(shapes(faces_of({{{1000, 0}, {1100, 1200}}})) == Shapes{{4}});
}

TEST_CASE("rings in rings: a hull has holes, and a slit in each gap lies in that gap's face") {
  std::vector<Segment> segments = square(1000, 1000, 1000);
  for (const auto& more : {square(1100, 1100, 800), square(1200, 1200, 600)})
    segments.insert(segments.end(), more.begin(), more.end());
  CHECK(shapes(faces_of(segments)) == Shapes{{3, 4}, {4}, {4, 4}, {4, 4}});
  segments.push_back({{1050, 1200}, {1050, 1300}});
  segments.push_back({{1150, 1200}, {1150, 1300}});
  segments.push_back({{1250, 1300}, {1250, 1400}});
  CHECK(shapes(faces_of(segments)) == Shapes{{3, 4}, {4}, {4, 4}, {4, 4}});
}

TEST_CASE("two holes side by side, and one behind another seen from the left") {
  std::vector<Segment> segments = square(1000, 1000, 100);
  for (const auto& more : {square(1200, 1000, 100), square(1400, 1050, 10), square(1000, 1200, 100)})
    segments.insert(segments.end(), more.begin(), more.end());
  CHECK(shapes(faces_of(segments)) == Shapes{{3, 4, 4, 4, 4}, {4}, {4}, {4}, {4}});
}

TEST_CASE("a drop that touches a side in a point, and two that touch each other") {
  CHECK(shapes(faces_of(ring({{1000, 0}, {1100, 200}, {900, 200}}))) == Shapes{{3}, {7}});
  std::vector<Segment> eight = ring({{1000, 1000}, {1100, 1100}, {1000, 1200}});
  for (const Segment& s : ring({{1000, 1000}, {900, 1100}, {800, 900}})) eight.push_back(s);
  CHECK(shapes(faces_of(eight)) == Shapes{{3}, {3}, {3, 6}});
}

TEST_CASE("a ring that a slit joins to the side is no hole") {
  std::vector<Segment> segments = square(1000, 1000, 100);
  segments.push_back({{1000, 1000}, {500, 0}});
  CHECK(shapes(faces_of(segments)) == Shapes{{4}, {4, 4}});
}

TEST_CASE("faces come in the order of their first half-edge, along the border first") {
  PlanarGraph graph = empty_graph();
  draw(graph, {{{1000, 0}, {0, 1000}}, {{2000, 0}, {0, 2000}}});
  const Drawing drawing(graph);
  const Faces faces = find_faces(drawing.points, drawing.border, drawing.inner);
  REQUIRE(faces.faces.size() == 3);
  CHECK(faces.face_of_half_edge[0] == 0);
  CHECK(faces.face_of_half_edge[2] == 1);
  CHECK(faces.face_of_half_edge[4] == 2);
}

#include "cutting/clip_to_polygon.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lattice/intersection.hpp"
#include "lattice/orientation.hpp"

namespace cut {
namespace {

using lattice::operator-;

struct Crossing {
  double s;  ///< along ab
  LineEnd end;
};

/// Even-odd rule with the polygon's loops. A point on the contour may count as either.
bool contains(const Arrangement& arrangement, const RenderPolygon& polygon, double x, double y) {
  bool inside = false;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : polygon.loop_ends) {
    for (std::uint32_t i = begin, j = end - 1; i < end; j = i++) {
      const LatticePoint a = arrangement.nodes[polygon.corners[i].node].point;
      const LatticePoint b = arrangement.nodes[polygon.corners[j].node].point;
      if ((a.y > y) == (b.y > y)) continue;
      const double at = a.x + (y - a.y) * (static_cast<double>(b.x - a.x) / static_cast<double>(b.y - a.y));
      if (x < at) inside = !inside;
    }
    begin = end;
  }
  return inside;
}

}  // namespace

void clip_to_polygon(const Arrangement& arrangement, std::uint32_t polygon, LatticePoint a, LatticePoint b,
                     std::vector<CuttingLine>& lines) {
  std::vector<Crossing> crossings{{0, {a}}, {1, {b}}};
  for (std::uint32_t i = 0; i < arrangement.edges.size(); ++i) {
    const CutEdge& e = arrangement.edges[i];
    if ((e.left == polygon) == (e.right == polygon)) continue;
    const LatticePoint c = arrangement.nodes[e.from].point;
    const LatticePoint d = arrangement.nodes[e.to].point;
    const std::int64_t den = lattice::cross(b - a, d - c);
    const std::int64_t at_a = lattice::orientation(c, d, a);
    const std::int64_t at_b = lattice::orientation(c, d, b);
    const std::int64_t at_c = lattice::orientation(a, b, c);
    const std::int64_t at_d = lattice::orientation(a, b, d);
    if (den == 0 || (at_a > 0 && at_b > 0) || (at_a < 0 && at_b < 0) || (at_c > 0 && at_d > 0) ||
        (at_c < 0 && at_d < 0))
      continue;
    const double s = static_cast<double>(at_a) / (static_cast<double>(at_a) - static_cast<double>(at_b));
    LineEnd end;
    if (at_c == 0)
      end = {c, LineEnd::On::node, e.from};
    else if (at_d == 0)
      end = {d, LineEnd::On::node, e.to};
    else
      end = {lattice::crossing(a, b, c, d), LineEnd::On::cut_edge, i};
    if (end.point == c) end = {c, LineEnd::On::node, e.from};
    if (end.point == d) end = {d, LineEnd::On::node, e.to};
    crossings.push_back({s, end});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& l, const Crossing& r) { return std::tie(l.s, l.end) < std::tie(r.s, r.end); });

  // Pieces between crossings are inside or outside as a whole; neighbouring inside pieces are one line.
  const Crossing* start = nullptr;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    const double middle = (crossings[i].s + crossings[i + 1].s) / 2;
    const double x = a.x + middle * (b.x - a.x);
    const double y = a.y + middle * (b.y - a.y);
    const bool inside = crossings[i].s < crossings[i + 1].s
                            ? contains(arrangement, arrangement.polygons[polygon], x, y)
                            : start != nullptr;
    if (inside && start == nullptr) start = &crossings[i];
    if (start != nullptr && (!inside || i + 2 == crossings.size())) {
      const LineEnd& end = inside ? crossings[i + 1].end : crossings[i].end;
      if (start->end.point != end.point) lines.push_back({polygon, start->end, end});
      start = nullptr;
    }
  }
}

}  // namespace cut

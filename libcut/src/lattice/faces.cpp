#include "lattice/faces.hpp"

#include <algorithm>
#include <numeric>

#include "lattice/components.hpp"
#include "lattice/intersection.hpp"
#include "lattice/orientation.hpp"
#include "lattice/scratch.hpp"

namespace cut::lattice {
namespace {

using Index = std::uint32_t;
constexpr Index none = Faces::no_face;

struct HalfEdges {
  std::span<const LatticePoint> points;
  ScratchList<FaceEdge> edges;
  std::size_t border_count;
  ScratchList<Index> first_out;  ///< per node (+1)
  ScratchList<Index> out;        ///< half-edges that start at each node, counterclockwise

  [[nodiscard]] Index origin(Index h) const { return h % 2 == 0 ? edges[h / 2].from : edges[h / 2].to; }
  [[nodiscard]] Index target(Index h) const { return origin(h ^ 1u); }
  [[nodiscard]] bool outside(Index h) const { return h % 2 == 1 && h / 2 < border_count; }
  [[nodiscard]] Vector direction(Index h) const { return points[target(h)] - points[origin(h)]; }

  /// Where in the order around its target the way back along h stands.
  [[nodiscard]] Index position_of_return(Index h) const {
    const Index node = target(h);
    const Vector back = points[origin(h)] - points[node];
    const auto begin = out.begin() + first_out[node];
    const auto end = out.begin() + first_out[node + 1];
    const auto found =
        std::lower_bound(begin, end, back, [&](Index o, Vector d) { return angle_less(direction(o), d); });
    return static_cast<Index>(found - begin);
  }

  /// The next half-edge of the walk that keeps the face on its left: the first one clockwise from the way
  /// back.
  template <class Usable>
  [[nodiscard]] Index next(Index h, const Usable& usable) const {
    const Index node = target(h);
    const Index count = first_out[node + 1] - first_out[node];
    Index k = position_of_return(h);
    for (Index step = 0; step < count; ++step) {
      k = k == 0 ? count - 1 : k - 1;
      const Index candidate = out[first_out[node] + k];
      if (usable(candidate)) return candidate;
    }
    return none;
  }
};

HalfEdges sort_half_edges(std::span<const LatticePoint> points, std::span<const FaceEdge> border,
                          std::span<const FaceEdge> inner, Scratch& scratch) {
  HalfEdges g{points, ScratchList<FaceEdge>(&scratch), border.size(), ScratchList<Index>(&scratch),
              ScratchList<Index>(&scratch)};
  g.edges.reserve(border.size() + inner.size());
  g.edges.assign(border.begin(), border.end());
  g.edges.insert(g.edges.end(), inner.begin(), inner.end());
  const auto count = static_cast<Index>(2 * g.edges.size());
  g.first_out.assign(points.size() + 1, 0);
  for (Index h = 0; h < count; ++h) ++g.first_out[g.origin(h) + 1];
  std::partial_sum(g.first_out.begin(), g.first_out.end(), g.first_out.begin());
  g.out.resize(count);
  ScratchList<Index> fill(g.first_out.begin(), g.first_out.end() - 1, &scratch);
  for (Index h = 0; h < count; ++h) g.out[fill[g.origin(h)]++] = h;
  for (std::size_t n = 0; n < points.size(); ++n)
    std::sort(g.out.begin() + g.first_out[n], g.out.begin() + g.first_out[n + 1],
              [&](Index a, Index b) { return angle_less(g.direction(a), g.direction(b)); });
  return g;
}

/// Closed walks over the usable half-edges: the walk that each belongs to, and the first half-edge of each
/// walk.
struct Walks {
  ScratchList<Index> walk_of;
  ScratchList<Index> start;
  ScratchList<std::int64_t> area;  ///< doubled, signed
};

template <class Usable>
Walks walk_all(const HalfEdges& g, const Usable& usable, Scratch& scratch) {
  Walks walks{ScratchList<Index>(&scratch), ScratchList<Index>(&scratch),
              ScratchList<std::int64_t>(&scratch)};
  walks.walk_of.assign(2 * g.edges.size(), none);
  for (Index h = 0; h < walks.walk_of.size(); ++h) {
    if (walks.walk_of[h] != none || !usable(h)) continue;
    const auto walk = static_cast<Index>(walks.start.size());
    std::int64_t area = 0;
    for (Index k = h; k != none && walks.walk_of[k] == none; k = g.next(k, usable)) {
      walks.walk_of[k] = walk;
      const LatticePoint a = g.points[g.origin(k)];
      const LatticePoint b = g.points[g.target(k)];
      area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    }
    walks.start.push_back(h);
    walks.area.push_back(area);
  }
  return walks;
}

/// Component of each node: nodes joined by edges have the same.
ScratchList<Index> components(const HalfEdges& g, Scratch& scratch) {
  Components joined(g.points.size(), &scratch);
  for (const FaceEdge& e : g.edges) joined.join(e.from, e.to);
  ScratchList<Index> component(g.points.size(), &scratch);
  for (Index n = 0; n < component.size(); ++n) component[n] = joined.root(n);
  return component;
}

/// Where an upward edge (low to high) meets the horizontal line just above y: x as a fraction, then the
/// slope.
struct Hit {
  Wide x_numerator;
  std::int64_t dy;  ///< denominator, positive
  std::int64_t dx;
};

bool further_right(const Hit& a, const Hit& b) {
  const Wide left = a.x_numerator * b.dy;
  const Wide right = b.x_numerator * a.dy;
  if (left != right) return left > right;
  return Wide{a.dx} * b.dy > Wide{b.dx} * a.dy;
}

/// The half-edge that a ray from `node` to the left meets first, seen on the side that faces the node, among
/// the edges of other components (nearest-edge rule). The border guarantees that there is one.
Index nearest_on_the_left(const HalfEdges& g, const ScratchList<Index>& component, Index node) {
  const LatticePoint p = g.points[node];
  Index best = none;
  Hit best_hit{0, 1, 0};
  for (Index i = 0; i < g.edges.size(); ++i) {
    const FaceEdge e = g.edges[i];
    if (component[e.from] == component[node]) continue;
    const LatticePoint a = g.points[e.from];
    const LatticePoint b = g.points[e.to];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const bool upward = a.y < b.y;
    const LatticePoint low = upward ? a : b;
    const LatticePoint high = upward ? b : a;
    const Vector d = high - low;
    const Hit hit{Wide{low.x} * d.y + Wide{p.y - low.y} * d.x, d.y, d.x};
    if (hit.x_numerator > Wide{p.x} * d.y) continue;
    if (best != none && !further_right(hit, best_hit)) continue;
    best = 2 * i + (upward ? 1u : 0u);  // the half-edge that runs down has the node on its left
    best_hit = hit;
  }
  return best;
}

}  // namespace

Faces find_faces(std::span<const LatticePoint> points, std::span<const FaceEdge> border,
                 std::span<const FaceEdge> inner) {
  Scratch scratch;
  const HalfEdges g = sort_half_edges(points, border, inner, scratch);
  const auto is_inside = [&](Index h) { return !g.outside(h); };
  const Walks walks = walk_all(g, is_inside, scratch);

  // A walk with positive area is the outside of a hull; any other one is a hole, or a loose slit, in some
  // face.
  const ScratchList<Index> component = components(g, scratch);
  ScratchList<Index> leftmost(points.size(), none, &scratch);  // per component root
  for (Index n = 0; n < points.size(); ++n) {
    Index& best = leftmost[component[n]];
    if (best == none || points[n] < points[best]) best = n;
  }
  Faces result;
  result.faces.reserve(static_cast<std::size_t>(
      std::count_if(walks.area.begin(), walks.area.end(), [](std::int64_t area) { return area > 0; })));
  ScratchList<Index> face_of_walk(walks.start.size(), none, &scratch);
  for (Index w = 0; w < walks.start.size(); ++w)
    if (walks.area[w] > 0) {
      face_of_walk[w] = static_cast<Index>(result.faces.size());
      result.faces.emplace_back();
    }
  ScratchList<Index> pending(&scratch);
  for (Index w = 0; w < walks.start.size(); ++w) {
    pending.clear();
    Index at = w;
    while (face_of_walk[at] == none && pending.size() <= walks.start.size()) {
      pending.push_back(at);
      const Index left = nearest_on_the_left(g, component, leftmost[component[g.origin(walks.start[at])]]);
      if (left == none || walks.walk_of[left] == none) break;
      at = walks.walk_of[left];
    }
    for (const Index p : pending) face_of_walk[p] = face_of_walk[at];
  }
  result.face_of_half_edge.assign(2 * g.edges.size(), none);
  for (Index h = 0; h < result.face_of_half_edge.size(); ++h)
    if (walks.walk_of[h] != none) result.face_of_half_edge[h] = face_of_walk[walks.walk_of[h]];

  // The polygons: the same walks with internal edges left out.
  const auto is_contour = [&](Index h) {
    return !g.outside(h) && result.face_of_half_edge[h] != result.face_of_half_edge[h ^ 1u];
  };
  const Walks loops = walk_all(g, is_contour, scratch);
  ScratchList<Index> corners(&scratch);
  const auto append = [&](Index loop) {
    const Index start = loops.start[loop];
    Index h = start;
    corners.clear();
    do {
      corners.push_back(g.origin(h));
      h = g.next(h, is_contour);
    } while (h != start && h != none && corners.size() <= 2 * g.edges.size());  // it ends earlier when planar
    Face& face = result.faces[result.face_of_half_edge[start]];
    face.corners.insert(face.corners.end(), corners.begin(), corners.end());
    face.loop_ends.push_back(static_cast<Index>(face.corners.size()));
  };
  for (const bool hull : {true, false})
    for (Index loop = 0; loop < loops.start.size(); ++loop)
      if ((loops.area[loop] > 0) == hull && result.face_of_half_edge[loops.start[loop]] != none) append(loop);
  return result;
}

}  // namespace cut::lattice

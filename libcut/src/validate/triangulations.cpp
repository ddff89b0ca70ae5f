/// @file
/// Rule render_triangles_cover_polygons: positive areas that add up exactly, each side of the polygon once
/// and each other side once in each direction: then the triangles cover the polygon and do not overlap. In:
/// polygons and their render triangles. Out: violations.
#include <algorithm>
#include <utility>

#include "lattice/orientation.hpp"
#include "validate/area.hpp"
#include "validate/place.hpp"
#include "validate/rules.hpp"

namespace cut::validation {
namespace {

constexpr const char* rule = "render_triangles_cover_polygons";

using Side = std::pair<std::uint32_t, std::uint32_t>;

/// A corner of the polygon with the nodes before and after it.
struct Wedge {
  RenderVertexId vertex;
  std::uint32_t node;
  std::uint32_t before;
  std::uint32_t after;
};

class Checker {
 public:
  Checker(const HybridMesh& mesh, const Arrangement& a, const RenderPolygon& polygon, std::string what,
          Report& report)
      : mesh_(mesh), a_(a), polygon_(polygon), what_(std::move(what)), report_(report) {}

  void run() {
    for (const ArrangementNode& n : a_.nodes)
      if (!n.point.inside()) return;  // reported by nodes_in_place
    wedges();
    AreaSum area;
    for (const RenderTriangleId id : polygon_.triangles)
      if (!triangle(mesh_.buffers.render_triangles[id.index()], area))
        return fail("has a broken render triangle");
    if (area.value() != twice_area(a_, polygon_)) return fail("has another area than its render triangles");
    sides();
  }

 private:
  void fail(const char* how) { report_.add(rule, what_ + ' ' + how); }

  void wedges() {
    std::size_t begin = 0;
    for (const std::uint32_t end : polygon_.loop_ends) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t before = polygon_.corners[i == begin ? end - 1 : i - 1].node;
        const std::uint32_t after = polygon_.corners[i + 1 < end ? i + 1 : begin].node;
        wedges_.push_back({polygon_.corners[i].vertex, polygon_.corners[i].node, before, after});
        outline_.emplace_back(polygon_.corners[i].node, after);
      }
      begin = end;
    }
    std::sort(wedges_.begin(), wedges_.end(),
              [](const Wedge& a, const Wedge& b) { return a.vertex < b.vertex; });
  }

  /// Its corners are corners of the polygon, in whose angle it lies there, and its area is positive.
  bool triangle(const RenderTriangle& t, AreaSum& area) {
    if (t.triangle != polygon_.triangle) return false;
    std::array<std::uint32_t, 3> nodes{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto wedge = first_wedge(t.vertices[i]);
      if (wedge == wedges_.end() || wedge->vertex != t.vertices[i]) return false;
      nodes[i] = wedge->node;
    }
    if (lattice::orientation(point(nodes[0]), point(nodes[1]), point(nodes[2])) <= 0) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t next = nodes[next_corner(i)];
      const std::uint32_t last = nodes[last_corner(i)];
      bool fits = false;
      for (auto w = first_wedge(t.vertices[i]); w != wedges_.end() && w->vertex == t.vertices[i]; ++w)
        fits = fits || (w->node == nodes[i] && within(*w, next) && within(*w, last));
      if (!fits) return false;
      area.add(point(nodes[i]), point(next));
      sides_.emplace_back(nodes[i], next);
    }
    return true;
  }

  /// True when the direction from the wedge to `node` lies in the polygon's angle there.
  [[nodiscard]] bool within(const Wedge& w, std::uint32_t node) const {
    if (node == w.before || node == w.after) return true;
    if (point(node) == point(w.node) || point(w.before) == point(w.node) || point(w.after) == point(w.node))
      return false;
    using lattice::operator-;
    return lattice::strictly_between(point(w.after) - point(w.node), point(node) - point(w.node),
                                     point(w.before) - point(w.node));
  }

  /// Outline = sides of triangles less those that occur in both directions.
  void sides() {
    std::sort(sides_.begin(), sides_.end());
    std::sort(outline_.begin(), outline_.end());
    if (std::adjacent_find(sides_.begin(), sides_.end()) != sides_.end())
      return fail("has a side with two render triangles on one side of it");
    std::vector<Side> unpaired;
    for (const Side& s : sides_)
      if (!std::binary_search(sides_.begin(), sides_.end(), Side{s.second, s.first})) unpaired.push_back(s);
    // A side of the outline may run along another in the opposite direction only where the polygon has no
    // width, which polygon_simple excludes.
    if (unpaired != outline_) fail("is not bounded by the sides of its render triangles");
  }

  [[nodiscard]] std::vector<Wedge>::const_iterator first_wedge(RenderVertexId v) const {
    return std::lower_bound(wedges_.begin(), wedges_.end(), v,
                            [](const Wedge& w, RenderVertexId wanted) { return w.vertex < wanted; });
  }
  [[nodiscard]] LatticePoint point(std::uint32_t node) const { return a_.nodes[node].point; }

  const HybridMesh& mesh_;
  const Arrangement& a_;
  const RenderPolygon& polygon_;
  std::string what_;
  Report& report_;
  std::vector<Wedge> wedges_;  // by vertex
  std::vector<Side> outline_;
  std::vector<Side> sides_;
};

/// The one render triangle of an uncut ancestor goes from corner to corner.
bool covers_ancestor(const HybridMesh& mesh, AncestorId t, const RenderTriangle& triangle) {
  std::array<std::size_t, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Place place = place_of(mesh, triangle.vertices[i]);
    if (place.kind != Place::Kind::node) return false;
    const auto& nodes = mesh.ancestors.triangles[t.index()].nodes;
    while (corners[i] < 3 && nodes[corners[i]].value != place.index) ++corners[i];
    if (corners[i] == 3) return false;
  }
  return corners[1] == next_corner(corners[0]) && corners[2] == last_corner(corners[0]);
}

}  // namespace

void check_triangulations(const HybridMesh& mesh, Report& report) {
  const auto& triangles = mesh.buffers.render_triangles;
  std::vector<std::uint32_t> uses(triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size() && !report.full(); ++t) {
    const Arrangement* a = mesh.arrangement(AncestorId{t});
    for (std::size_t p = 0; a && p < a->polygons.size(); ++p) {
      Checker(mesh, *a, a->polygons[p], name("polygon", p) + " of ancestor " + std::to_string(t), report)
          .run();
      for (const RenderTriangleId id : a->polygons[p].triangles) ++uses[id.index()];
    }
  }
  // An uncut ancestor is drawn by the one render triangle that names it.
  std::vector<std::uint32_t> drawn(mesh.ancestors.triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size() && !report.full(); ++i) {
    const TriangleId physics = triangles[i].triangle;
    if (!physics.valid() && uses[i] == 0) continue;
    const bool uncut = physics.valid() && physics.index() < mesh.ancestors.triangles.size() &&
                       !mesh.arrangement(AncestorId{physics.index()});
    if (uses[i] != (uncut ? 0u : 1u))
      report.add(rule, name("render triangle", i) + " is part of " + std::to_string(uses[i]) + " polygons");
    if (!uncut) continue;
    ++drawn[physics.index()];
    if (!covers_ancestor(mesh, AncestorId{physics.index()}, triangles[i]))
      report.add(rule,
                 name("render triangle", i) + " does not cover ancestor " + std::to_string(physics.index()));
  }
  for (std::size_t t = 0; t < drawn.size(); ++t)
    if (drawn[t] != (mesh.arrangement(AncestorId{t}) ? 0u : 1u))
      report.add(rule, name("ancestor", t) + " has " + std::to_string(drawn[t]) + " render triangles");
}

}  // namespace cut::validation

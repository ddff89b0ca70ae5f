#include "simulation/tear_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vector3.hpp"

namespace cut {

using lattice::PlanePoint;

namespace {

/// Products of the two edges that leave corner 0: a quadratic form on plane vectors.
struct Form {
  double xx, xy, yy;

  Form(const Eigen::Vector3d& a, const Eigen::Vector3d& b) : xx(dot(a, a)), xy(dot(a, b)), yy(dot(b, b)) {}
  [[nodiscard]] double product(PlanePoint a, PlanePoint b) const {
    return xx * a.x * b.x + xy * (a.x * b.y + a.y * b.x) + yy * a.y * b.y;
  }
  [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
  /// A vector at right angles to v.
  [[nodiscard]] PlanePoint across(PlanePoint v) const {
    return {-(xy * v.x + yy * v.y), xx * v.x + xy * v.y};
  }
};

double component(PlanePoint p, std::size_t i) { return i == 0 ? -p.x - p.y : (i == 1 ? p.x : p.y); }

/// The direction of the least stretch, at right angles to that of the greatest: the smaller eigenvalue of the
/// deformed form with respect to the tension-free one. Zero when all directions are stretched alike.
PlanePoint least_stretched(const Form& rest, const Form& now) {
  const double a = rest.determinant();
  const double half_b = (now.xx * rest.yy + now.yy * rest.xx - 2 * now.xy * rest.xy) / 2;
  const double root = std::sqrt(std::max(half_b * half_b - a * now.determinant(), 0.0));
  const double least = (half_b - root) / a;
  const double xx = now.xx - least * rest.xx, xy = now.xy - least * rest.xy, yy = now.yy - least * rest.yy;
  if (!(root > 1e-9 * half_b)) return {};
  return xx > yy ? PlanePoint{-xy, xx} : PlanePoint{yy, -xy};
}

/// Whether a cut ends at boundary node k of side i on the other side of the edge, while this polygon goes on
/// along it uncut.
bool cut_ends_at(const HybridMesh& mesh, AncestorId t, std::size_t polygon, std::size_t i, std::uint32_t k) {
  const Arrangement& here = *mesh.arrangement(t);
  if (here.section_polygons[i][k - 1] != polygon || here.section_polygons[i][k] != polygon) return false;
  const auto meets = [](const Arrangement& arrangement, std::uint32_t node) {
    return std::any_of(arrangement.edges.begin(), arrangement.edges.end(),
                       [&](const CutEdge& e) { return e.from == node || e.to == node; });
  };
  if (meets(here, here.edge_node(i, k))) return false;
  const AncestorEdgeId edge = mesh.ancestors.triangles[t.index()].edges[i];
  const EdgeState* state = mesh.edge_state(edge);
  const AncestorId other = mesh.ancestors.neighbour(t, i);
  if (state == nullptr || !other.valid()) return false;
  const std::uint32_t count = here.boundary_counts[i];
  const std::uint32_t along = mesh.ancestors.reversed(t, i) ? count + 1 - k : k;  // as the edge counts
  if (state->cut[along - 1] != state->cut[along]) return true;
  if (state->cut[along] != 0) return false;
  const Arrangement* there = mesh.arrangement(other);
  const std::size_t j = mesh.ancestors.local_edge(other, edge);
  return there != nullptr &&
         meets(*there, there->edge_node(j, mesh.ancestors.reversed(other, j) ? count + 1 - along : along));
}

std::int32_t along_side(const Arrangement& arrangement, std::size_t i, std::uint32_t k) {
  return arrangement.nodes[arrangement.edge_node(i, k)].point[next_corner(i)];
}

PlanePoint plane_point(LatticePoint p) {
  return {static_cast<double>(p.x) / lattice_size, static_cast<double>(p.y) / lattice_size};
}

/// Hull and holes of a polygon, one edge after the other.
template <class Visit>
void for_each_side(const Arrangement* arrangement, std::size_t polygon, const Visit& visit) {
  if (arrangement == nullptr) {
    for (std::size_t i = 0; i < 3; ++i) visit(lattice_corner(i), lattice_corner(next_corner(i)));
    return;
  }
  const RenderPolygon& p = arrangement->polygons[polygon];
  std::size_t begin = 0;
  for (const std::uint32_t end : p.loop_ends) {
    for (std::size_t c = begin; c < end; ++c)
      visit(arrangement->nodes[p.corners[c].node].point,
            arrangement->nodes[p.corners[c + 1 == end ? begin : c + 1].node].point);
    begin = end;
  }
}

}  // namespace

std::optional<TearStart> tear_start(const HybridMesh& mesh, AncestorId t, std::size_t polygon,
                                    std::size_t side, bool fresh) {
  const Arrangement* arrangement = mesh.arrangement(t);
  if (arrangement == nullptr) return fresh ? std::optional(TearStart{side, lattice_size / 2}) : std::nullopt;
  for (const std::size_t i : {side, next_corner(side), last_corner(side)})
    for (std::uint32_t k = 1; k <= arrangement->boundary_counts[i]; ++k)
      if (cut_ends_at(mesh, t, polygon, i, k)) return TearStart{i, along_side(*arrangement, i, k)};
  if (!fresh) return std::nullopt;
  std::optional<TearStart> best;
  const auto off_middle = [](std::int32_t place) { return std::abs(place - lattice_size / 2); };
  for (std::uint32_t k = 0; k <= arrangement->boundary_counts[side]; ++k) {
    if (arrangement->section_polygons[side][k] != polygon) continue;
    const std::int32_t from = k == 0 ? 0 : along_side(*arrangement, side, k);
    const std::int32_t to =
        k == arrangement->boundary_counts[side] ? lattice_size : along_side(*arrangement, side, k + 1);
    const bool around = from < lattice_size / 2 && to > lattice_size / 2;
    const std::int32_t place = around ? lattice_size / 2 : from + (to - from) / 2;
    if (!best || off_middle(place) < off_middle(best->t)) best = TearStart{side, place};
  }
  return best;
}

std::optional<std::array<PlanePoint, 2>> tear_line(const HybridMesh& mesh, AncestorId t, std::size_t polygon,
                                                   TearStart start) {
  const auto& ancestor_nodes = mesh.ancestors.triangles[t.index()].nodes;
  const auto& nodes = mesh.buffers.triangles[mesh.fragment(t, polygon).index()].nodes;
  const auto rest_at = [&](std::size_t i) {
    return mesh.ancestors.rest_positions[ancestor_nodes[i].index()];
  };
  const auto now_at = [&](std::size_t i) { return mesh.positions[nodes[i].index()]; };
  const Form rest(rest_at(1) - rest_at(0), rest_at(2) - rest_at(0));
  const Form now(now_at(1) - now_at(0), now_at(2) - now_at(0));
  if (!(now.determinant() > 0)) return std::nullopt;

  const PlanePoint from = plane_point(lattice_corner(start.side));
  const PlanePoint to = plane_point(lattice_corner(next_corner(start.side)));
  const PlanePoint along = to - from;
  PlanePoint direction = least_stretched(rest, now);
  // A line along the side would not divide it: at less than 30 degrees it leads across the side instead.
  const double slope = rest.product(direction, along);
  if (!(slope * slope < 0.75 * rest.product(direction, direction) * rest.product(along, along)))
    direction = rest.across(along);
  const std::size_t opposite = last_corner(start.side);
  if (component(direction, opposite) < 0) direction = {-direction.x, -direction.y};

  const PlanePoint begin = plane_point(lattice_point_on_edge(start.side, start.t));
  double nearest = std::numeric_limits<double>::infinity();
  for_each_side(mesh.arrangement(t), polygon, [&](LatticePoint p, LatticePoint q) {
    if (p[opposite] == 0 && q[opposite] == 0) return;  // the side that the line starts at
    const PlanePoint a = plane_point(p), b = plane_point(q);
    const PlanePoint ab = b - a, to_a = a - begin;
    const double area = cross(direction, ab);
    if (area == 0) return;
    const double way = cross(to_a, ab) / area;
    const double place = cross(to_a, direction) / area;
    if (way > 0 && place > -1e-9 && place < 1 + 1e-9) nearest = std::min(nearest, way);
  });
  if (!std::isfinite(nearest)) return std::nullopt;
  return std::array{begin, begin + nearest * direction};
}

}  // namespace cut

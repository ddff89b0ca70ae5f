#include "cutting/cut_along_segments.hpp"

#include <algorithm>

#include "cutting/work_graph.hpp"
#include "lattice/components.hpp"
#include "lattice/orientation.hpp"

namespace cut {
namespace {

using lattice::GraphEdge;
using lattice::operator-;
using Index = std::uint32_t;
constexpr Index none = HybridMesh::none;

/// An edge of the mesh as it was before this cut, leaving a node, and the polygon on its left.
struct OldRay {
  lattice::Vector direction;
  Index polygon;
};

/// The old edges around each node.
std::vector<std::vector<OldRay>> old_rays(const TriangleWork& work) {
  const auto& points = work.graph.points;
  std::vector<std::vector<OldRay>> rays(points.size());
  for (const GraphEdge& e : work.graph.edges) {
    if (e.is_new) continue;
    rays[e.from].push_back({points[e.to] - points[e.from], e.left});
    rays[e.to].push_back({points[e.from] - points[e.to], e.right});
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (Index k = 0; k <= work.boundary_counts[i]; ++k) {
      const Index node = side_node(work, i, k);
      rays[node].push_back(
          {points[side_node(work, i, k + 1)] - points[node], work.old_section_polygons[i][k]});
    }
  return rays;
}

/// The polygon into which `direction` leads from a node with these old edges: that on the left of the nearest
/// one clockwise.
Index polygon_in_direction(const std::vector<OldRay>& rays, lattice::Vector direction) {
  const OldRay* best = &rays.front();
  for (const OldRay& ray : rays)
    if (&ray != best && lattice::strictly_between(best->direction, ray.direction, direction)) best = &ray;
  return best->polygon;
}

void discard_outside(TriangleWork& work) {
  auto& edges = work.graph.edges;
  const auto& points = work.graph.points;
  const auto rays = old_rays(work);
  // New edges that meet in a node without old edges lie in the same polygon: it is known if any of them
  // reaches an old edge.
  lattice::Components groups(points.size());
  for (const GraphEdge& e : edges)
    if (e.is_new && rays[e.from].empty() && rays[e.to].empty()) groups.join(e.from, e.to);
  std::vector<Index> polygon_of_group(points.size(), none);
  for (const GraphEdge& e : edges) {
    if (!e.is_new || rays[e.from].empty() == rays[e.to].empty()) continue;
    const Index old = rays[e.from].empty() ? e.to : e.from;
    const Index free = rays[e.from].empty() ? e.from : e.to;
    polygon_of_group[groups.root(free)] = polygon_in_direction(rays[old], points[free] - points[old]);
  }
  const auto outside = [&](const GraphEdge& e) {
    if (!e.is_new) return false;
    Index polygon = none;
    if (!rays[e.from].empty())
      polygon = polygon_in_direction(rays[e.from], points[e.to] - points[e.from]);
    else if (!rays[e.to].empty())
      polygon = polygon_in_direction(rays[e.to], points[e.from] - points[e.to]);
    else
      polygon = polygon_of_group[groups.root(e.from)];
    return polygon != none && polygon != e.left;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), outside), edges.end());
}

}  // namespace

void cut_sections_between(TriangleWork& work, std::size_t i, LatticePoint a, LatticePoint b,
                          std::uint32_t polygon) {
  for_sections_between(work, i, a, b, [&](Index k) {
    if (work.old_section_polygons[i][k] == polygon) work.cut_sections[i][k] = 1;
  });
}

void cut_along_segments(TriangleWork& work) {
  auto& edges = work.graph.edges;
  const auto along_side = [&](const GraphEdge& e) {
    const LatticePoint a = work.graph.points[e.from];
    const LatticePoint b = work.graph.points[e.to];
    const std::size_t i = common_side(a, b);
    if (i == 3) return false;
    if (e.is_new) {
      cut_sections_between(work, i, a, b, e.left);
      return true;
    }
    // Rounding has laid an old cut onto the side: the polygon between the two has vanished, the one behind
    // takes its place.
    const bool counterclockwise = a[next_corner(i)] < b[next_corner(i)];
    for_sections_between(work, i, a, b, [&](Index k) {
      work.old_section_polygons[i][k] = counterclockwise ? e.left : e.right;
      work.cut_sections[i][k] = 1;
    });
    return true;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), along_side), edges.end());
  if (work.before.polygons.size() > 1) discard_outside(work);
}

}  // namespace cut

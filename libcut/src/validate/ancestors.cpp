/// @file
/// Rule ancestors_consistent: triangles, edges and incidences of the uncut mesh tell the same story, in the
/// orders that `Ancestor` and `AncestorEdge` promise. In: the ancestor mesh. Out: violations.
#include <Eigen/Geometry>
#include <tuple>

#include "validate/rules.hpp"

namespace cut::validation {
namespace {

constexpr const char* rule = "ancestors_consistent";

bool before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

bool has_side(const AncestorEdge& edge, AncestorNodeId a, AncestorNodeId b) {
  return (edge.nodes[0] == a && edge.nodes[1] == b) || (edge.nodes[0] == b && edge.nodes[1] == a);
}

}  // namespace

void check_ancestors(const HybridMesh& mesh, Report& report) {
  const AncestorMesh& a = mesh.ancestors;
  std::vector<std::uint8_t> sides(a.edges.size(), 0);
  for (std::size_t n = 0; n < a.rest_positions.size(); ++n)
    if (!a.rest_positions[n].allFinite()) report.add(rule, name("rest position", n) + " is not finite");

  for (std::size_t t = 0; t < a.triangles.size(); ++t) {
    const Ancestor& triangle = a.triangles[t];
    const auto p = [&](std::size_t i) -> const Eigen::Vector3d& {
      return a.rest_positions[triangle.nodes[i].index()];
    };
    if ((p(1) - p(0)).cross(p(2) - p(0)).isZero(0)) report.add(rule, name("ancestor", t) + " has no area");
    if (before(p(1), p(0)) || before(p(2), p(0)))
      report.add(rule, "corner 0 of ancestor " + std::to_string(t) + " is not the smallest");
    for (std::size_t i = 0; i < 3; ++i) {
      const AncestorEdgeId e = triangle.edges[i];
      const AncestorEdge& edge = a.edges[e.index()];
      const bool listed = edge.triangles[0].index() == t || edge.triangles[1].index() == t;
      if (!listed || !has_side(edge, triangle.nodes[i], triangle.nodes[next_corner(i)]))
        report.add(rule,
                   name("ancestor", t) + " and its ancestor edge " + std::to_string(e.index()) + " disagree");
      if (sides[e.index()] < 3) ++sides[e.index()];
    }
  }

  for (std::size_t e = 0; e < a.edges.size(); ++e) {
    const AncestorEdge& edge = a.edges[e];
    if (before(a.rest_positions[edge.nodes[1].index()], a.rest_positions[edge.nodes[0].index()]))
      report.add(rule, name("ancestor edge", e) + " runs from the larger to the smaller node");
    if (edge.triangles[0] == edge.triangles[1] || sides[e] != (edge.triangles[1].valid() ? 2 : 1))
      report.add(rule, name("ancestor edge", e) + " does not list the triangles that have it");
  }

  std::vector<std::uint8_t> listed(3 * a.triangles.size(), 0);  // per corner of each triangle
  for (std::size_t n = 0; n < a.rest_positions.size(); ++n)
    for (const AncestorId t : a.triangles_around(AncestorNodeId{n})) {
      const std::size_t corner = a.local_node(t, AncestorNodeId{n});
      if (a.triangles[t.index()].nodes[corner].index() != n)
        report.add(rule, name("incidences of ancestor node", n) + " list a triangle that is not there");
      else
        ++listed[3 * t.index() + corner];
    }
  for (std::size_t c = 0; c < listed.size(); ++c)
    if (listed[c] != 1)
      report.add(rule, name("ancestor", c / 3) + " is listed " + std::to_string(listed[c]) +
                           " times at its corner " + std::to_string(c % 3));
}

}  // namespace cut::validation

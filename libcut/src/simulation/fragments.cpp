// What the fragments of cut triangles weigh and how stiff they are (docs/decisions.md, "Conserving
// material"). In: arrangements, and the change set where fragments were divided. Out: weights, masses and
// spring constants. Masses and constants of all copies of a node or an edge are summed up anew from the
// weights around it, in a fixed order: nothing drifts however often a place is cut.
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "cut/simulation.hpp"
#include "lattice/sort_unique.hpp"
#include "lattice/weights.hpp"
#include "simulation/renders_corner.hpp"
#include "simulation/rest_area.hpp"

namespace cut {
namespace {

lattice::Moments moments_of(const Arrangement& arrangement, const RenderPolygon& polygon) {
  std::vector<LatticePoint> points;
  points.reserve(polygon.corners.size());
  for (const PolygonCorner& corner : polygon.corners) points.push_back(arrangement.nodes[corner.node].point);
  return lattice::polygon_moments(points, polygon.loop_ends);
}

}  // namespace

/// Weights of all fragments of a triangle from their shape.
void Simulation::measure_weights(const HybridMesh& mesh, AncestorId ancestor) {
  if (const Arrangement* arrangement = mesh.arrangement(ancestor))
    for (const RenderPolygon& polygon : arrangement->polygons)
      weights_[polygon.triangle.index()] = lattice::corner_weights(moments_of(*arrangement, polygon));
}

/// The parts of a divided fragment share its weights in the ratio of their integrals. Measuring them anew
/// would shift mass between nodes that have long moved apart, since a new cut may bend old ones by half a
/// lattice cell.
/// @param first_new  number of physics triangles before the cut
void Simulation::divide_weights(const Changes& changes, const HybridMesh& mesh, std::size_t first_new) {
  std::vector<TriangleId> sources(weights_.size() -
                                  first_new);  // per new triangle: the old one it was part of
  const auto source_of = [&](TriangleId t) {
    return t.index() < first_new ? t : sources[t.index() - first_new];
  };
  std::vector<AncestorId> ancestors;
  for (const TriangleCopy& copy : changes.triangle_copies) {
    sources[copy.triangle.index() - first_new] = source_of(copy.source);
    ancestors.push_back(mesh.buffers.triangles[copy.triangle.index()].ancestor);
  }
  lattice::sort_unique(ancestors);

  struct Part {
    TriangleId source;
    TriangleId triangle;
    lattice::Moments moments;
  };
  std::vector<Part> parts;
  for (const AncestorId ancestor : ancestors) {
    const Arrangement& arrangement = *mesh.arrangement(ancestor);
    for (const RenderPolygon& polygon : arrangement.polygons)
      parts.push_back({source_of(polygon.triangle), polygon.triangle, moments_of(arrangement, polygon)});
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::pair(a.source, a.triangle) < std::pair(b.source, b.triangle);
  });
  for (auto part = parts.begin(); part != parts.end();) {
    const auto begin = part;
    lattice::Moments sum{};
    for (; part != parts.end() && part->source == begin->source; ++part)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += part->moments[i];
    if (part - begin == 1) continue;
    const std::array<double, 3> whole = weights_[begin->source.index()];
    for (auto p = begin; p != part; ++p)
      for (std::size_t i = 0; i < 3; ++i)
        weights_[p->triangle.index()][i] =
            whole[i] * (static_cast<double>(p->moments[i]) / static_cast<double>(sum[i]));
  }
}

/// Mass and anchor of all copies of a node.
void Simulation::update_copies(const HybridMesh& mesh, AncestorNodeId node) {
  struct Share {
    NodeId copy;
    double mass;
    bool rendered;
  };
  const bool conserving = material_.mode == MaterialMode::conserving;
  std::vector<Share> shares;
  std::vector<double> thirds;
  for (const AncestorId t : mesh.ancestors.triangles_around(node)) {
    const std::size_t i = mesh.ancestors.local_node(t, node);
    const double third = material_.density * rest_area(mesh.ancestors, t) / 3;
    thirds.push_back(third);
    for (std::size_t p = 0; p < mesh.fragment_count(t); ++p) {
      const TriangleId fragment = mesh.fragment(t, p);
      const NodeId copy = mesh.buffers.triangles[fragment.index()].nodes[i];
      shares.push_back({copy, conserving ? third * weights_[fragment.index()][i] : 0,
                        anchored(copy) && renders_corner(mesh.arrangement(t), p, i)});
    }
  }
  // Sums run by size: they do not depend on how triangles are numbered.
  std::sort(thirds.begin(), thirds.end());
  const double whole = std::accumulate(thirds.begin(), thirds.end(), 0.0);
  std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return std::pair(a.copy, a.mass) < std::pair(b.copy, b.mass);
  });
  for (auto share = shares.begin(); share != shares.end();) {
    Share sum = *share;
    for (++share; share != shares.end() && share->copy == sum.copy; ++share) {
      sum.mass += share->mass;
      sum.rendered |= share->rendered;
    }
    if (conserving) anchored_[sum.copy.index()] = sum.rendered;
    set_mass(sum.copy, conserving ? sum.mass : whole);
  }
}

/// Stiffness and damping of all springs between copies of an edge's two nodes.
void Simulation::update_springs(const HybridMesh& mesh, AncestorEdgeId edge) {
  const auto& sides = mesh.ancestors.edges[edge.index()].triangles;
  const double side = sides[0].valid() && sides[1].valid() ? 0.5 : 1;
  std::vector<std::pair<std::array<NodeId, 2>, double>> shares;
  for (const AncestorId t : sides) {
    if (!t.valid()) continue;
    const std::size_t i = mesh.ancestors.local_edge(t, edge);
    std::size_t from = i, to = next_corner(i);
    if (mesh.ancestors.reversed(t, i)) std::swap(from, to);
    for (std::size_t p = 0; p < mesh.fragment_count(t); ++p) {
      const TriangleId fragment = mesh.fragment(t, p);
      const auto& nodes = mesh.buffers.triangles[fragment.index()].nodes;
      const auto& weights = weights_[fragment.index()];
      shares.push_back({{nodes[from], nodes[to]}, side * std::min(weights[from], weights[to])});
    }
  }
  std::sort(shares.begin(), shares.end());
  const auto set = [&](SpringId spring) {
    const auto& nodes = mesh.buffers.springs[spring.index()].nodes;
    auto share = std::lower_bound(shares.begin(), shares.end(), nodes,
                                  [](const auto& a, const auto& b) { return a.first < b; });
    double sum = 0;
    for (; share != shares.end() && share->first == nodes; ++share) sum += share->second;
    springs_.stiffness[spring.index()] = material_.stiffness * sum;
    springs_.damping[spring.index()] = material_.damping * sum;
    touched_.push_back(spring.value);
  };
  if (const EdgeState* state = mesh.edge_state(edge))
    for (const SpringId spring : state->springs) set(spring);
  else
    set(SpringId{edge.index()});
}

void Simulation::anchor(AncestorNodeId node, const HybridMesh& mesh) {
  for (const AncestorId t : mesh.ancestors.triangles_around(node)) {
    const std::size_t i = mesh.ancestors.local_node(t, node);
    const Arrangement* arrangement = mesh.arrangement(t);
    for (std::size_t p = 0; p < mesh.fragment_count(t); ++p)
      if (renders_corner(arrangement, p, i))
        anchor(mesh.buffers.triangles[mesh.fragment(t, p).index()].nodes[i]);
  }
}

}  // namespace cut

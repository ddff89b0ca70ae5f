// Which fragments tear (see tearing.hpp). In: positions, arrangements and springs of the mesh. Out: two
// triangles for each tear, upright on its fragment.
#include "cut/tearing.hpp"

#include <algorithm>
#include <compare>
#include <tuple>
#include <utility>
#include <vector>

#include "lattice/sort_unique.hpp"
#include "mesh/vector3.hpp"
#include "simulation/renders_corner.hpp"
#include "simulation/tear_line.hpp"

namespace cut {
namespace {

/// How far a spring is stretched. Of two that are stretched alike, the place of their edges decides, so that
/// numbers of springs do not matter; copies of one spring are equal.
struct Stretch {
  double squared_ratio = 0;
  std::array<double, 3> place{};
  auto operator<=>(const Stretch&) const = default;
};

Stretch stretch_of(const HybridMesh& mesh, AncestorEdgeId edge, NodeId a, NodeId b) {
  const auto& ends = mesh.ancestors.edges[edge.index()].nodes;
  const double rest = mesh.ancestors.rest_length(edge);
  const Eigen::Vector3d sum =
      mesh.ancestors.rest_positions[ends[0].index()] + mesh.ancestors.rest_positions[ends[1].index()];
  return {squared_length(mesh.positions[b.index()] - mesh.positions[a.index()]) / (rest * rest),
          {sum.x(), sum.y(), sum.z()}};
}

/// The part of an ancestor that may tear.
struct Fragment {
  AncestorId ancestor;
  std::size_t polygon;
  auto operator<=>(const Fragment&) const = default;
};

/// Fragments with a side beyond the limit, sorted, each once.
std::vector<Fragment> overstretched(const HybridMesh& mesh, double squared_limit,
                                    std::vector<Stretch>& most_stretched_at) {
  std::vector<Fragment> fragments;
  for (const Spring& spring : mesh.buffers.springs) {
    if (!spring.nodes[0].valid()) continue;
    const Stretch stretch = stretch_of(mesh, spring.edge, spring.nodes[0], spring.nodes[1]);
    if (!(stretch.squared_ratio > squared_limit)) continue;
    for (const NodeId n : spring.nodes)
      most_stretched_at[n.index()] = std::max(most_stretched_at[n.index()], stretch);
    for (const AncestorId t : mesh.ancestors.edges[spring.edge.index()].triangles)
      if (t.valid())
        for (std::size_t p = 0; p < mesh.fragment_count(t); ++p) fragments.push_back({t, p});
  }
  lattice::sort_unique(fragments);
  return fragments;
}

}  // namespace

TriangleMesh tears(const HybridMesh& mesh, double limit, const MergeDistances& distances) {
  TriangleMesh cutter;
  if (!(limit > 1)) return cutter;
  std::vector<Stretch> most_stretched_at(mesh.positions.size());
  for (const Fragment& fragment : overstretched(mesh, limit * limit, most_stretched_at)) {
    const AncestorId t = fragment.ancestor;
    const auto& nodes = mesh.buffers.triangles[mesh.fragment(t, fragment.polygon).index()].nodes;
    std::optional<std::pair<Stretch, std::size_t>> worst;  // of the sides whose ends are rendered
    for (std::size_t i = 0; i < 3; ++i) {
      if (!renders_corner(mesh.arrangement(t), fragment.polygon, i) ||
          !renders_corner(mesh.arrangement(t), fragment.polygon, next_corner(i)))
        continue;
      const AncestorEdgeId edge = mesh.ancestors.triangles[t.index()].edges[i];
      const Stretch stretch = stretch_of(mesh, edge, nodes[i], nodes[next_corner(i)]);
      if (stretch.squared_ratio > limit * limit && (!worst || worst->first < stretch))
        worst = std::pair(stretch, i);
    }
    if (!worst) continue;
    const std::size_t side = worst->second;
    const bool fresh = worst->first == most_stretched_at[nodes[side].index()] &&
                       worst->first == most_stretched_at[nodes[next_corner(side)].index()];
    const auto start = tear_start(mesh, t, fragment.polygon, side, fresh);
    const auto line = start ? tear_line(mesh, t, fragment.polygon, *start) : std::nullopt;
    if (!line) continue;
    const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& {
      return mesh.positions[nodes[i].index()];
    };
    const Eigen::Vector3d normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    const Eigen::Vector3d up = normal * (distances.edge / length(normal));
    const auto first = static_cast<std::uint32_t>(cutter.positions.size());
    for (const lattice::PlanePoint p : *line) {
      const Eigen::Vector3d place = (1 - p.x - p.y) * corner(0) + p.x * corner(1) + p.y * corner(2);
      cutter.positions.push_back(place - up);
      cutter.positions.push_back(place + up);
    }
    cutter.triangles.push_back({first, first + 2, first + 3});
    cutter.triangles.push_back({first, first + 3, first + 1});
  }
  return cutter;
}

}  // namespace cut

// The pairs of opposite corners at an edge, see cut/bending.hpp. Parts of the edge are counted in lattice
// units, so that they add up exactly.
#include "cut/bending.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/sections.hpp"
#include "mesh/vector3.hpp"

namespace cut {
namespace {

double part_of_edge(std::int64_t units) { return static_cast<double>(units) / lattice_size; }

}  // namespace

std::vector<BendingPair> bending_pairs(const HybridMesh& mesh, AncestorEdgeId edge) {
  const auto& sides = mesh.ancestors.edges[edge.index()].triangles;
  if (!sides[1].valid()) return {};
  const EdgeState* state = mesh.edge_state(edge);
  const std::size_t sections = state != nullptr ? state->cut.size() : 1;
  std::vector<std::array<TriangleId, 2>> fragments(sections);  // per section
  std::array<std::size_t, 2> opposite{};
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t i = mesh.ancestors.local_edge(sides[side], edge);
    opposite[side] = last_corner(i);
    for_each_section(mesh, sides[side], i, [&](std::size_t section, std::uint32_t polygon) {
      fragments[section][side] = mesh.fragment(sides[side], polygon);
    });
  }
  const auto pair_of = [&](const std::array<TriangleId, 2>& both) {
    BendingPair pair{{}, both, {1, 1}, 1};
    for (std::size_t side = 0; side < 2; ++side)
      pair.nodes[side] = mesh.buffers.triangles[both[side].index()].nodes[opposite[side]];
    return pair;
  };
  if (state == nullptr) return {pair_of(fragments[0])};  // most edges: without the containers below
  std::map<TriangleId, std::int64_t> bordered;           // in lattice units
  std::map<std::array<TriangleId, 2>, std::int64_t> shared;
  for (std::size_t k = 0; k < sections; ++k) {
    const auto [from, to] = section_range(state, k);
    for (const TriangleId fragment : fragments[k]) bordered[fragment] += to - from;
    if (!is_cut(state, k)) shared[fragments[k]] += to - from;
  }
  std::vector<BendingPair> pairs;
  pairs.reserve(shared.size());
  for (const auto& [both, units] : shared) {
    BendingPair& pair = pairs.emplace_back(pair_of(both));
    pair.shared = part_of_edge(units);
    for (std::size_t side = 0; side < 2; ++side) pair.bordered[side] = part_of_edge(bordered[both[side]]);
  }
  return pairs;
}

double bending_rest_length(const AncestorMesh& ancestors, AncestorEdgeId edge) {
  const auto& sides = ancestors.edges[edge.index()].triangles;
  std::array<Eigen::Vector3d, 2> opposite;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t corner = last_corner(ancestors.local_edge(sides[side], edge));
    opposite[side] = ancestors.rest_positions[ancestors.triangles[sides[side].index()].nodes[corner].index()];
  }
  return length(opposite[1] - opposite[0]);
}

}  // namespace cut

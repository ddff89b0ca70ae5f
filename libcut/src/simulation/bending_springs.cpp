// The springs that resist bending (docs/decisions.md, "Bending"). In: the pairs of opposite corners at an
// edge, and the weights of fragments. Out: entries of a second set of flat arrays. Entry e belongs to
// ancestor edge e; an edge with more pairs is a chain of entries, the further ones of which are used again.
#include <algorithm>
#include <utility>
#include <vector>

#include "cut/bending.hpp"
#include "cut/simulation.hpp"

namespace cut {

/// Makes room for so many entries; new ones are free.
void Simulation::reserve_bending(std::size_t entries) {
  next_bending_.resize(entries);
  const std::size_t padded = (entries + 3) / 4 * 4;
  bending_.nodes.resize(padded);
  bending_.rest_length.resize(padded);
  bending_.stiffness.resize(padded);
  bending_.damping.resize(padded);
}

/// Brings the entries of an edge up to date: one for each pair of nodes. @pre there are bending springs
void Simulation::update_bending(const HybridMesh& mesh, AncestorEdgeId edge) {
  const auto& sides = mesh.ancestors.edges[edge.index()].triangles;
  if (!sides[1].valid()) return;
  std::vector<std::pair<std::array<std::uint32_t, 2>, double>> shares;
  for (const BendingPair& pair : bending_pairs(mesh, edge)) {
    double share = 1;
    if (material_.mode == MaterialMode::conserving) {
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t opposite = last_corner(mesh.ancestors.local_edge(sides[side], edge));
        share = std::min(share, weights_[pair.fragments[side].index()][opposite] / pair.bordered[side]);
      }
      share *= pair.shared;
    }
    shares.push_back({{pair.nodes[0].value, pair.nodes[1].value}, share});
  }
  std::sort(shares.begin(), shares.end());

  const double rest_length = bending_rest_length(mesh.ancestors, edge);
  const auto set = [&](std::size_t i, std::array<std::uint32_t, 2> nodes, double share) {
    bending_.nodes[i] = nodes;
    bending_.rest_length[i] = rest_length;
    bending_.stiffness[i] = material_.bending_stiffness * share;
    bending_.damping[i] = material_.bending_damping * share;
    touched_bending_.push_back(static_cast<std::uint32_t>(i));
  };
  std::uint32_t entry = static_cast<std::uint32_t>(edge.index());
  std::uint32_t further = std::exchange(next_bending_[entry], 0);
  set(entry, {0, 0}, 0);
  bool first = true;
  for (auto share = shares.begin(); share != shares.end(); first = false) {
    const auto nodes = share->first;
    double sum = share->second;
    for (++share; share != shares.end() && share->first == nodes; ++share)
      if (material_.mode == MaterialMode::conserving) sum += share->second;
    if (!first) {
      std::uint32_t next = further;
      if (next != 0) {
        further = next_bending_[next];
      } else if (!free_bending_.empty()) {
        next = free_bending_.back();
        free_bending_.pop_back();
      } else {
        next = static_cast<std::uint32_t>(next_bending_.size());
        reserve_bending(next + 1);
      }
      next_bending_[next] = 0;
      next_bending_[entry] = next;
      entry = next;
    }
    set(entry, nodes, sum);
  }
  for (; further != 0; further = std::exchange(next_bending_[further], 0)) {
    set(further, {0, 0}, 0);
    free_bending_.push_back(further);
  }
}

}  // namespace cut

// Takes over a cut (§4.10, "changes are propagated to the MSDM simulation"). In: the change set and the mesh
// after it. Out: arrays with new entries for copied nodes and changed springs. Only what the change set
// names, and in conserving mode the triangles around it, is touched.
#include <algorithm>

#include "cut/simulation.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {

std::optional<Error> Simulation::apply(const Changes& changes, const HybridMesh& mesh) {
  if (changes.empty()) return std::nullopt;
  if (changes.version_before != topology_version_ || changes.version_after != mesh.topology_version)
    return Error{Error::Kind::bad_parameter,
                 "the change set does not lead from the cut that the simulation stands at to the mesh's", 0};
  const std::size_t first_new_triangle = weights_.size();
  resize(mesh);
  for (const auto& entry : changes.springs.entries) set_spring(SpringId{entry.index}, mesh);
  copy_nodes(changes);
  if (material_.mode == MaterialMode::conserving) take_over_fragments(changes, mesh, first_new_triangle);
  if (!next_bending_.empty())
    for (const AncestorEdgeId edge : changes.edges) update_bending(mesh, edge);
  settle_springs();
  topology_version_ = changes.version_after;
  return std::nullopt;
}

/// In paper mode a copy is a full copy.
void Simulation::copy_nodes(const Changes& changes) {
  for (const NodeCopy& copy : changes.node_copies) {
    const std::size_t to = copy.node.index(), from = copy.source.index();
    blocks_.add_copy(copy.source.value);
    velocities_[to] = velocities_[from];
    anchored_[to] = anchored_[from];
    mass_[to] = mass_[from];
    inverse_mass_[to] = inverse_mass_[from];
    if (!external_forces_.empty()) external_forces_[to] = external_forces_[from];
  }
}

/// Takes over an entry of the mesh's springs, with the constants that it has uncut.
void Simulation::set_spring(SpringId spring, const HybridMesh& mesh) {
  const std::size_t i = spring.index();
  const bool was_used = springs_.nodes[i][0] != springs_.nodes[i][1];
  const Spring& value = mesh.buffers.springs[i];
  const bool used = value.nodes[0].valid();
  spring_count_ = spring_count_ + (used ? 1 : 0) - (was_used ? 1 : 0);
  springs_.nodes[i] =
      used ? std::array{value.nodes[0].value, value.nodes[1].value} : std::array<std::uint32_t, 2>{0, 0};
  springs_.rest_length[i] = used ? mesh.ancestors.rest_length(value.edge) : 0;
  springs_.stiffness[i] = used ? material_.stiffness : 0;
  springs_.damping[i] = used ? material_.damping : 0;
  touched_.push_back(spring.value);
}

/// Copies what was written to springs to the blocks.
void Simulation::settle_springs() {
  places_.resize(springs_.nodes.size());
  for (const std::uint32_t i : touched_) blocks_.set(springs_, i, places_[i]);
  touched_.clear();
  bending_places_.resize(bending_.nodes.size());
  for (const std::uint32_t i : touched_bending_) blocks_.set(bending_, i, bending_places_[i]);
  touched_bending_.clear();
}

void Simulation::take_over_fragments(const Changes& changes, const HybridMesh& mesh,
                                     std::size_t first_new_triangle) {
  divide_weights(changes, mesh, first_new_triangle);
  std::vector<AncestorId> touched;
  for (const auto& entry : changes.triangles.entries)
    if (entry.value.ancestor.valid()) touched.push_back(entry.value.ancestor);
  lattice::sort_unique(touched);
  std::vector<AncestorNodeId> nodes;
  std::vector<AncestorEdgeId> edges;
  for (const auto& entry : changes.springs.entries)
    if (entry.value.edge.valid()) edges.push_back(entry.value.edge);
  for (const AncestorId t : touched) {
    const Ancestor& ancestor = mesh.ancestors.triangles[t.index()];
    nodes.insert(nodes.end(), ancestor.nodes.begin(), ancestor.nodes.end());
    edges.insert(edges.end(), ancestor.edges.begin(), ancestor.edges.end());
  }
  lattice::sort_unique(nodes);
  lattice::sort_unique(edges);
  for (const AncestorNodeId node : nodes) update_copies(mesh, node);
  for (const AncestorEdgeId edge : edges) update_springs(mesh, edge);
}

}  // namespace cut

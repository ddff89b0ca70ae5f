/// @file
/// Rule boundary_nodes_agree: the state of an ancestor edge is in order, and both triangles at the edge carry
/// exactly its nodes, so that no T-junction can arise. In: edge states, arrangements. Out: violations.
#include "validate/rules.hpp"

namespace cut::validation {
namespace {

constexpr const char* rule = "boundary_nodes_agree";

void check_state(const EdgeState& state, std::size_t e, Report& report) {
  std::int32_t previous = 0;
  for (const BoundaryNode& node : state.nodes) {
    if (node.t <= previous || node.t >= lattice_size)
      report.add(rule,
                 "boundary nodes of ancestor edge " + std::to_string(e) + " do not ascend inside the edge");
    previous = node.t;
  }
  for (const std::uint8_t cut : state.cut)
    if (cut > 1)
      report.add("edge_sides_agree", name("ancestor edge", e) + ": a section is neither cut nor joined");
}

void check_side(const HybridMesh& mesh, std::size_t e, AncestorId t, Report& report) {
  const EdgeState* state = mesh.edge_state(AncestorEdgeId{e});
  const Arrangement* arrangement = mesh.arrangement(t);
  const std::size_t count = state ? state->nodes.size() : 0;
  const auto disagree = [&] {
    report.add(rule, name("ancestor edge", e) + " and ancestor " + std::to_string(t.index()) +
                         " have different boundary nodes");
  };
  const std::size_t i = mesh.ancestors.local_edge(t, AncestorEdgeId{e});
  if ((arrangement ? arrangement->boundary_counts[i] : 0) != count) return disagree();
  const bool reversed = mesh.ancestors.reversed(t, i);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t from_start = state->nodes[reversed ? count - 1 - k : k].t;
    if (from_start <= 0 || from_start >= lattice_size) continue;  // reported above
    const std::int32_t along = reversed ? lattice_size - from_start : from_start;
    const std::uint32_t node = arrangement->edge_node(i, static_cast<std::uint32_t>(k + 1));
    if (arrangement->nodes[node].point != lattice_point_on_edge(i, along)) return disagree();
  }
}

}  // namespace

void check_boundaries(const HybridMesh& mesh, Report& report) {
  for (std::size_t e = 0; e < mesh.ancestors.edges.size() && !report.full(); ++e) {
    if (const EdgeState* state = mesh.edge_state(AncestorEdgeId{e})) check_state(*state, e, report);
    for (const AncestorId t : mesh.ancestors.edges[e].triangles)
      if (t.valid()) check_side(mesh, e, t, report);
  }
}

}  // namespace cut::validation

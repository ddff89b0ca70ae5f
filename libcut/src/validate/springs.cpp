/// @file
/// Rules springs_match (exactly one spring for each pair of nodes that a triangle joins, listed at its edge)
/// and springs_keep_rest_length (it stands for the ancestor edge between the originals of its nodes). In:
/// triangles, springs, edge states. Out: violations.
#include <algorithm>
#include <tuple>

#include "validate/rules.hpp"

namespace cut::validation {
namespace {

constexpr const char* rule = "springs_match";

struct Link {
  NodeId low;
  NodeId high;
  AncestorEdgeId edge;
  auto operator<=>(const Link&) const = default;
};

Link link(NodeId a, NodeId b, AncestorEdgeId edge) { return a < b ? Link{a, b, edge} : Link{b, a, edge}; }

bool removed(const Spring& s) { return !s.nodes[0].valid() && !s.nodes[1].valid(); }

std::string describe(const Link& l) {
  return "nodes " + std::to_string(l.low.index()) + " and " + std::to_string(l.high.index());
}

void check_pairs(const HybridMesh& mesh, Report& report) {
  std::vector<Link> wanted;
  for (const PhysicsTriangle& t : mesh.buffers.triangles)
    for (std::size_t i = 0; t.ancestor.valid() && i < 3; ++i)
      wanted.push_back(
          link(t.nodes[i], t.nodes[next_corner(i)], mesh.ancestors.triangles[t.ancestor.index()].edges[i]));
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::vector<Link> present;
  for (const Spring& s : mesh.buffers.springs)
    if (!removed(s)) present.push_back(link(s.nodes[0], s.nodes[1], s.edge));
  std::sort(present.begin(), present.end());

  for (std::size_t i = 0; i + 1 < present.size(); ++i)
    if (present[i].low == present[i + 1].low && present[i].high == present[i + 1].high)
      report.add(rule, describe(present[i]) + " have two springs");
  std::vector<Link> odd;
  std::set_difference(wanted.begin(), wanted.end(), present.begin(), present.end(), std::back_inserter(odd));
  for (const Link& l : odd) report.add(rule, describe(l) + " lack their spring");
  odd.clear();
  std::set_difference(present.begin(), present.end(), wanted.begin(), wanted.end(), std::back_inserter(odd));
  for (const Link& l : odd) report.add(rule, describe(l) + " have a spring and no triangle between them");
}

/// An edge without state has the spring of its own number; an edge with one lists its springs.
void check_lists(const HybridMesh& mesh, Report& report) {
  const auto& springs = mesh.buffers.springs;
  std::vector<std::uint32_t> listed(springs.size(), 0);
  const auto list = [&](std::size_t s, std::size_t e) {
    if (s >= springs.size() || removed(springs[s]) || springs[s].edge.index() != e)
      report.add(rule, name("ancestor edge", e) + " lists a spring that is not its own");
    else
      ++listed[s];
  };
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) {
    const EdgeState* state = mesh.edge_state(AncestorEdgeId{e});
    if (!state) list(e, e);
    for (std::size_t i = 0; state && i < state->springs.size(); ++i) list(state->springs[i].index(), e);
  }
  for (std::size_t s = 0; s < springs.size(); ++s)
    if (listed[s] != (removed(springs[s]) ? 0u : 1u))
      report.add(rule, name("spring", s) + " is listed " + std::to_string(listed[s]) + " times at its edge");
}

void check_ends(const HybridMesh& mesh, Report& report) {
  for (std::size_t i = 0; i < mesh.buffers.springs.size(); ++i) {
    const Spring& s = mesh.buffers.springs[i];
    for (std::size_t k = 0; !removed(s) && k < 2; ++k)
      if (mesh.buffers.nodes[s.nodes[k].index()] != mesh.ancestors.edges[s.edge.index()].nodes[k])
        report.add("springs_keep_rest_length",
                   name("spring", i) + " joins other nodes than its ancestor edge");
  }
}

}  // namespace

void check_springs(const HybridMesh& mesh, Report& report) {
  check_pairs(mesh, report);
  check_lists(mesh, report);
  check_ends(mesh, report);
}

}  // namespace cut::validation

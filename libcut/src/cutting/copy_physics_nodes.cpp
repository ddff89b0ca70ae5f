#include "cutting/copy_physics_nodes.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cutting/edge_state.hpp"
#include "cutting/in_parts.hpp"
#include "lattice/components.hpp"
#include "lattice/scratch.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

/// The fragments of the triangles around a node, numbered.
struct Fragments {
  std::span<const AncestorId> around;
  lattice::ScratchList<Index> first;  ///< per triangle (+1): number of its first fragment

  Fragments(const HybridMesh& mesh, AncestorNodeId node, lattice::Scratch& scratch)
      : around(mesh.ancestors.triangles_around(node)), first(&scratch) {
    first.reserve(around.size() + 1);
    first.push_back(0);
    for (const AncestorId t : around)
      first.push_back(first.back() + static_cast<Index>(mesh.fragment_count(t)));
  }
  [[nodiscard]] std::size_t position(AncestorId t) const {
    return static_cast<std::size_t>(std::find(around.begin(), around.end(), t) - around.begin());
  }
};

/// Joins fragments that share an uncut section of an edge ending at the node.
lattice::Components connect(const HybridMesh& mesh, AncestorNodeId node, const Fragments& fragments,
                            lattice::Scratch& scratch) {
  lattice::Components components(fragments.first.back(), &scratch);
  lattice::ScratchList<Index> polygons(&scratch);  // per section, on the first side
  for (std::size_t a = 0; a < fragments.around.size(); ++a) {
    const AncestorId t = fragments.around[a];
    const std::size_t corner = mesh.ancestors.local_node(t, node);
    for (const std::size_t i : {corner, last_corner(corner)}) {
      const AncestorId other = mesh.ancestors.neighbour(t, i);
      if (!other.valid() || other < t) continue;
      const AncestorEdgeId edge = mesh.ancestors.triangles[t.index()].edges[i];
      const EdgeState* state = mesh.edge_state(edge);
      const std::size_t b = fragments.position(other);
      polygons.clear();
      for_each_section(mesh, t, i, [&](std::size_t, Index polygon) { polygons.push_back(polygon); });
      for_each_section(
          mesh, other, mesh.ancestors.local_edge(other, edge), [&](std::size_t section, Index polygon) {
            if (!is_cut(state, section))
              components.join(fragments.first[a] + polygons[section], fragments.first[b] + polygon);
          });
    }
  }
  return components;
}

/// True when the polygon reaches the triangle's corner.
bool renders_corner(const HybridMesh& mesh, AncestorId t, Index polygon, std::size_t corner) {
  const Arrangement* arrangement = mesh.arrangement(t);
  if (arrangement == nullptr) return true;
  const auto& corners = arrangement->polygons[polygon].corners;
  return std::any_of(corners.begin(), corners.end(),
                     [&](const PolygonCorner& c) { return c.node == corner; });
}

/// One component of fragments, as seen from the node.
struct Component {
  NodeId node;   ///< that its fragments had so far
  bool renders;  ///< one of its fragments reaches the node
  Index root;
};

/// The copies that some nodes get, and which fragments get them.
struct Copies {
  struct Made {
    AncestorNodeId node;
    NodeId source;
  };
  struct Change {
    TriangleId triangle;
    std::uint32_t corner;
    Index copy;  ///< index into `made`
  };
  std::vector<Made> made;
  std::vector<Change> changes;
  std::size_t first = 0;  ///< number of the first copy
};

/// Calls visit(triangle, corner, polygon, number) for the fragments around a node.
template <class Visit>
void for_each_fragment(const HybridMesh& mesh, AncestorNodeId node, const Visit& visit) {
  Index number = 0;
  for (const AncestorId t : mesh.ancestors.triangles_around(node)) {
    const std::size_t corner = mesh.ancestors.local_node(t, node);
    const auto count = static_cast<Index>(mesh.fragment_count(t));
    for (Index p = 0; p < count; ++p) visit(t, corner, p, number++);
  }
}

/// Of the components that had the same node, all but one get copies of it.
void find_copies(const HybridMesh& mesh, AncestorNodeId node, Copies& all) {
  lattice::Scratch scratch;
  const Fragments fragments(mesh, node, scratch);
  lattice::Components connected = connect(mesh, node, fragments, scratch);
  Index roots = 0;
  for (Index i = 0; i < connected.size(); ++i) roots += connected.root(i) == i ? 1u : 0u;
  if (roots <= 1) return;
  lattice::ScratchList<Component> components(&scratch);
  components.reserve(roots);
  lattice::ScratchList<Index> component_of(connected.size(), HybridMesh::none, &scratch);  // by root
  for_each_fragment(mesh, node, [&](AncestorId t, std::size_t corner, Index polygon, Index number) {
    const Index root = connected.root(number);
    if (component_of[root] == HybridMesh::none) {
      component_of[root] = static_cast<Index>(components.size());
      components.push_back(
          {mesh.buffers.triangles[mesh.fragment(t, polygon).index()].nodes[corner], false, root});
    }
    bool& renders = components[component_of[root]].renders;
    renders = renders || renders_corner(mesh, t, polygon, corner);
  });
  lattice::ScratchList<Index> order(components.size(), &scratch);
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::tuple(components[a].node, !components[a].renders, components[a].root) <
           std::tuple(components[b].node, !components[b].renders, components[b].root);
  });
  lattice::ScratchList<Index> copy_of(components.size(), HybridMesh::none, &scratch);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const NodeId source = components[order[i]].node;
    if (components[order[i - 1]].node != source) continue;
    copy_of[order[i]] = static_cast<Index>(all.made.size());
    all.made.push_back({node, source});
  }
  for_each_fragment(mesh, node, [&](AncestorId t, std::size_t corner, Index polygon, Index number) {
    const Index copy = copy_of[component_of[connected.root(number)]];
    if (copy != HybridMesh::none)
      all.changes.push_back({mesh.fragment(t, polygon), static_cast<std::uint32_t>(corner), copy});
  });
}

/// @pre the mesh and `all_copies` have entries for them
void make_copies(HybridMesh& mesh, const Copies& copies, std::span<NodeCopy> all_copies) {
  const std::size_t before = mesh.buffers.nodes.size() - all_copies.size();
  for (std::size_t i = 0; i < copies.made.size(); ++i) {
    const NodeId copy{copies.first + i}, source = copies.made[i].source;
    mesh.buffers.nodes[copy.index()] = copies.made[i].node;
    mesh.positions[copy.index()] = mesh.positions[source.index()];
    all_copies[copy.index() - before] = {copy, source};
  }
  for (const auto& [triangle, corner, copy] : copies.changes)
    mesh.buffers.triangles[triangle.index()].nodes[corner] = NodeId{copies.first + copy};
}

/// Two nodes that a spring joins, in the direction of its edge.
using Pair = std::array<NodeId, 2>;

/// A pair that gets a spring: an entry of its own, or that of the spring which it comes from.
struct NewSpring {
  Pair nodes;
  SpringId source;
  bool takes_entry;
};

/// What the springs of some edges lack.
struct EdgesSprings {
  struct Edge {
    AncestorEdgeId edge;
    std::size_t wanted_end;
    std::size_t idle_end;
  };
  std::vector<Edge> edges;  ///< those that lack anything
  std::vector<NewSpring> wanted;
  std::vector<SpringId> idle;  ///< whose pair is gone, and whose entry nobody takes
  std::size_t copies = 0;      ///< how many new entries; then the number of the next
  std::vector<std::uint32_t> written;
};

/// @param before_cut the node that a node was copied from by this cut, or itself
template <class BeforeCut>
void find_springs(const HybridMesh& mesh, AncestorEdgeId e, const BeforeCut& before_cut,
                  EdgesSprings& result) {
  lattice::Scratch scratch;
  lattice::ScratchList<Pair> wanted(&scratch);  // pairs that have no spring
  for (const AncestorId t : mesh.ancestors.edges[e.index()].triangles) {
    if (!t.valid()) continue;
    const std::size_t i = mesh.ancestors.local_edge(t, e);
    const bool reversed = mesh.ancestors.reversed(t, i);
    for (std::size_t p = 0; p < mesh.fragment_count(t); ++p) {
      const auto& corners = mesh.buffers.triangles[mesh.fragment(t, p).index()].nodes;
      Pair pair{corners[i], corners[next_corner(i)]};
      if (reversed) std::swap(pair[0], pair[1]);
      wanted.push_back(pair);
    }
  }
  lattice::sort_unique(wanted);
  lattice::ScratchList<std::pair<Pair, SpringId>> old(&scratch);
  lattice::ScratchList<SpringId> idle(&scratch);
  const auto look_at = [&](SpringId s) {
    const Pair& pair = old.emplace_back(mesh.buffers.springs[s.index()].nodes, s).first;
    const auto found = std::find(wanted.begin(), wanted.end(), pair);
    if (found == wanted.end())
      idle.push_back(s);
    else
      wanted.erase(found);
  };
  if (const EdgeState* state = mesh.edge_state(e))
    for (const SpringId s : state->springs) look_at(s);
  else
    look_at(SpringId{e.index()});
  if (wanted.empty() && idle.empty()) return;

  // The first pair that comes from that of an idle spring gets its entry.
  for (const Pair& pair : wanted) {
    const SpringId source = std::find_if(old.begin(), old.end(), [&](const auto& spring) {
                              return spring.first == Pair{before_cut(pair[0]), before_cut(pair[1])};
                            })->second;
    const auto entry = std::find(idle.begin(), idle.end(), source);
    result.wanted.push_back({pair, source, entry != idle.end()});
    if (entry != idle.end())
      idle.erase(entry);
    else
      ++result.copies;
  }
  append(result.idle, idle);
  result.edges.push_back({e, result.wanted.size(), result.idle.size()});
}

/// Writes what some edges lack. @pre all edges have states, and all springs their entries
void write_springs(HybridMesh& mesh, EdgesSprings& part, std::span<SpringCopy> copies) {
  auto& springs = mesh.buffers.springs;
  const std::size_t before = springs.size() - copies.size();
  std::size_t w = 0, i = 0;
  for (const auto& [edge, wanted_end, idle_end] : part.edges) {
    EdgeState& state = edge_state_for_writing(mesh, edge);
    for (; w < wanted_end; ++w) {
      const NewSpring& spring = part.wanted[w];
      SpringId s = spring.source;
      if (!spring.takes_entry) {
        s = SpringId{part.copies++};
        springs[s.index()].edge = edge;
        state.springs.push_back(s);
        copies[s.index() - before] = {s, spring.source};
      }
      springs[s.index()].nodes = spring.nodes;
      part.written.push_back(s.value);
    }
    for (; i < idle_end; ++i) {
      const SpringId s = part.idle[i];
      springs[s.index()] = Spring{};
      part.written.push_back(s.value);
      state.springs.erase(std::find(state.springs.begin(), state.springs.end(), s));
    }
  }
}

}  // namespace

void copy_physics_nodes(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                        ChangeLog& log) {
  auto parts = in_parts<Copies>(executor, nodes.size(),
                                [&](std::size_t i, Copies& copies) { find_copies(mesh, nodes[i], copies); });
  const std::size_t before = mesh.buffers.nodes.size();
  std::size_t all = before;
  for (Copies& part : parts) {
    part.first = all;
    all += part.made.size();
    for (const Copies::Change& change : part.changes) log.triangles.push_back(change.triangle.value);
  }
  mesh.buffers.nodes.resize(all);
  mesh.positions.resize(all);
  log.node_copies.resize(all - before);
  executor.for_each(parts.size(), [&](std::size_t p) { make_copies(mesh, parts[p], log.node_copies); });
  for (const NodeCopy& copy : log.node_copies) log.nodes.push_back(copy.node.value);
}

void update_springs(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                    ChangeLog& log) {
  std::vector<AncestorEdgeId> edges;
  for (const auto& part : in_parts<std::vector<AncestorEdgeId>>(
           executor, nodes.size(), [&](std::size_t n, std::vector<AncestorEdgeId>& around) {
             for (const AncestorId t : mesh.ancestors.triangles_around(nodes[n]))
               for (const std::size_t corner = mesh.ancestors.local_node(t, nodes[n]);
                    const std::size_t i : {corner, last_corner(corner)})
                 around.push_back(mesh.ancestors.triangles[t.index()].edges[i]);
           }))
    append(edges, part);
  lattice::sort_unique(edges);

  const std::size_t first_copy = mesh.buffers.nodes.size() - log.node_copies.size();
  const auto before_cut = [&](NodeId n) {
    return n.index() < first_copy ? n : log.node_copies[n.index() - first_copy].source;
  };
  auto parts = in_parts<EdgesSprings>(executor, edges.size(), [&](std::size_t i, EdgesSprings& part) {
    find_springs(mesh, edges[i], before_cut, part);
  });
  auto& springs = mesh.buffers.springs;
  const std::size_t before = springs.size();
  std::size_t all = before;
  for (EdgesSprings& part : parts) {
    all += std::exchange(part.copies, all);
    number_edge_states(mesh, part.edges, [](const EdgesSprings::Edge& e) { return e.edge; });
  }
  springs.resize(all);
  log.spring_copies.resize(all - before);
  executor.for_each(parts.size(), [&](std::size_t p) { write_springs(mesh, parts[p], log.spring_copies); });
  for (const EdgesSprings& part : parts) append(log.springs, part.written);
}

}  // namespace cut

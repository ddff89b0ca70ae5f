#include "cutting/copy_physics_nodes.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cutting/edge_state.hpp"
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
struct Copy {
  NodeId old;    ///< the node that its fragments had so far
  bool renders;  ///< one of its fragments reaches the node
  Index root;
  NodeId now;
};

/// What a node falls into: nothing when it stays whole.
struct Parts {
  std::vector<Copy> copies;
  std::vector<Index> copy_of;  ///< per fragment around the node
  std::vector<Index> order;    ///< of the copies that had the same node, the first keeps it
  bool copied = false;
  std::vector<TriangleId> changed;  ///< fragments that got another node
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

Parts parts_of(const HybridMesh& mesh, AncestorNodeId node) {
  lattice::Scratch scratch;
  const Fragments fragments(mesh, node, scratch);
  lattice::Components components = connect(mesh, node, fragments, scratch);
  Parts parts;
  Index roots = 0;
  for (Index i = 0; i < components.size(); ++i) roots += components.root(i) == i ? 1u : 0u;
  if (roots <= 1) return parts;
  std::vector<Copy>& copies = parts.copies;
  lattice::ScratchList<Index> copy_of_root(components.size(), HybridMesh::none, &scratch);
  parts.copies.reserve(roots);
  parts.copy_of.reserve(components.size());
  for_each_fragment(mesh, node, [&](AncestorId t, std::size_t corner, Index polygon, Index number) {
    const Index root = components.root(number);
    if (copy_of_root[root] == HybridMesh::none) {
      copy_of_root[root] = static_cast<Index>(copies.size());
      copies.push_back(
          {mesh.buffers.triangles[mesh.fragment(t, polygon).index()].nodes[corner], false, root, {}});
    }
    Copy& copy = copies[copy_of_root[root]];
    copy.renders = copy.renders || renders_corner(mesh, t, polygon, corner);
    parts.copy_of.push_back(copy_of_root[root]);
  });
  parts.order.resize(copies.size());
  std::iota(parts.order.begin(), parts.order.end(), Index{0});
  std::sort(parts.order.begin(), parts.order.end(), [&](Index a, Index b) {
    return std::tuple(copies[a].old, !copies[a].renders, copies[a].root) <
           std::tuple(copies[b].old, !copies[b].renders, copies[b].root);
  });
  return parts;
}

/// Makes the copies, and says whether there are any.
bool copy_node(HybridMesh& mesh, AncestorNodeId node, Parts& parts, ChangeLog& log) {
  bool copied = false;
  for (std::size_t i = 0; i < parts.order.size(); ++i) {
    Copy& copy = parts.copies[parts.order[i]];
    if (i == 0 || parts.copies[parts.order[i - 1]].old != copy.old) {
      copy.now = copy.old;
      continue;
    }
    copy.now = NodeId{mesh.buffers.nodes.size()};
    mesh.buffers.nodes.push_back(node);
    mesh.positions.push_back(Eigen::Vector3d(mesh.positions[copy.old.index()]));
    log.nodes.push_back(copy.now.value);
    log.node_copies.push_back({copy.now, copy.old});
    copied = true;
  }
  return copied;
}

/// Gives fragments around the node their copies.
void give_copies(HybridMesh& mesh, AncestorNodeId node, Parts& parts) {
  for_each_fragment(mesh, node, [&](AncestorId t, std::size_t corner, Index polygon, Index number) {
    const TriangleId triangle = mesh.fragment(t, polygon);
    NodeId& now = mesh.buffers.triangles[triangle.index()].nodes[corner];
    if (now == parts.copies[parts.copy_of[number]].now) return;
    now = parts.copies[parts.copy_of[number]].now;
    parts.changed.push_back(triangle);
  });
}

/// Two nodes that a spring joins, in the direction of its edge.
using Pair = std::array<NodeId, 2>;

/// What an edge's springs lack.
struct EdgeSprings {
  std::vector<Pair> wanted;                    ///< pairs that have no spring
  std::vector<std::pair<Pair, SpringId>> old;  ///< all springs, and ...
  std::vector<SpringId> idle;                  ///< ... those whose pair is gone
};

EdgeSprings springs_of(const HybridMesh& mesh, AncestorEdgeId e) {
  EdgeSprings result;
  std::vector<Pair>& wanted = result.wanted;
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
  const auto look_at = [&](SpringId s) {
    const Pair& pair = result.old.emplace_back(mesh.buffers.springs[s.index()].nodes, s).first;
    const auto found = std::find(wanted.begin(), wanted.end(), pair);
    if (found == wanted.end())
      result.idle.push_back(s);
    else
      wanted.erase(found);
  };
  if (const EdgeState* state = mesh.edge_state(e))
    for (const SpringId s : state->springs) look_at(s);
  else
    look_at(SpringId{e.index()});
  return result;
}

}  // namespace

void copy_physics_nodes(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                        ChangeLog& log) {
  std::vector<Parts> parts(nodes.size());
  executor.for_each(nodes.size(), [&](std::size_t i) { parts[i] = parts_of(mesh, nodes[i]); });
  for (std::size_t i = 0; i < nodes.size(); ++i) parts[i].copied = copy_node(mesh, nodes[i], parts[i], log);
  executor.for_each(nodes.size(), [&](std::size_t i) {
    if (parts[i].copied) give_copies(mesh, nodes[i], parts[i]);
  });
  for (const Parts& part : parts)
    for (const TriangleId t : part.changed) log.triangles.push_back(t.value);
}

void update_springs(HybridMesh& mesh, const std::vector<AncestorNodeId>& nodes, const Executor& executor,
                    ChangeLog& log) {
  std::vector<AncestorEdgeId> edges;
  for (const AncestorNodeId n : nodes)
    for (const AncestorId t : mesh.ancestors.triangles_around(n))
      for (const std::size_t corner = mesh.ancestors.local_node(t, n);
           const std::size_t i : {corner, last_corner(corner)})
        edges.push_back(mesh.ancestors.triangles[t.index()].edges[i]);
  lattice::sort_unique(edges);

  std::vector<EdgeSprings> all(edges.size());
  executor.for_each(edges.size(), [&](std::size_t i) { all[i] = springs_of(mesh, edges[i]); });

  auto& springs = mesh.buffers.springs;
  const std::size_t first_copy = mesh.buffers.nodes.size() - log.node_copies.size();
  const auto before_cut = [&](NodeId n) {
    return n.index() < first_copy ? n : log.node_copies[n.index() - first_copy].source;
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    auto& [wanted, old, idle] = all[i];
    if (wanted.empty() && idle.empty()) continue;
    EdgeState& state = edge_state_for_writing(mesh, edges[i]);
    // The first pair that comes from that of an idle spring gets its entry.
    for (const Pair& pair : wanted) {
      const auto source = std::find_if(old.begin(), old.end(), [&](const auto& spring) {
                            return spring.first == Pair{before_cut(pair[0]), before_cut(pair[1])};
                          })->second;
      SpringId s = source;
      if (const auto entry = std::find(idle.begin(), idle.end(), source); entry != idle.end()) {
        idle.erase(entry);
        springs[s.index()].nodes = pair;
      } else {
        s = SpringId{springs.size()};
        springs.push_back({pair, edges[i]});
        state.springs.push_back(s);
        log.spring_copies.push_back({s, source});
      }
      log.springs.push_back(s.value);
    }
    for (const SpringId s : idle) {
      springs[s.index()] = Spring{};
      log.springs.push_back(s.value);
      state.springs.erase(std::find(state.springs.begin(), state.springs.end(), s));
    }
  }
}

}  // namespace cut

// Builds the hybrid mesh of an uncut cloth (§3.2): checks the input, finds edges and neighbours, splits nodes
// at which the surface only touches itself, and lays out the flat buffers. In: TriangleMesh. Out: HybridMesh
// or the first Error.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "cut/hybrid_mesh.hpp"
#include "lattice/components.hpp"
#include "mesh/state.hpp"
#include "mesh/vector3.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

/// One side of an input triangle, filed under the smaller of its two nodes.
struct Side {
  Index other;     ///< the larger node
  Index triangle;  ///< input triangle
  Index corner;    ///< input corner that the side starts at
};

std::string name_triangle(std::size_t i) { return "triangle " + std::to_string(i); }

/// Checks that need no connectivity. Returns whether all is well; otherwise fills `error`.
bool check_elements(const TriangleMesh& mesh, Error& error) {
  if (mesh.triangles.empty()) {
    error = {Error::Kind::empty_mesh, "the mesh has no triangles", 0};
    return false;
  }
  constexpr std::size_t limit = 1u << 30;
  if (mesh.positions.size() >= limit || mesh.triangles.size() >= limit) {
    error = {Error::Kind::too_large, "the mesh has more than 2^30 points or triangles", 0};
    return false;
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].allFinite() && mesh.positions[i].cwiseAbs().maxCoeff() < largest_coordinate)
      continue;
    error = {Error::Kind::not_finite,
             "point " + std::to_string(i) + " has a coordinate that is NaN, infinite or beyond 1e50", i};
    return false;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (const Index node : t) {
      if (node < mesh.positions.size()) continue;
      error = {Error::Kind::index_out_of_range,
               name_triangle(i) + " names point " + std::to_string(node) + ", but there are only " +
                   std::to_string(mesh.positions.size()),
               i};
      return false;
    }
    if (has_area(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]])) continue;
    error = {Error::Kind::degenerate_triangle, name_triangle(i) + " has no area", i};
    return false;
  }
  return true;
}

/// By node, then by triangle. Most buckets hold three sides, for which calling a sort costs more than
/// sorting.
void sort_sides(Side* begin, Side* end) {
  const auto less = [](const Side& a, const Side& b) {
    return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
  };
  if (end - begin > 16) return std::sort(begin, end, less);
  for (Side* i = begin; i != end; ++i)
    for (Side* j = i; j != begin && less(*j, j[-1]); --j) std::swap(*j, j[-1]);
}

/// All sides, bucketed by their smaller node and sorted within each bucket.
struct Sides {
  std::vector<Index> first;  ///< per node (+1)
  std::vector<Side> sides;
};

Sides collect_sides(const TriangleMesh& mesh) {
  Sides result;
  result.first.assign(mesh.positions.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++result.first[std::min(t[k], t[next_corner(k)]) + 1];
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.sides.resize(3 * mesh.triangles.size());
  std::vector<Index> fill(result.first.begin(), result.first.end() - 1);
  for (Index i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (Index k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[next_corner(k)]);
      result.sides[fill[low]++] = {high, i, k};
    }
  }
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    sort_sides(result.sides.data() + result.first[n], result.sides.data() + result.first[n + 1]);
  return result;
}

/// Tells a triangle that is there twice from an edge with too many triangles.
Error too_many_sides(const TriangleMesh& mesh, const Side* begin, const Side* end, Index low) {
  for (const Side* a = begin; a != end; ++a)
    for (const Side* b = a + 1; b != end; ++b)
      if (mesh.triangles[a->triangle][last_corner(a->corner)] ==
          mesh.triangles[b->triangle][last_corner(b->corner)])
        return {Error::Kind::duplicate_triangle,
                name_triangle(b->triangle) + " has the same corners as " + name_triangle(a->triangle),
                b->triangle};
  return {Error::Kind::non_manifold_edge,
          "the edge between points " + std::to_string(low) + " and " + std::to_string(begin->other) +
              " belongs to " + std::to_string(end - begin) +
              " triangles (a cloth may have two at an edge): the first is " + name_triangle(begin->triangle),
          begin->triangle};
}

bool smaller_position(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Turns each triangle so that it starts at its smallest corner.
void choose_corners(const TriangleMesh& mesh, AncestorMesh& ancestors) {
  ancestors.input_corner.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    std::size_t first = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (smaller_position(mesh.positions[corners[k]], mesh.positions[corners[first]])) first = k;
    ancestors.input_corner[t] = static_cast<std::uint8_t>(first);
  }
}

/// Joins sides with the same two nodes to edges, and wedges that share an edge to fans. Wedge 3·t + k is
/// corner k of input triangle t. Edges get their nodes by input number. Returns whether all is well;
/// otherwise fills `error`.
bool find_edges(const TriangleMesh& mesh, AncestorMesh& ancestors, lattice::Components& fans, Error& error) {
  const Sides sides = collect_sides(mesh);
  const auto wedge_at = [&](const Side& s, Index node) {
    return 3 * s.triangle + (mesh.triangles[s.triangle][s.corner] == node
                                 ? s.corner
                                 : static_cast<Index>(next_corner(s.corner)));
  };
  ancestors.triangles.resize(mesh.triangles.size());
  ancestors.edges.reserve(mesh.triangles.size() + mesh.triangles.size() / 2 + mesh.positions.size() / 4);
  for (Index low = 0; low < mesh.positions.size(); ++low) {
    const Side* const bucket_end = sides.sides.data() + sides.first[low + 1];
    for (const Side* a = sides.sides.data() + sides.first[low]; a != bucket_end;) {
      const Side* end = a + 1;
      while (end != bucket_end && end->other == a->other) ++end;
      const bool paired = end - a == 2;
      if (end - a > 2 || (paired && mesh.triangles[a->triangle][last_corner(a->corner)] ==
                                        mesh.triangles[a[1].triangle][last_corner(a[1].corner)])) {
        error = too_many_sides(mesh, a, end, low);
        return false;
      }
      const AncestorEdgeId id{ancestors.edges.size()};
      AncestorEdge& edge = ancestors.edges.emplace_back();
      edge.nodes = {AncestorNodeId{low}, AncestorNodeId{a->other}};
      if (smaller_position(mesh.positions[a->other], mesh.positions[low]))
        std::swap(edge.nodes[0], edge.nodes[1]);
      for (std::size_t side = 0; a != end; ++a, ++side) {
        edge.triangles[side] = AncestorId{a->triangle};
        ancestors.triangles[a->triangle].edges[(a->corner + 3 - ancestors.input_corner[a->triangle]) % 3] =
            id;
      }
      if (paired)
        for (const Index node : {low, end[-1].other})
          fans.join(wedge_at(end[-2], node), wedge_at(end[-1], node));
    }
  }
  return true;
}

/// Gives each fan of triangles around an input node a node of its own, appended to `ancestors`, and fills in
/// the nodes of triangles and edges.
void split_fans(const TriangleMesh& mesh, lattice::Components& fans, AncestorMesh& ancestors) {
  ancestors.rest_positions = mesh.positions;
  ancestors.input_node.resize(mesh.positions.size());
  std::iota(ancestors.input_node.begin(), ancestors.input_node.end(), Index{0});
  std::vector<std::uint8_t> taken(mesh.positions.size(), 0);
  std::vector<Index> node_of(3 * mesh.triangles.size());  // per wedge
  for (Index w = 0; w < node_of.size(); ++w) {
    const Index root = fans.root(w);  // the first wedge of the fan
    if (root != w) {
      node_of[w] = node_of[root];
    } else if (const Index input = mesh.triangles[w / 3][w % 3]; taken[input] == 0) {
      node_of[w] = input;
      taken[input] = 1;
    } else {
      node_of[w] = static_cast<Index>(ancestors.rest_positions.size());
      ancestors.rest_positions.push_back(mesh.positions[input]);
      ancestors.input_node.push_back(input);
    }
    const std::size_t k = (w % 3 + 3 - ancestors.input_corner[w / 3]) % 3;
    ancestors.triangles[w / 3].nodes[k] = AncestorNodeId{node_of[w]};
  }
  if (ancestors.rest_positions.size() == mesh.positions.size()) return;
  for (AncestorEdge& edge : ancestors.edges)
    for (AncestorNodeId& node : edge.nodes) {
      const auto& corners = ancestors.triangles[edge.triangles[0].index()].nodes;
      node = *std::find_if(corners.begin(), corners.end(),
                           [&](AncestorNodeId n) { return ancestors.input_node[n.index()] == node.value; });
    }
}

void fill_incidences(AncestorMesh& ancestors) {
  ancestors.first_incidence.assign(ancestors.rest_positions.size() + 1, 0);
  for (const Ancestor& t : ancestors.triangles)
    for (const AncestorNodeId n : t.nodes) ++ancestors.first_incidence[n.index() + 1];
  std::partial_sum(ancestors.first_incidence.begin(), ancestors.first_incidence.end(),
                   ancestors.first_incidence.begin());
  ancestors.incidences.resize(3 * ancestors.triangles.size());
  std::vector<Index> fill(ancestors.first_incidence.begin(), ancestors.first_incidence.end() - 1);
  for (std::size_t i = 0; i < ancestors.triangles.size(); ++i)
    for (const AncestorNodeId n : ancestors.triangles[i].nodes)
      ancestors.incidences[fill[n.index()]++] = AncestorId{i};
}

/// Room for an eighth more: the first cut then appends to the buffers without moving all of them.
template <class T>
void resize_with_room(std::vector<T>& items, std::size_t size) {
  items.reserve(size + size / 8 + 64);
  items.resize(size);
}

/// One physics triangle, one render triangle and their nodes, springs and vertices for each ancestor.
void fill_buffers(HybridMesh& mesh) {
  const AncestorMesh& ancestors = mesh.ancestors;
  const std::size_t nodes = ancestors.rest_positions.size();
  Buffers& buffers = mesh.buffers;
  resize_with_room(buffers.nodes, nodes);
  resize_with_room(buffers.render_vertices, nodes);
  for (std::size_t n = 0; n < nodes; ++n) {
    buffers.nodes[n] = AncestorNodeId{n};
    const auto around = ancestors.triangles_around(AncestorNodeId{n});
    if (around.empty()) {
      mesh.free_render_vertices.emplace_back(n);
      continue;
    }
    const auto& corners = ancestors.triangles[around[0].index()].nodes;
    RenderVertex& vertex = buffers.render_vertices[n];
    vertex.triangle = TriangleId{around[0].index()};
    for (std::size_t k = 0; k < 3; ++k) vertex.nodes[k] = NodeId{corners[k].index()};
    vertex.point = lattice_corner(ancestors.local_node(around[0], AncestorNodeId{n}));
  }
  resize_with_room(buffers.triangles, ancestors.triangles.size());
  resize_with_room(buffers.render_triangles, ancestors.triangles.size());
  for (std::size_t t = 0; t < ancestors.triangles.size(); ++t) {
    buffers.triangles[t].ancestor = AncestorId{t};
    buffers.render_triangles[t].triangle = TriangleId{t};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = ancestors.triangles[t].nodes[k].index();
      buffers.triangles[t].nodes[k] = NodeId{node};
      buffers.render_triangles[t].vertices[k] = RenderVertexId{node};
    }
  }
  resize_with_room(buffers.springs, ancestors.edges.size());
  for (std::size_t e = 0; e < ancestors.edges.size(); ++e) {
    const auto& ends = ancestors.edges[e].nodes;
    buffers.springs[e] = {{NodeId{ends[0].index()}, NodeId{ends[1].index()}}, AncestorEdgeId{e}};
  }
  resize_with_room(mesh.positions, nodes);
  std::copy(ancestors.rest_positions.begin(), ancestors.rest_positions.end(), mesh.positions.begin());
  mesh.arrangement_of.assign(ancestors.triangles.size(), HybridMesh::none);
  mesh.edge_state_of.assign(ancestors.edges.size(), HybridMesh::none);
  mesh.node_stamps.assign(nodes, 0);
}

}  // namespace

Result<HybridMesh> HybridMesh::build(const TriangleMesh& input) {
  Error error{};
  if (!check_elements(input, error)) return error;
  HybridMesh mesh;
  AncestorMesh& ancestors = mesh.ancestors;
  choose_corners(input, ancestors);
  lattice::Components fans(3 * input.triangles.size());  // of wedges
  if (!find_edges(input, ancestors, fans, error)) return error;
  split_fans(input, fans, ancestors);
  fill_incidences(ancestors);
  fill_buffers(mesh);
  mesh.state = new_state();
  return mesh;
}

}  // namespace cut

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
    if (mesh.positions[i].allFinite() && mesh.positions[i].cwiseAbs().maxCoeff() < 1e100) continue;
    error = {Error::Kind::not_finite,
             "point " + std::to_string(i) + " has a coordinate that is NaN, infinite or beyond 1e100", i};
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
    const Eigen::Vector3d a = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Eigen::Vector3d b = mesh.positions[t[2]] - mesh.positions[t[0]];
    if (squared_length(cross(a, b)) > 0) continue;
    error = {Error::Kind::degenerate_triangle, name_triangle(i) + " has no area", i};
    return false;
  }
  return true;
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
    std::sort(result.sides.begin() + result.first[n], result.sides.begin() + result.first[n + 1],
              [](const Side& a, const Side& b) {
                return std::tie(a.other, a.triangle) < std::tie(b.other, b.triangle);
              });
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

/// Gives each fan of triangles around an input node a node of its own. Wedge 3·t + k is corner k of input
/// triangle t. Returns the node of each wedge; appends the additional nodes to `ancestors`.
std::vector<Index> split_fans(const TriangleMesh& mesh, lattice::Components& fans, AncestorMesh& ancestors) {
  const std::size_t wedges = 3 * mesh.triangles.size();
  std::vector<Index> node_of_root(wedges, HybridMesh::none);
  std::vector<std::uint8_t> taken(mesh.positions.size(), 0);
  std::vector<Index> node_of(wedges);
  for (Index w = 0; w < wedges; ++w) {
    const Index root = fans.root(w);
    Index& node = node_of_root[root];
    if (node == HybridMesh::none) {
      const Index input = mesh.triangles[w / 3][w % 3];
      if (taken[input] == 0) {
        node = input;
        taken[input] = 1;
      } else {
        node = static_cast<Index>(ancestors.rest_positions.size());
        ancestors.rest_positions.push_back(mesh.positions[input]);
        ancestors.input_node.push_back(input);
      }
    }
    node_of[w] = node;
  }
  return node_of;
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

/// One physics triangle, one render triangle and their nodes, springs and vertices for each ancestor.
void fill_buffers(HybridMesh& mesh) {
  const AncestorMesh& ancestors = mesh.ancestors;
  const std::size_t nodes = ancestors.rest_positions.size();
  Buffers& buffers = mesh.buffers;
  buffers.nodes.resize(nodes);
  buffers.render_vertices.resize(nodes);
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
  buffers.triangles.resize(ancestors.triangles.size());
  buffers.render_triangles.resize(ancestors.triangles.size());
  for (std::size_t t = 0; t < ancestors.triangles.size(); ++t) {
    buffers.triangles[t].ancestor = AncestorId{t};
    buffers.render_triangles[t].triangle = TriangleId{t};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = ancestors.triangles[t].nodes[k].index();
      buffers.triangles[t].nodes[k] = NodeId{node};
      buffers.render_triangles[t].vertices[k] = RenderVertexId{node};
    }
  }
  buffers.springs.resize(ancestors.edges.size());
  for (std::size_t e = 0; e < ancestors.edges.size(); ++e) {
    const auto& ends = ancestors.edges[e].nodes;
    buffers.springs[e] = {{NodeId{ends[0].index()}, NodeId{ends[1].index()}}, AncestorEdgeId{e}};
  }
  mesh.positions = ancestors.rest_positions;
  mesh.arrangement_of.assign(ancestors.triangles.size(), HybridMesh::none);
  mesh.edge_state_of.assign(ancestors.edges.size(), HybridMesh::none);
  mesh.node_stamps.assign(nodes, 0);
}

}  // namespace

Result<HybridMesh> HybridMesh::build(const TriangleMesh& input) {
  Error error{};
  if (!check_elements(input, error)) return error;
  const Sides sides = collect_sides(input);

  // Edges: groups of sides with the same two nodes.
  lattice::Components fans(3 * input.triangles.size());  // of wedges
  const auto wedge_at = [&](const Side& s, Index node) {
    return 3 * s.triangle + (input.triangles[s.triangle][s.corner] == node
                                 ? s.corner
                                 : static_cast<Index>(next_corner(s.corner)));
  };
  std::vector<Index> edge_of_side(3 * input.triangles.size());
  std::vector<std::array<Index, 2>> edge_sides;  // the wedge numbers 3·t + k of the sides of each edge
  edge_sides.reserve(2 * input.triangles.size());
  for (Index low = 0; low < input.positions.size(); ++low) {
    const Side* const bucket_end = sides.sides.data() + sides.first[low + 1];
    for (const Side* a = sides.sides.data() + sides.first[low]; a != bucket_end;) {
      const Side* end = a + 1;
      while (end != bucket_end && end->other == a->other) ++end;
      const bool paired = end - a == 2;
      if (end - a > 2 || (paired && input.triangles[a->triangle][last_corner(a->corner)] ==
                                        input.triangles[a[1].triangle][last_corner(a[1].corner)]))
        return too_many_sides(input, a, end, low);
      const auto edge = static_cast<Index>(edge_sides.size());
      edge_sides.push_back({3 * a->triangle + a->corner, none});
      edge_of_side[3 * a->triangle + a->corner] = edge;
      if (paired) {
        edge_sides.back()[1] = 3 * a[1].triangle + a[1].corner;
        edge_of_side[3 * a[1].triangle + a[1].corner] = edge;
        for (const Index node : {low, a->other}) fans.join(wedge_at(a[0], node), wedge_at(a[1], node));
      }
      a = end;
    }
  }

  HybridMesh mesh;
  AncestorMesh& ancestors = mesh.ancestors;
  ancestors.rest_positions = input.positions;
  ancestors.input_node.resize(input.positions.size());
  std::iota(ancestors.input_node.begin(), ancestors.input_node.end(), Index{0});
  const std::vector<Index> node_of = split_fans(input, fans, ancestors);

  ancestors.triangles.resize(input.triangles.size());
  ancestors.input_corner.resize(input.triangles.size());
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    const auto& corners = input.triangles[t];
    std::size_t first = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (smaller_position(input.positions[corners[k]], input.positions[corners[first]])) first = k;
    ancestors.input_corner[t] = static_cast<std::uint8_t>(first);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t side = 3 * t + (first + k) % 3;
      ancestors.triangles[t].nodes[k] = AncestorNodeId{node_of[side]};
      ancestors.triangles[t].edges[k] = AncestorEdgeId{edge_of_side[side]};
    }
  }
  ancestors.edges.resize(edge_sides.size());
  for (std::size_t e = 0; e < edge_sides.size(); ++e) {
    const Index side = edge_sides[e][0];
    const Index next = side / 3 * 3 + static_cast<Index>(next_corner(side % 3));
    std::array<AncestorNodeId, 2> ends{AncestorNodeId{node_of[side]}, AncestorNodeId{node_of[next]}};
    if (smaller_position(ancestors.rest_positions[ends[1].index()],
                         ancestors.rest_positions[ends[0].index()]))
      std::swap(ends[0], ends[1]);
    ancestors.edges[e].nodes = ends;
    for (std::size_t k = 0; k < 2; ++k)
      if (edge_sides[e][k] != none) ancestors.edges[e].triangles[k] = AncestorId{edge_sides[e][k] / 3};
  }
  fill_incidences(ancestors);
  fill_buffers(mesh);
  return mesh;
}

}  // namespace cut

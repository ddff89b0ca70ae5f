// Pieces of the render mesh. In: the render arrays. Out: components with area and topology.
#include "cut/pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "lattice/components.hpp"

namespace cut {
namespace {

using Index = std::uint32_t;

Eigen::Vector3d rest_position(const HybridMesh& mesh, const RenderVertex& v) {
  const Ancestor& ancestor =
      mesh.ancestors.triangles[mesh.buffers.triangles[v.triangle.index()].ancestor.index()];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    sum += mesh.ancestors.rest_positions[ancestor.nodes[i].index()] *
           (static_cast<double>(v.point[i]) / lattice_size);
  return sum;
}

double area(const std::array<Eigen::Vector3d, 3>& p) { return (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2; }

/// The two ends of a side, in either direction.
std::pair<Index, Index> side(const RenderTriangle& t, std::size_t i) {
  return std::minmax({t.vertices[i].value, t.vertices[next_corner(i)].value});
}

/// Numbers the components by their first triangle and adds up areas, triangles and vertices.
void collect(const HybridMesh& mesh, lattice::Components& vertices, Pieces& result) {
  const Buffers& b = mesh.buffers;
  std::vector<Index> piece_of_root(mesh.buffers.render_vertices.size(), Pieces::none);
  for (std::size_t i = 0; i < b.render_triangles.size(); ++i) {
    const RenderTriangle& t = b.render_triangles[i];
    if (!t.triangle.valid()) continue;
    Index& piece = piece_of_root[vertices.root(t.vertices[0].value)];
    if (piece == Pieces::none) {
      piece = static_cast<Index>(result.list.size());
      result.list.emplace_back();
    }
    result.of_triangle[i] = piece;
    std::array<Eigen::Vector3d, 3> rest;
    std::array<Eigen::Vector3d, 3> now;
    for (std::size_t k = 0; k < 3; ++k) {
      const RenderVertex& v = b.render_vertices[t.vertices[k].index()];
      rest[k] = rest_position(mesh, v);
      now[k] = mesh.position(v);
    }
    Piece& p = result.list[piece];
    p.rest_area += area(rest);
    p.area += area(now);
    ++p.triangles;
    ++p.euler_characteristic;
    for (const RenderVertexId v : t.vertices) {
      if (result.of_vertex[v.index()] != Pieces::none) continue;
      result.of_vertex[v.index()] = piece;
      ++p.euler_characteristic;
    }
  }
}

/// Counts sides, and the closed curves that sides with one triangle form.
void count_sides(const HybridMesh& mesh, Pieces& result) {
  std::vector<std::pair<Index, Index>> sides;
  for (const RenderTriangle& t : mesh.buffers.render_triangles)
    for (std::size_t i = 0; t.triangle.valid() && i < 3; ++i) sides.push_back(side(t, i));
  std::sort(sides.begin(), sides.end());
  lattice::Components loops(mesh.buffers.render_vertices.size());
  std::vector<std::uint8_t> on_boundary(loops.size(), 0);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end] == sides[i]) ++end;
    --result.list[result.of_vertex[sides[i].first]].euler_characteristic;
    if (end - i == 1) {
      loops.join(sides[i].first, sides[i].second);
      on_boundary[sides[i].first] = on_boundary[sides[i].second] = 1;
    }
    i = end;
  }
  for (Index v = 0; v < loops.size(); ++v)
    if (on_boundary[v] != 0 && loops.root(v) == v) ++result.list[result.of_vertex[v]].boundary_loops;
}

void sort_by_size(Pieces& result) {
  std::vector<Index> order(result.list.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return result.list[a].rest_area > result.list[b].rest_area; });
  std::vector<Index> rank(order.size());
  std::vector<Piece> sorted;
  for (Index i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    sorted.push_back(result.list[order[i]]);
  }
  result.list = std::move(sorted);
  for (auto* indices : {&result.of_triangle, &result.of_vertex})
    for (Index& piece : *indices)
      if (piece != Pieces::none) piece = rank[piece];
}

}  // namespace

Pieces pieces(const HybridMesh& mesh) {
  const Buffers& b = mesh.buffers;
  Pieces result;
  result.of_triangle.assign(b.render_triangles.size(), Pieces::none);
  result.of_vertex.assign(b.render_vertices.size(), Pieces::none);
  lattice::Components vertices(b.render_vertices.size());
  for (const RenderTriangle& t : b.render_triangles) {
    if (!t.triangle.valid()) continue;
    vertices.join(t.vertices[0].value, t.vertices[1].value);
    vertices.join(t.vertices[0].value, t.vertices[2].value);
  }
  collect(mesh, vertices, result);
  count_sides(mesh, result);
  sort_by_size(result);
  return result;
}

}  // namespace cut

// The render mesh with attributes; see the header.
#include "snip/rendered_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace snip {
namespace {

// A render vertex seen from an input triangle: the share of each of the triangle's corners, in lattice units.
using Shares = std::array<std::int32_t, 3>;

// Shares by corners of the input, for a vertex that lies in or at the edge of physics triangle t: what is
// nodes[k] to the vertex is some corner of t, since neighbours share the nodes of their common edge.
Shares shares_in(const cut::HybridMesh& hybrid, const cut::RenderVertex& vertex, cut::TriangleId t) {
  const cut::PhysicsTriangle& triangle = hybrid.buffers.triangles[t.index()];
  const std::size_t turn = hybrid.ancestors.input_corner[triangle.ancestor.index()];
  Shares shares{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (vertex.point[k] == 0) continue;
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (triangle.nodes[corner] == vertex.nodes[k]) shares[(corner + turn) % 3] = vertex.point[k];
  }
  return shares;
}

// One kind of attribute by corner: UV or normals. Values of the input keep their index, interpolated ones
// are appended, once for each place that has the same value.
template <class Value>
class CornerAttribute {
 public:
  CornerAttribute(const std::vector<Value>& values, const std::vector<Triangle>& triangles)
      : values_(values), input_triangles_(triangles) {}

  void add_triangle() {
    if (!input_triangles_.empty()) triangles_.push_back({no_index, no_index, no_index});
  }

  template <class Finish>
  void set_corner(std::size_t k, std::size_t input_triangle, const Shares& shares, Finish finish) {
    if (input_triangles_.empty()) return;
    // By increasing index, so that both triangles at an edge come to the same bits.
    std::array<std::pair<std::uint32_t, std::int32_t>, 3> terms{};
    std::size_t count = 0;
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (shares[corner] != 0) terms[count++] = {input_triangles_[input_triangle][corner], shares[corner]};
    std::sort(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 0 || terms[count - 1].first == no_index) return;
    std::uint32_t& index = triangles_.back()[k];
    if (count == 1) {
      index = terms[0].first;
      return;
    }
    const auto [entry, is_new] = interpolated_.try_emplace(terms, static_cast<std::uint32_t>(values_.size()));
    index = entry->second;
    if (!is_new) return;
    Value sum = Value::Zero();
    for (std::size_t i = 0; i < count; ++i)
      sum += values_[terms[i].first] * (static_cast<double>(terms[i].second) / cut::lattice_size);
    values_.push_back(finish(sum));
  }

  void move_to(std::vector<Value>& values, std::vector<Triangle>& triangles) {
    values = std::move(values_);
    triangles = std::move(triangles_);
  }

 private:
  std::vector<Value> values_;
  const std::vector<Triangle>& input_triangles_;
  std::vector<Triangle> triangles_;
  std::map<std::array<std::pair<std::uint32_t, std::int32_t>, 3>, std::uint32_t> interpolated_;
};

std::array<double, 4> interpolated_colour(const Mesh& input, const Triangle& triangle, const Shares& shares) {
  std::array<double, 4> colour{};
  for (std::size_t corner = 0; corner < 3; ++corner)
    if (shares[corner] != 0)
      for (std::size_t channel = 0; channel < 4; ++channel)
        colour[channel] += input.colours.values[triangle[corner]][channel] *
                           (static_cast<double>(shares[corner]) / cut::lattice_size);
  return colour;
}

}  // namespace

Mesh rendered_mesh(const Mesh& input, const cut::HybridMesh& hybrid) {
  const cut::Buffers& buffers = hybrid.buffers;
  Mesh mesh;
  mesh.polygon_count = input.polygon_count;
  mesh.colours.types = input.colours.types;

  std::vector<std::uint32_t> index_of(buffers.render_vertices.size(), no_index);
  for (std::size_t v = 0; v < buffers.render_vertices.size(); ++v) {
    const cut::RenderVertex& vertex = buffers.render_vertices[v];
    if (!vertex.triangle.valid()) continue;
    index_of[v] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(hybrid.position(vertex));
    if (input.colours.empty()) continue;
    const std::size_t ancestor = buffers.triangles[vertex.triangle.index()].ancestor.index();
    mesh.colours.values.push_back(
        interpolated_colour(input, input.triangles[ancestor], shares_in(hybrid, vertex, vertex.triangle)));
  }

  CornerAttribute uvs(input.uvs, input.uv_triangles);
  CornerAttribute normals(input.normals, input.normal_triangles);
  for (const cut::RenderTriangle& triangle : buffers.render_triangles) {
    if (!triangle.triangle.valid()) continue;
    const std::size_t ancestor = buffers.triangles[triangle.triangle.index()].ancestor.index();
    mesh.polygon_of_triangle.push_back(input.polygon_of_triangle[ancestor]);
    mesh.triangles.emplace_back();
    uvs.add_triangle();
    normals.add_triangle();
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.triangles.back()[k] = index_of[triangle.vertices[k].index()];
      const Shares shares =
          shares_in(hybrid, buffers.render_vertices[triangle.vertices[k].index()], triangle.triangle);
      uvs.set_corner(k, ancestor, shares, [](const Eigen::Vector2d& uv) { return uv; });
      normals.set_corner(k, ancestor, shares, [](const Eigen::Vector3d& n) { return n.stableNormalized(); });
    }
  }
  uvs.move_to(mesh.uvs, mesh.uv_triangles);
  normals.move_to(mesh.normals, mesh.normal_triangles);
  return mesh;
}

}  // namespace snip

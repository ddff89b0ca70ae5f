// FNV-1a and the order in which the parts of a mesh are hashed. See hash.hpp.
#include "hash.hpp"

#include <bit>

namespace hashes {
namespace {

template <class Tag>
void add(Hash& hash, cut::Id<Tag> id) {
  hash.add(std::uint64_t{id.value});
}

template <class Ids>
void add_ids(Hash& hash, const Ids& ids) {
  for (const auto id : ids) add(hash, id);
}

void add(Hash& hash, cut::LatticePoint p) {
  hash.add(static_cast<std::uint64_t>(p.x));
  hash.add(static_cast<std::uint64_t>(p.y));
}

void add(Hash& hash, const cut::AncestorMesh& ancestors) {
  for (const cut::Ancestor& triangle : ancestors.triangles) {
    add_ids(hash, triangle.nodes);
    add_ids(hash, triangle.edges);
  }
  for (const cut::AncestorEdge& edge : ancestors.edges) {
    add_ids(hash, edge.nodes);
    add_ids(hash, edge.triangles);
  }
}

void add(Hash& hash, const cut::Buffers& buffers) {
  add_ids(hash, buffers.nodes);
  for (const cut::PhysicsTriangle& triangle : buffers.triangles) {
    add_ids(hash, triangle.nodes);
    add(hash, triangle.ancestor);
  }
  for (const cut::Spring& spring : buffers.springs) {
    add_ids(hash, spring.nodes);
    add(hash, spring.edge);
  }
  for (const cut::RenderVertex& vertex : buffers.render_vertices) {
    add(hash, vertex.triangle);
    add_ids(hash, vertex.nodes);
    add(hash, vertex.point);
  }
  for (const cut::RenderTriangle& triangle : buffers.render_triangles) {
    add_ids(hash, triangle.vertices);
    add(hash, triangle.triangle);
  }
}

void add(Hash& hash, const cut::Arrangement& arrangement) {
  for (const cut::ArrangementNode& node : arrangement.nodes) add(hash, node.point);
  for (const cut::CutEdge& edge : arrangement.edges)
    for (const std::uint32_t part : {edge.from, edge.to, edge.left, edge.right})
      hash.add(std::uint64_t{part});
  for (const cut::RenderPolygon& polygon : arrangement.polygons) {
    add(hash, polygon.triangle);
    for (const cut::PolygonCorner& corner : polygon.corners) hash.add(std::uint64_t{corner.node});
    for (const std::uint32_t end : polygon.loop_ends) hash.add(std::uint64_t{end});
  }
}

void add(Hash& hash, const cut::EdgeState& edge) {
  for (const cut::BoundaryNode& node : edge.nodes) hash.add(static_cast<std::uint64_t>(node.t));
  for (const std::uint8_t cut : edge.cut) hash.add(std::uint64_t{cut});
}

}  // namespace

void Hash::add(std::uint64_t word) {
  for (int shift = 0; shift < 64; shift += 8) value_ = (value_ ^ (word >> shift & 0xff)) * 0x100000001b3u;
}

void Hash::add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

std::uint64_t hash(const cut::TriangleMesh& mesh) {
  Hash result;
  for (const Eigen::Vector3d& position : mesh.positions)
    for (const double coordinate : position) result.add(coordinate);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) result.add(std::uint64_t{corner});
  return result.value();
}

std::uint64_t hash(const cut::HybridMesh& mesh) {
  Hash result;
  add(result, mesh.ancestors);
  add(result, mesh.buffers);
  for (const cut::Arrangement& arrangement : mesh.arrangements) add(result, arrangement);
  for (const cut::EdgeState& edge : mesh.edge_states) add(result, edge);
  return result.value();
}

}  // namespace hashes

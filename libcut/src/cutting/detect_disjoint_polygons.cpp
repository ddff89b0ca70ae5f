#include "cutting/detect_disjoint_polygons.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cutting/work_graph.hpp"
#include "lattice/faces.hpp"
#include "lattice/scratch.hpp"

namespace cut {
namespace {

using lattice::GraphEdge;
using Index = std::uint32_t;

/// Nodes and edges in their final order; edges still carry the old polygons. `graph_edge` tells where each
/// came from.
Arrangement canonical(const TriangleWork& work, std::vector<Index>& graph_edge, lattice::Scratch& scratch) {
  Arrangement result;
  result.boundary_counts = work.boundary_counts;
  const auto& points = work.graph.points;
  const Index first_inner = first_inner_node(work);
  lattice::ScratchList<std::uint8_t> used(points.size(), 0, &scratch);
  for (const GraphEdge& e : work.graph.edges) used[e.from] = used[e.to] = 1;
  lattice::ScratchList<Index> order(&scratch);
  for (Index n = 0; n < points.size(); ++n)
    if (n < first_inner || used[n] != 0) order.push_back(n);
  std::sort(order.begin() + first_inner, order.end(),
            [&](Index a, Index b) { return points[a] < points[b]; });
  lattice::ScratchList<Index> renumbered(points.size(), &scratch);
  result.nodes.reserve(order.size());
  for (const Index n : order) {
    renumbered[n] = static_cast<Index>(result.nodes.size());
    result.nodes.push_back({points[n], work.stamps[n], work.rendered[n] != 0});
  }
  const auto ends = [&](Index i) {
    return std::minmax(renumbered[work.graph.edges[i].from], renumbered[work.graph.edges[i].to]);
  };
  graph_edge.resize(work.graph.edges.size());
  std::iota(graph_edge.begin(), graph_edge.end(), Index{0});
  std::sort(graph_edge.begin(), graph_edge.end(), [&](Index a, Index b) { return ends(a) < ends(b); });
  result.edges.reserve(graph_edge.size());
  for (const Index i : graph_edge) {
    const GraphEdge& e = work.graph.edges[i];
    CutEdge edge{renumbered[e.from], renumbered[e.to], e.left, e.right, e.deviation};
    if (edge.to < edge.from) {
      std::swap(edge.from, edge.to);
      std::swap(edge.left, edge.right);
    }
    result.edges.push_back(edge);
  }
  return result;
}

std::int64_t doubled_area(const Arrangement& arrangement, const RenderPolygon& polygon) {
  std::int64_t area = 0;
  Index begin = 0;
  for (const Index end : polygon.loop_ends) {
    for (Index i = begin, j = end - 1; i < end; j = i++) {
      const LatticePoint a = arrangement.nodes[polygon.corners[j].node].point;
      const LatticePoint b = arrangement.nodes[polygon.corners[i].node].point;
      area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    }
    begin = end;
  }
  return area;
}

}  // namespace

DisjointPolygons detect_disjoint_polygons(const TriangleWork& work) {
  DisjointPolygons result;
  Arrangement& arrangement = result.arrangement;
  lattice::Scratch scratch;
  arrangement = canonical(work, result.graph_edge, scratch);

  lattice::ScratchList<LatticePoint> points(&scratch);
  points.reserve(arrangement.nodes.size());
  for (const ArrangementNode& n : arrangement.nodes) points.push_back(n.point);
  lattice::ScratchList<lattice::FaceEdge> border(&scratch);
  lattice::ScratchList<Index> border_polygon(&scratch);  // in `before`
  for (std::size_t i = 0; i < 3; ++i)
    for (Index k = 0; k <= arrangement.boundary_counts[i]; ++k) {
      border.push_back({arrangement.edge_node(i, k), arrangement.edge_node(i, k + 1)});
      border_polygon.push_back(work.old_section_polygons[i][k]);
    }
  lattice::ScratchList<lattice::FaceEdge> inner(&scratch);
  inner.reserve(arrangement.edges.size());
  for (const CutEdge& e : arrangement.edges) inner.push_back({e.from, e.to});
  lattice::Faces faces = lattice::find_faces(points, border, inner);

  result.parent.assign(faces.faces.size(), HybridMesh::none);
  const auto note_parent = [&](Index half_edge, Index polygon) {
    const Index face = faces.face_of_half_edge[half_edge];
    if (face != HybridMesh::none && result.parent[face] == HybridMesh::none) result.parent[face] = polygon;
  };
  for (Index i = 0; i < border.size(); ++i) note_parent(2 * i, border_polygon[i]);
  const auto first_half_edge = static_cast<Index>(2 * border.size());
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    note_parent(first_half_edge + 2 * i, arrangement.edges[i].left);
    note_parent(first_half_edge + 2 * i + 1, arrangement.edges[i].right);
  }
  for (Index i = 0; i < arrangement.edges.size(); ++i) {
    arrangement.edges[i].left = faces.face_of_half_edge[first_half_edge + 2 * i];
    arrangement.edges[i].right = faces.face_of_half_edge[first_half_edge + 2 * i + 1];
  }
  Index half_edge = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    arrangement.section_polygons[i].reserve(arrangement.boundary_counts[i] + 1);
    for (Index k = 0; k <= arrangement.boundary_counts[i]; ++k, half_edge += 2)
      arrangement.section_polygons[i].push_back(faces.face_of_half_edge[half_edge]);
  }
  result.doubled_area.reserve(faces.faces.size());
  arrangement.polygons.reserve(faces.faces.size());
  for (lattice::Face& face : faces.faces) {
    RenderPolygon polygon;
    polygon.loop_ends = std::move(face.loop_ends);
    polygon.corners.reserve(face.corners.size());
    for (const Index node : face.corners) {
      polygon.corners.push_back({node, {}});
      arrangement.nodes[node].rendered = true;
    }
    result.doubled_area.push_back(doubled_area(arrangement, polygon));
    arrangement.polygons.push_back(std::move(polygon));
  }
  return result;
}

}  // namespace cut

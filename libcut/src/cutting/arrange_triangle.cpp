#include "cutting/arrange_triangle.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cutting/cut_along_segments.hpp"
#include "cutting/merge_adjacent_edges.hpp"
#include "cutting/merge_cut_endpoints.hpp"
#include "cutting/merge_existing_nodes.hpp"
#include "cutting/merge_on_cut_edges.hpp"
#include "cutting/polygon_nodes.hpp"
#include "cutting/work_graph.hpp"
#include "lattice/scratch.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using lattice::GraphEdge;
using Index = std::uint32_t;

/// Sets up the graph: nodes and cuts as before, with the boundary nodes that the sides have now.
/// @return the boundary nodes that are new
std::vector<LatticePoint> lay_out(TriangleWork& work,
                                  const std::array<std::vector<LatticePoint>, 3>& boundary) {
  const Arrangement& before = work.before;
  work.graph = {};
  work.stamps.clear();
  work.rendered.clear();
  std::vector<LatticePoint> fresh;
  lattice::Scratch scratch;
  lattice::ScratchList<Index> renumbered(before.nodes.size(), &scratch);
  // And room for what a line adds.
  const std::size_t room =
      before.nodes.size() + boundary[0].size() + boundary[1].size() + boundary[2].size() + 2;
  work.graph.points.reserve(room);
  work.stamps.reserve(room);
  work.rendered.reserve(room);
  const auto add = [&](const ArrangementNode& node) {
    work.graph.points.push_back(node.point);
    work.stamps.push_back(node.stamp);
    work.rendered.push_back(node.rendered ? 1 : 0);
    return static_cast<Index>(work.graph.points.size() - 1);
  };
  for (Index k = 0; k < 3; ++k) renumbered[k] = add(before.nodes[k]);
  for (std::size_t i = 0; i < 3; ++i) {
    work.boundary_counts[i] = static_cast<Index>(boundary[i].size());
    Index section = 0;  // the old section that we are in
    work.old_section_polygons[i].clear();
    work.old_section_polygons[i].reserve(boundary[i].size() + 1);
    work.old_section_polygons[i].push_back(before.section_polygons[i][0]);
    for (const LatticePoint p : boundary[i]) {
      const Index old = before.edge_node(i, section + 1);
      if (section < before.boundary_counts[i] && before.nodes[old].point == p) {
        renumbered[old] = add(before.nodes[old]);
        ++section;
      } else {
        add({p, 0, false});
        fresh.push_back(p);
      }
      work.old_section_polygons[i].push_back(before.section_polygons[i][section]);
    }
    work.cut_sections[i].assign(boundary[i].size() + 1, 0);
  }
  for (Index n = before.first_inner_node(); n < before.nodes.size(); ++n)
    renumbered[n] = add(before.nodes[n]);
  work.graph.edges.reserve(before.edges.size());
  for (const CutEdge& e : before.edges)
    work.graph.edges.push_back({renumbered[e.from], renumbered[e.to], e.left, e.right, e.deviation, false});
  return fresh;
}

/// Nodes of each polygon in the graph as it is now, and the ends of lines that are nodes already.
PolygonNodes polygon_nodes(const TriangleWork& work, const std::vector<std::array<Index, 3>>& segments) {
  PolygonNodes nodes(work.before.polygons.size());
  for (const GraphEdge& e : work.graph.edges)
    for (const Index polygon : {e.left, e.right}) {
      nodes.add(polygon, e.from);
      nodes.add(polygon, e.to);
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (Index k = 0; k <= work.boundary_counts[i]; ++k) {
      nodes.add(work.old_section_polygons[i][k], side_node(work, i, k));
      nodes.add(work.old_section_polygons[i][k], side_node(work, i, k + 1));
    }
  for (const auto& [a, b, polygon] : segments) {
    nodes.add(polygon, a);
    nodes.add(polygon, b);
  }
  nodes.finish();
  return nodes;
}

/// Nodes that rounding added since.
void extend_node_data(TriangleWork& work) {
  work.stamps.resize(work.graph.points.size(), 0);
  work.rendered.resize(work.graph.points.size(), 0);
}

}  // namespace

bool differs_from_before(const TriangleWork& work) {
  if (work.boundary_counts != work.before.boundary_counts ||
      work.graph.edges.size() != work.before.edges.size())
    return true;
  using Ends = std::pair<LatticePoint, LatticePoint>;
  lattice::Scratch scratch;
  lattice::ScratchList<Ends> now(&scratch);
  lattice::ScratchList<Ends> then(&scratch);
  now.reserve(work.graph.edges.size());
  then.reserve(work.before.edges.size());
  for (const GraphEdge& e : work.graph.edges)
    now.push_back(std::minmax(work.graph.points[e.from], work.graph.points[e.to]));
  for (const CutEdge& e : work.before.edges)
    then.push_back(std::minmax(work.before.nodes[e.from].point, work.before.nodes[e.to].point));
  std::sort(now.begin(), now.end());
  std::sort(then.begin(), then.end());
  return now != then;
}

void arrange_triangle(TriangleWork& work, const std::array<std::vector<LatticePoint>, 3>& boundary,
                      const CutContext& context) {
  const std::vector<LatticePoint> new_boundary_points = lay_out(work, boundary);
  if (!work.lines.empty()) {
    merge_on_cut_edges(work);
    merge_free_endpoints(work, new_boundary_points, context);
    std::sort(work.lines.begin(), work.lines.end(), [](const CuttingLine& l, const CuttingLine& r) {
      return std::tie(l.polygon, l.a.point, l.b.point) < std::tie(r.polygon, r.a.point, r.b.point);
    });
    // Line ends become nodes (§4.5).
    std::vector<std::array<Index, 3>> segments;
    for (const CuttingLine& line : work.lines) {
      const Index a = lattice::insert_node(work.graph, line.a.point);
      const Index b = lattice::insert_node(work.graph, line.b.point);
      extend_node_data(work);
      work.stamps[a] = work.stamps[b] = context.this_cut;
      if (a != b) segments.push_back({std::min(a, b), std::max(a, b), line.polygon});
    }
    lattice::sort_unique(segments);

    const PolygonNodes nodes = polygon_nodes(work, segments);
    std::vector<GraphEdge> new_edges;
    for (const auto& [a, b, polygon] : segments) {
      const std::vector<Index> chain = merge_existing_nodes(work, nodes, polygon, a, b);
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const LatticePoint p = work.graph.points[chain[i]];
        const LatticePoint q = work.graph.points[chain[i + 1]];
        if (const std::size_t side = common_side(p, q); side < 3)
          cut_sections_between(work, side, p, q, polygon);
        else
          new_edges.push_back({chain[i], chain[i + 1], polygon, polygon, 0, true});
        work.stamps[chain[i]] = work.stamps[chain[i + 1]] = context.this_cut;
      }
    }
    lattice::insert_edges(work.graph, std::move(new_edges));
    extend_node_data(work);
    cut_along_segments(work);
    for (const GraphEdge& e : work.graph.edges)  // crossings are part of the cut, too
      if (e.is_new) work.stamps[e.from] = work.stamps[e.to] = context.this_cut;
    merge_adjacent_edges(work);
  }
  work.changed = differs_from_before(work);
}

}  // namespace cut

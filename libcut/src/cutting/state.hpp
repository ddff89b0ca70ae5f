/// @file
/// What flows through the steps of a cut (§4). Each step takes it and adds to it; none looks into another.
///
///   detect_cutting_lines    works with lines, line ends where the cutter meets the triangle
///   merge_cut_endpoints     line ends become nodes, points on physics edges, points on cuts, or stay free
///   meet_ends               ends that were detected near each other go to the same place
///   merge_on_physics_edges  points on physics edges become boundary nodes, the same for both sides
///   arrange_triangle        lines become edges of a planar graph: merge_on_cut_edges,
///                           merge_existing_nodes, lattice::insert_edges (§4.4), cut_along_segments,
///                           merge_adjacent_edges
///   weld_slivers            the graph's faces, crumbs welded: detect_disjoint_polygons
///   copy_physics_triangles  each face becomes a fragment
///   copy_physics_nodes      physics nodes and springs follow
///   copy_boundary_nodes     render vertices follow, then triangulate_polygons
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cut/arrangement.hpp"
#include "cut/hybrid_mesh.hpp"
#include "cut/merge_distances.hpp"
#include "lattice/metric.hpp"
#include "lattice/planar_graph.hpp"

namespace cut {

/// One end of a cutting line, on its triangle.
struct LineEnd {
  enum class On : std::uint8_t {
    nothing,       ///< a free point, or not yet decided
    node,          ///< an existing node: `index` into the arrangement's nodes
    physics_edge,  ///< a point of a side of the triangle, given by `point` itself
    cut_edge       ///< a point of a cut: `index` into the arrangement's edges
  };
  LatticePoint point;
  On on = On::nothing;
  std::uint32_t index = 0;
  LatticePoint detected{};  ///< where it was before it was merged; set by merge_cut_endpoints
  bool passes = false;      ///< the line is led on across the edge here; nodes attract it from δn only
  bool inside = false;      ///< was detected inside of its polygon, on no edge; set by merge_cut_endpoints

  auto operator<=>(const LineEnd&) const = default;
};

/// The part of a cutter triangle's intersection with a physics triangle that lies in its render polygon.
struct CuttingLine {
  std::uint32_t polygon = 0;
  LineEnd a;
  LineEnd b;

  auto operator<=>(const CuttingLine&) const = default;
};

/// A line that goes on in another triangle, to a node there.
struct ContinuedLine {
  AncestorId ancestor;
  CuttingLine line;
};

/// The faces of a work's graph, from detect_disjoint_polygons to copy_physics_triangles.
struct DisjointPolygons {
  /// Complete but for physics triangles, render vertices and render triangles.
  Arrangement arrangement;
  std::vector<std::uint32_t> parent;       ///< per polygon: the polygon of `before` that it was part of
  std::vector<std::uint32_t> graph_edge;   ///< per edge of the arrangement: its index in the work's graph
  std::vector<std::int64_t> doubled_area;  ///< per polygon, in lattice units
};

/// One ancestor that this cut touches.
struct TriangleWork {
  AncestorId ancestor;
  lattice::Metric metric{std::array<double, 3>{}};
  MergeDistances distances;  ///< of this triangle, see local_distances
  Arrangement before;        ///< as the last cut left it; an uncut triangle's is made up
  std::vector<CuttingLine> lines{};
  std::vector<ContinuedLine> continued{};  ///< from merge_cut_endpoints to continue_lines

  // From arrange_triangle on:
  lattice::PlanarGraph graph{};          ///< nodes as in Arrangement, edges without the sides of the triangle
  std::vector<std::uint32_t> stamps{};   ///< per node of the graph
  std::vector<std::uint8_t> rendered{};  ///< per node of the graph
  std::array<std::uint32_t, 3> boundary_counts{};
  std::array<std::vector<std::uint32_t>, 3>
      old_section_polygons{};                               ///< per section now: its polygon in `before`
  std::array<std::vector<std::uint8_t>, 3> cut_sections{};  ///< per section now: 1 where a line runs along it
  bool changed = false;                                     ///< nodes or edges differ from `before`
  DisjointPolygons polygons{};
};

/// Where a line end of the previous cut was detected, and the node that it went to: one more place from which
/// this node attracts line ends (§7, "additional cluster center"). The same cut, made again, finds the same
/// nodes; and a blade finds the end of its cut again when merging has moved it.
struct ClusterCentres {
  struct OnEdge {
    AncestorEdgeId edge;
    std::int32_t detected;
    std::int32_t node;
    auto operator<=>(const OnEdge&) const = default;
  };
  struct Inside {
    AncestorId ancestor;
    LatticePoint detected;
    LatticePoint node;
    auto operator<=>(const Inside&) const = default;
  };
  /// Where a line vanished, since both its ends merged to the same place and there is no node: a blade has
  /// begun to cut and has not come far enough yet. The place attracts line ends as a node of the previous cut
  /// does.
  struct Begun {
    AncestorId ancestor;
    LatticePoint point;
    auto operator<=>(const Begun&) const = default;
  };
  std::vector<OnEdge> on_edges;  ///< sorted
  std::vector<Inside> inside;    ///< sorted
  std::vector<Begun> begun;      ///< sorted, each once

  [[nodiscard]] auto inside_of(AncestorId ancestor) const {
    return std::ranges::equal_range(inside, ancestor, {}, &Inside::ancestor);
  }
  [[nodiscard]] auto begun_in(AncestorId ancestor) const {
    return std::ranges::equal_range(begun, ancestor, {}, &Begun::ancestor);
  }
  [[nodiscard]] auto on_edge(AncestorEdgeId edge) const {
    return std::ranges::equal_range(on_edges, edge, {}, &OnEdge::edge);
  }
};

/// How near a line end must come to where an earlier one was detected to be taken for the same. Not a merge
/// distance: with one, a blade that goes on in small steps would drag the end of its cut along instead of
/// cutting.
inline double same_place(const MergeDistances& distances) { return distances.edge * 1e-3; }

/// The merge distances for an edge of this length, or a triangle of this height: made smaller, all three by
/// the same factor, until δc is a quarter of it. A small triangle in a coarse mesh would otherwise merge with
/// what is cut in it.
/// @param unit length of a lattice unit there, twice which is the least that δe becomes
MergeDistances local_distances(const MergeDistances& distances, double size, double unit);

/// What all steps need to know of this call.
struct CutContext {
  const MergeDistances& distances;
  const ClusterCentres& centres;
  std::uint32_t this_cut;      ///< number of this call, for stamps
  std::uint32_t previous_cut;  ///< number of the cutter's previous call; 0: none

  /// True for nodes that attract line ends from δc.
  [[nodiscard]] bool recent(std::uint32_t stamp) const { return stamp != 0 && stamp == previous_cut; }
};

/// The arrangement of an ancestor, or that of an uncut triangle when it has none; stamps of nodes that it
/// shares with its neighbours are brought up to date.
Arrangement working_arrangement(const HybridMesh& mesh, AncestorId ancestor);

/// A work without lines.
TriangleWork make_work(const HybridMesh& mesh, AncestorId ancestor, const MergeDistances& distances);

/// Adds works without lines for those of the ancestors that have none. @pre both are sorted by ancestor
void add_works(const HybridMesh& mesh, std::vector<TriangleWork>& works,
               const std::vector<AncestorId>& ancestors, const MergeDistances& distances);

/// Squared tension-free lengths of the ancestor's edges.
lattice::Metric rest_metric(const AncestorMesh& ancestors, AncestorId ancestor);

}  // namespace cut

/// @file
/// Step 2 beyond the triangle (§4.2; future work in §7): a line end near a physics edge also sees the nodes
/// on the other side, in the plane into which the triangles around it unfold. In: a free end. Out: the place
/// on the edge where the line leaves the triangle, and the lines that lead it on to a node of a neighbour.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cutting/polygon_nodes.hpp"
#include "cutting/state.hpp"

namespace cut {

/// A node on the other side of an edge, and the way there.
struct NodeAcross {
  bool recent;                     ///< part of the previous cut
  double distance;                 ///< straight, in the unfolded plane
  LineEnd exit;                    ///< where the way leaves the triangle of the end
  std::vector<ContinuedLine> way;  ///< one for each triangle that is entered; the last one ends at the node
};

/// An end of this cut that no node has attracted.
struct FreeEnd {
  AncestorId ancestor;
  std::uint32_t polygon;
  LatticePoint point;
};

/// What a triangle's line ends see in its neighbours. Arrangements of neighbours are set up when they are
/// first needed.
class Neighbourhood {
 public:
  /// @param free_ends  what is seen beside nodes; by ancestor
  Neighbourhood(const HybridMesh& mesh, const TriangleWork& work, const CutContext& context,
                std::span<const FreeEnd> free_ends = {});
  ~Neighbourhood();

  /// The node across edges that is better than the best one of the triangle itself: a recent one within δc,
  /// else any within δn, by distance. The way to it is straight, and crosses no cut.
  /// @param p inside of the triangle, on no edge
  /// @param other the line's other end
  /// @param recent,distance of the best node of the triangle itself; infinite distance when there is none
  /// Free ends are seen as nodes that are not recent.
  [[nodiscard]] std::optional<NodeAcross> nearest_node(LatticePoint p, LatticePoint other,
                                                       std::uint32_t polygon, bool recent, double distance);

 private:
  struct Neighbour;
  class Walk;
  Neighbour& neighbour(AncestorId ancestor);

  const HybridMesh& mesh_;
  const TriangleWork& work_;
  const CutContext& context_;
  std::span<const FreeEnd> free_ends_;
  std::vector<std::unique_ptr<Neighbour>> neighbours_;
};

/// Ends a line on the edge that the way to a node across it passes, and hands what goes on from there to
/// continue_lines.
void lead_across(NodeAcross&& across, LineEnd& end, TriangleWork& work);

/// Leads ends that are still free, within δn, to those on the other side of an edge, of which the first stays
/// where it is. Within a triangle merge_free_endpoints does the same. Runs over the works one after the
/// other. @pre works are sorted by ancestor
void meet_across_edges(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context);

/// Gives the lines that go on in a neighbour to that neighbour's work, which is made if there is none.
void continue_lines(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context);

}  // namespace cut

/// @file
/// Step 2 beyond the triangle (§4.2; future work in §7): a line end near a physics edge also sees the nodes
/// on the other side, in the plane into which the triangles around it unfold. In: a free end. Out: the place
/// on the edge where the line leaves the triangle, and the lines that lead it on to a node of a neighbour.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cutting/polygon_nodes.hpp"
#include "cutting/state.hpp"

namespace cut {

/// What attracts an end from the other side of an edge, and the way there.
struct TargetAcross {
  bool recent;                     ///< a node of the previous cut
  double distance;                 ///< straight, in the unfolded plane
  LineEnd exit;                    ///< where the way leaves the triangle of the end, or ends on its side
  std::vector<ContinuedLine> way;  ///< one for each triangle that is entered; the last one ends at the target
};

/// An end of this cut that was detected inside of its triangle, for other ends of the same cut.
struct SeenEnd {
  AncestorId ancestor;
  std::uint32_t polygon;
  LatticePoint detected;
  LineEnd target;           ///< where it goes; while it is free, where it was detected
  bool tip = false;         ///< no other line of this cut ends there
  std::uint32_t chain = 0;  ///< of a tip: the lines that lead to it
};

/// Those that others see.
using SettledEnds = std::map<AncestorId, std::vector<SeenEnd>>;

/// Free ends are seen by all; where a tip goes, by tips of other lines only: a blade that goes on in small
/// steps would not come away from the end of its cut.
inline bool sees(const SeenEnd& from, const SeenEnd& end) {
  return end.target.on == LineEnd::On::nothing || (from.tip && end.tip && from.chain != end.chain);
}

/// What a triangle's line ends see in its neighbours. Arrangements of neighbours are set up when they are
/// first needed.
class Neighbourhood {
 public:
  Neighbourhood(const HybridMesh& mesh, const TriangleWork& work, const CutContext& context);
  Neighbourhood(Neighbourhood&&) noexcept;
  ~Neighbourhood();

  /// The node across edges that is better than the best one of the triangle itself: a recent one within δc,
  /// else any within δn, by distance. The way to it is straight, and crosses no cut.
  /// @param p inside of the triangle, on no edge
  /// @param other the line's other end
  /// @param recent,distance of the best node of the triangle itself; infinite distance when there is none
  [[nodiscard]] std::optional<TargetAcross> nearest_node(LatticePoint p, LatticePoint other,
                                                         std::uint32_t polygon, bool recent, double distance);

  /// The end across edges that `from` sees and that was detected nearest to it, within δn, and goes to a
  /// place within δc. The way leads to that place.
  /// @param other where the other end of the line was detected
  [[nodiscard]] std::optional<TargetAcross> nearest_end(const SeenEnd& from, LatticePoint other,
                                                        const SettledEnds& ends);

 private:
  struct Neighbour;
  class Walk;
  Neighbour& neighbour(AncestorId ancestor);

  const HybridMesh& mesh_;
  const TriangleWork& work_;
  const CutContext& context_;
  std::vector<std::unique_ptr<Neighbour>> neighbours_;
};

/// Ends a line where the way to a target across an edge leaves its triangle, and hands what goes on from
/// there to continue_lines.
void lead_across(TargetAcross&& across, LineEnd& end, TriangleWork& work);

/// Gives the lines that go on in a neighbour to that neighbour's work, which is made if there is none.
void continue_lines(const HybridMesh& mesh, std::vector<TriangleWork>& works, const CutContext& context);

}  // namespace cut

/// @file
/// Air that resists motion across the cloth (docs/simulation.md, "Air"). In: positions and velocities. Out:
/// for each corner of each triangle the normal n and the coefficient c of the force −c·((v − wind)·n)·n.
///
/// A corner has a third of its triangle's area as it is now, times the weight w of its fragment: the force on
/// all copies of a node is that on the node before the cut.
#pragma once
#include <array>
#include <vector>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/padded.hpp"

namespace cut {

/// Calls act(node, normal, coefficient) for each corner. @param weights empty: all are 1
template <class Act>
void for_each_dragged_corner(const Buffers& buffers, const std::vector<PaddedVector>& positions,
                             const std::vector<std::array<double, 3>>& weights, double drag, const Act& act) {
  for (std::size_t t = 0; t < buffers.triangles.size(); ++t) {
    const PhysicsTriangle& triangle = buffers.triangles[t];
    if (!triangle.ancestor.valid()) continue;
    const auto corner = [&](std::size_t i) { return plain(positions[triangle.nodes[i].index()]); };
    const Eigen::Vector3d area = cross(corner(1) - corner(0), corner(2) - corner(0)) / 2;
    const double size = length(area);
    if (!(size > 0)) continue;
    const Eigen::Vector3d normal = area / size;
    for (std::size_t i = 0; i < 3; ++i)
      act(triangle.nodes[i].index(), normal, drag * (size / 3) * (weights.empty() ? 1 : weights[t][i]));
  }
}

}  // namespace cut

/// @file
/// What holds the cloth of a scene: which nodes, and where it takes them. In: the anchors of the scene and
/// the cloth. Out: anchored nodes of the simulation, with the velocity of the frame that begins.
#pragma once
#include <cstdint>
#include <cut/hybrid_mesh.hpp>
#include <cut/simulation.hpp>
#include <vector>

#include "snip/mesh_file/mesh.hpp"
#include "snip/run/scene.hpp"

namespace snip {

class Anchors {
 public:
  Anchors() = default;

  /// Anchors what the scene names. Errors name the anchor: nothing is there, or a node that an anchor moves
  /// has another one as well.
  static Result<Anchors> hold(const Scene& scene, const Mesh& cloth, const cut::HybridMesh& mesh,
                              cut::Simulation& simulation);

  /// Nodes on moving anchors get the velocity that takes them to where the scene has them at the time `to`,
  /// a frame from now. Error: a time step takes one further than `longest_way`. O(nodes).
  Result<> aim(const Scene& scene, double to, const cut::HybridMesh& mesh, cut::Simulation& simulation) const;

 private:
  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<std::uint32_t> anchor_of_;  ///< per node of the uncut mesh
  bool any_moves_ = false;
  double longest_way_ = 0;  ///< in a time step
};

}  // namespace snip

// Holding and moving nodes, see anchors.hpp. Copies of a node, which cuts make, go where it goes.
#include "snip/run/anchors.hpp"

#include <fmt/format.h>

namespace snip {

Result<Anchors> Anchors::hold(const Scene& scene, const Mesh& cloth, const cut::HybridMesh& mesh,
                              cut::Simulation& simulation) {
  const cut::AncestorMesh& ancestors = mesh.ancestors;
  Anchors result;
  result.anchor_of_.assign(ancestors.rest_positions.size(), none);
  for (std::size_t a = 0; a < scene.anchors.size(); ++a) {
    const Anchor& anchor = scene.anchors[a];
    std::vector<unsigned char> held(cloth.positions.size());
    for (const std::uint32_t node : anchor.nodes) {
      if (node >= held.size())
        return Error{
            fmt::format("{}: there is no node {}: the cloth has {} nodes", anchor.place, node, held.size())};
      held[node] = 1;
    }
    bool any = false;
    for (std::size_t n = 0; n < ancestors.rest_positions.size(); ++n) {
      const bool in_box = anchor.box && anchor.box->contains(ancestors.rest_positions[n]);
      if (!in_box && !held[ancestors.input_node[n]]) continue;
      std::uint32_t& holder = result.anchor_of_[n];
      if (holder != none && !(anchor.keyframes.empty() && scene.anchors[holder].keyframes.empty()))
        return Error{fmt::format("{}: node {} has an anchor already, and one of the two moves", anchor.place,
                                 ancestors.input_node[n])};
      holder = static_cast<std::uint32_t>(a);
      simulation.anchor(cut::AncestorNodeId{n}, mesh);
      any = true;
    }
    if (!any) return Error{fmt::format("{}: no node of the cloth is there", anchor.place)};
    result.any_moves_ |= !anchor.keyframes.empty();
  }
  result.longest_way_ = longest_way(scene, mesh);
  return result;
}

Result<> Anchors::aim(const Scene& scene, double to, const cut::HybridMesh& mesh,
                      cut::Simulation& simulation) const {
  if (!any_moves_) return {};
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const std::size_t ancestor = mesh.buffers.nodes[n].index();
    if (anchor_of_[ancestor] == none || !simulation.anchored(cut::NodeId{n})) continue;
    const Anchor& anchor = scene.anchors[anchor_of_[ancestor]];
    if (anchor.keyframes.empty()) continue;
    const Eigen::Vector3d target =
        placed(mesh.ancestors.rest_positions[ancestor], anchor.axis, keyframe_at(anchor.keyframes, to));
    const Eigen::Vector3d velocity = (target - mesh.positions[n]) / scene.frame_time();
    if (!(velocity.cwiseAbs().maxCoeff() * scene.time_step <= longest_way_))
      return Error{
          fmt::format("{}: it takes node {} further in a time step of {} s than longest_way, {:.3g} m",
                      anchor.place, mesh.ancestors.input_node[ancestor], scene.time_step, longest_way_)};
    simulation.set_velocity(cut::NodeId{n}, velocity);
  }
  return {};
}

}  // namespace snip

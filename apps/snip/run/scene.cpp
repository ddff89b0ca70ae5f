// When and where the cutters and anchors of a scene are, see scene.hpp.
#include "snip/run/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snip {

double longest_way(const Scene& scene, const cut::HybridMesh& mesh) {
  if (scene.surroundings.longest_way > 0) return scene.surroundings.longest_way;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.ancestors.rest_positions) box.extend(p);
  return box.diagonal().stableNorm();
}

Keyframe keyframe_at(const std::vector<Keyframe>& keyframes, double time) {
  const auto next =
      std::find_if(keyframes.begin(), keyframes.end(), [&](const Keyframe& k) { return k.at > time; });
  if (next == keyframes.end()) return keyframes.back();
  if (next == keyframes.begin()) return *next;
  const Keyframe& before = *(next - 1);
  const double t = (time - before.at) / (next->at - before.at);
  return {time, before.move + t * (next->move - before.move),
          before.degrees + t * (next->degrees - before.degrees)};
}

Eigen::Vector3d placed(const Eigen::Vector3d& point, const Eigen::Vector3d& axis, const Keyframe& keyframe) {
  if (keyframe.degrees == 0) return point + keyframe.move;
  return Eigen::AngleAxisd(keyframe.degrees * std::numbers::pi / 180, axis.normalized()) * point +
         keyframe.move;
}

std::vector<Eigen::Vector3d> blade_at(const MovingBlade& blade, double time) {
  const Keyframe now = keyframe_at(blade.keyframes, time);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : blade.edge) points.push_back(placed(p, blade.axis, now));
  return points;
}

bool blade_moves_between(const MovingBlade& blade, double from, double to) {
  return to > blade.keyframes.front().at && from < blade.keyframes.back().at;
}

std::vector<std::size_t> repetitions_between(const StaticCutter& cutter, double from, double to) {
  std::vector<std::size_t> due;
  const auto time = [&](std::size_t i) { return cutter.at + static_cast<double>(i) * cutter.interval; };
  std::size_t first = 0;
  if (cutter.interval > 0 && from > cutter.at) {
    const double skipped = std::floor((from - cutter.at) / cutter.interval);
    first = static_cast<std::size_t>(std::min(skipped, static_cast<double>(cutter.times)));
  }
  for (std::size_t i = first; i < cutter.times && time(i) < to; ++i)
    if (time(i) >= from) due.push_back(i);
  return due;
}

}  // namespace snip

// When and where the cutters of a scene are, see scene.hpp.
#include "snip/run/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snip {

std::vector<Eigen::Vector3d> blade_at(const MovingBlade& blade, double time) {
  const auto& keys = blade.keyframes;
  const auto next = std::find_if(keys.begin(), keys.end(), [&](const Keyframe& k) { return k.at > time; });
  Keyframe now = next == keys.end() ? keys.back() : *next;
  if (next != keys.begin() && next != keys.end()) {
    const Keyframe& before = *(next - 1);
    const double t = (time - before.at) / (next->at - before.at);
    now.move = before.move + t * (next->move - before.move);
    now.degrees = before.degrees + t * (next->degrees - before.degrees);
  }
  const Eigen::AngleAxisd turn(now.degrees * std::numbers::pi / 180, blade.axis.normalized());
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : blade.edge) points.push_back((now.degrees == 0 ? p : turn * p) + now.move);
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

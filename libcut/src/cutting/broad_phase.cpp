#include "cutting/broad_phase.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace cut {
namespace {

using Box = spatial::Box<double, 3>;

Box box_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double margin) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    box.min[k] = std::min({a[i], b[i], c[i]}) - margin;
    box.max[k] = std::max({a[i], b[i], c[i]}) + margin;
  }
  return box;
}

Box box_of(const HybridMesh& mesh, std::size_t triangle) {
  const auto& nodes = mesh.buffers.triangles[triangle].nodes;
  return box_of(mesh.positions[nodes[0].index()], mesh.positions[nodes[1].index()],
                mesh.positions[nodes[2].index()], 0);
}

}  // namespace

bool BroadPhase::update(const HybridMesh& mesh, Error& error) {
  if (filled_ && position_version_ == mesh.position_version &&
      handles_.size() == mesh.buffers.triangles.size())
    return true;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (mesh.positions[n].allFinite()) continue;
    error = {Error::Kind::not_finite,
             "physics node " + std::to_string(n) + " has a coordinate that is NaN or infinite", n};
    return false;
  }
  const std::size_t count = mesh.buffers.triangles.size();
  for (std::size_t t = 0; t < handles_.size(); ++t) tree_.move(handles_[t], box_of(mesh, t));
  handles_.reserve(count);
  for (std::size_t t = handles_.size(); t < count; ++t)
    handles_.push_back(tree_.insert(box_of(mesh, t), TriangleId{t}));
  filled_ = true;
  position_version_ = mesh.position_version;
  return true;
}

void BroadPhase::add(const HybridMesh& mesh, const std::vector<TriangleCopy>& copies) {
  for (const TriangleCopy& c : copies)
    if (c.triangle.index() == handles_.size())
      handles_.push_back(tree_.insert(box_of(mesh, c.triangle.index()), c.triangle));
}

std::vector<CandidatePair> BroadPhase::candidates(const TriangleMesh& cutter, double slack) const {
  std::vector<CandidatePair> pairs;
  for (std::uint32_t i = 0; i < cutter.triangles.size(); ++i) {
    const auto& t = cutter.triangles[i];
    const Box box = box_of(cutter.positions[t[0]], cutter.positions[t[1]], cutter.positions[t[2]], slack);
    tree_.query(spatial::intersects(box), [&](TriangleId triangle) { pairs.push_back({triangle, i}); });
  }
  return pairs;
}

}  // namespace cut

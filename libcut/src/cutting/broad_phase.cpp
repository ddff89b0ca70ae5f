#include "cutting/broad_phase.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cutting/in_parts.hpp"

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
  if (knows(mesh)) {
    if (has_tree_) return true;
    const std::size_t count = mesh.buffers.triangles.size();
    std::vector<std::pair<Box, TriangleId>> boxes;
    boxes.reserve(count);
    for (std::size_t t = 0; t < count; ++t) boxes.emplace_back(box_of(mesh, t), TriangleId{t});
    tree_.insert(boxes.begin(), boxes.end());
    has_tree_ = true;
    return true;
  }
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (mesh.positions[n].allFinite()) continue;
    error = {Error::Kind::not_finite,
             "physics node " + std::to_string(n) + " has a coordinate that is NaN or infinite", n};
    return false;
  }
  tree_.clear();
  has_tree_ = false;
  state_ = mesh.state;
  return true;
}

void BroadPhase::add(const HybridMesh& mesh, const std::vector<TriangleCopy>& copies) {
  state_ = mesh.state;
  if (!has_tree_) return;
  for (const TriangleCopy& c : copies) tree_.insert(box_of(mesh, c.triangle.index()), c.triangle);
}

std::vector<CandidatePair> BroadPhase::candidates(const HybridMesh& mesh, const TriangleMesh& cutter,
                                                  double slack, const Executor& executor) const {
  using Pairs = std::vector<CandidatePair>;
  const auto add_pair = [&](TriangleId triangle, std::uint32_t cutter_triangle, Pairs& pairs) {
    // A removed triangle keeps its place in the arrays and in the tree.
    const AncestorId ancestor = mesh.buffers.triangles[triangle.index()].ancestor;
    if (ancestor.valid()) pairs.push_back({ancestor, triangle, cutter_triangle});
  };
  std::vector<std::pair<Box, std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < cutter.triangles.size(); ++i) {
    const auto& t = cutter.triangles[i];
    faces.emplace_back(box_of(cutter.positions[t[0]], cutter.positions[t[1]], cutter.positions[t[2]], slack),
                       i);
  }
  Pairs all;
  if (has_tree_ && knows(mesh)) {
    for (const auto& [box, i] : faces)
      tree_.query(spatial::intersects(box),
                  [&, face = i](TriangleId triangle) { add_pair(triangle, face, all); });
    return all;
  }
  const spatial::BoundingBoxTernaryTree<std::uint32_t, double, 3> tree(faces.begin(), faces.end());
  const Box bounds = tree.bounds();
  const auto parts =
      in_parts<Pairs>(executor, mesh.buffers.triangles.size(), [&](std::size_t t, Pairs& pairs) {
        const Box box = box_of(mesh, t);
        if (!spatial::touch(box, bounds)) return;
        const auto first = static_cast<std::ptrdiff_t>(pairs.size());
        tree.query(spatial::intersects(box),
                   [&](std::uint32_t face) { add_pair(TriangleId{t}, face, pairs); });
        std::sort(pairs.begin() + first, pairs.end());
      });
  for (const Pairs& part : parts) append(all, part);
  return all;
}

}  // namespace cut

/// @file
/// Notes which entries of the flat buffers a cut has written, so that the change set costs what was changed
/// and not what there is.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "cut/changes.hpp"
#include "cut/executor.hpp"
#include "cut/hybrid_mesh.hpp"

namespace cut {

struct ChangeLog {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> springs;
  std::vector<std::uint32_t> render_vertices;
  std::vector<std::uint32_t> render_triangles;
  std::vector<NodeCopy> node_copies;
  std::vector<TriangleCopy> triangle_copies;
  std::vector<SpringCopy> spring_copies;
  std::vector<AncestorEdgeId> edges;  ///< of ancestors that were arranged anew
};

/// The last step (docs/cutting.md, "publish"): the change set of all noted entries with their values now.
/// O(changes · log).
Changes publish(const HybridMesh& mesh, ChangeLog&& log, const Executor& executor);

}  // namespace cut

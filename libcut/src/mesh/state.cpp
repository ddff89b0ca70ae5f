// Draws the numbers that name states of meshes (HybridMesh::state).
#include "mesh/state.hpp"

#include <atomic>

#include "cut/hybrid_mesh.hpp"

namespace cut {

std::uint64_t new_state() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void HybridMesh::moved() { state = new_state(); }

}  // namespace cut

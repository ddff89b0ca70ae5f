// Builds the hybrid mesh of one triangle: the headers are there, and the library links.
#include <cut/hybrid_mesh.hpp>

int main() {
  const cut::TriangleMesh cloth{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const cut::Result<cut::HybridMesh> mesh = cut::HybridMesh::build(cloth);
  return mesh && mesh->buffers.triangles.size() == 1 ? 0 : 1;
}

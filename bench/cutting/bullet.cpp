// The soft body is put together by hand: btSoftBodyHelpers::CreateFromTriMesh looks for double links in a
// table of nodes × nodes. refine keeps such a table too (half of it, four bytes an entry), which bounds the
// size.
#include <BulletSoftBody/btSoftBody.h>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "cutting/measure.hpp"
#include "cutting/programs.hpp"

namespace cutting {
namespace {

class Side final : public btSoftBody::ImplicitFn {
 public:
  explicit Side(const OneShot& experiment) : experiment_(experiment) {}
  btScalar Eval(const btVector3& p) override { return btScalar(experiment_.side(p.x(), p.y())); }

 private:
  const OneShot& experiment_;
};

void fill(btSoftBody& body, const cut::TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> links;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) links.insert(std::minmax(t[k], t[(k + 1) % 3]));
    body.appendFace(int(t[0]), int(t[1]), int(t[2]));
  }
  for (const auto& [a, b] : links) body.appendLink(int(a), int(b));
}

}  // namespace

void bullet_once(const OneShot& experiment, OneShotResult& result) {
  btSoftBodyWorldInfo world;
  std::vector<btVector3> points;
  for (const Eigen::Vector3d& p : experiment.cloth.positions)
    points.emplace_back(btScalar(p.x()), btScalar(p.y()), btScalar(p.z()));
  const std::vector<btScalar> masses(points.size(), 1);
  Side side(experiment);

  Stopwatch watch;
  btSoftBody body(&world, int(points.size()), points.data(), masses.data());
  fill(body, experiment.cloth);
  result.prepare_ms = watch.lap();
  body.refine(&side, btScalar(1e-3), true);
  result.cut_ms = watch.lap();

  cut::TriangleMesh mesh;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btVector3& p = body.m_nodes[i].m_x;
    mesh.positions.emplace_back(p.x(), p.y(), p.z());
  }
  const auto number = [&](const btSoftBody::Node* n) {
    return static_cast<std::uint32_t>(n - &body.m_nodes[0]);
  };
  for (int i = 0; i < body.m_faces.size(); ++i) {
    btSoftBody::Node* const* n = body.m_faces[i].m_n;
    mesh.triangles.push_back({number(n[0]), number(n[1]), number(n[2])});
  }
  describe(mesh, result);
}

}  // namespace cutting

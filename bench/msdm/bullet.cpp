#include "msdm/bullet.hpp"

#include <BulletSoftBody/btSoftBody.h>

#include "msdm/plain.hpp"

namespace msdm {

struct BulletCloth::Body {
  btSoftBodyWorldInfo world;
  std::unique_ptr<btSoftBody> body;
};

BulletCloth::BulletCloth(const cut::HybridMesh& mesh) : body_(std::make_unique<Body>()) {
  std::vector<Eigen::Vector3d> positions = mesh.positions;
  ripple(positions);
  std::vector<btVector3> points;
  for (const Eigen::Vector3d& p : positions)
    points.emplace_back(btScalar(p.x()), btScalar(p.y()), btScalar(p.z()));
  const std::vector<btScalar> masses(points.size(), btScalar(0.2));
  body_->world.m_gravity = btVector3(0, 0, btScalar(-9.81));
  body_->body = std::make_unique<btSoftBody>(&body_->world, int(points.size()), points.data(), masses.data());
  for (const cut::Spring& s : mesh.buffers.springs)
    body_->body->appendLink(int(s.nodes[0].value), int(s.nodes[1].value));
  body_->body->setMass(0, 0);
  body_->body->m_cfg.piterations = 1;
}

BulletCloth::~BulletCloth() = default;

void BulletCloth::step() {
  body_->body->predictMotion(btScalar(time_step));
  body_->body->solveConstraints();
  body_->body->integrateMotion();
}

void BulletCloth::links() { btSoftBody::PSolve_Links(body_->body.get(), 1, 0); }

}  // namespace msdm

/// @file
/// Bullet's soft body with the same nodes and links, as a peer of the simulation.
#pragma once
#include <cut/hybrid_mesh.hpp>
#include <memory>

namespace msdm {

class BulletCloth {
 public:
  explicit BulletCloth(const cut::HybridMesh& mesh);
  ~BulletCloth();
  /// All that Bullet does in a step, with one iteration of its solver, its tree for collisions included.
  void step();
  /// One pass over its links alone, without moving anything on.
  void links();

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace msdm

/// @file
/// Equations 1 to 6 as one would write them down: the loop that the simulation is compared with. And what all
/// of bench_msdm simulates.
#pragma once
#include <cstdint>
#include <cut/simulation.hpp>
#include <scenes/cloths.hpp>
#include <vector>

namespace msdm {

inline constexpr double time_step = 1e-4;
inline const cut::Material material{cut::MaterialMode::conserving, 0.2, 100, 0.01, 0, 0};

/// cells × cells squares, or the paper's patch of 12 triangles for 0.
inline cut::HybridMesh cloth(std::size_t cells) {
  return *cut::HybridMesh::build(cells == 0 ? scenes::twelve_triangles() : scenes::grid(cells, cells));
}

/// Ripples, so that springs have work to do.
inline void ripple(std::vector<Eigen::Vector3d>& positions) {
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n].z() += 0.01 * static_cast<double>(n % 5);
}

class PlainCloth {
 public:
  explicit PlainCloth(const cut::HybridMesh& mesh) : positions_(mesh.positions) {
    const cut::Simulation simulation = *cut::Simulation::build(mesh, material);
    velocities_.assign(positions_.size(), Eigen::Vector3d::Zero());
    forces_ = velocities_;
    for (std::size_t n = 0; n < positions_.size(); ++n) masses_.push_back(simulation.mass(cut::NodeId{n}));
    for (const cut::Spring& s : mesh.buffers.springs)
      springs_.push_back({s.nodes[0].value, s.nodes[1].value, mesh.ancestors.rest_length(s.edge),
                          material.stiffness, material.damping});
    ripple(positions_);
  }

  void step() {
    for (std::size_t n = 0; n < positions_.size(); ++n)
      forces_[n] = masses_[n] * Eigen::Vector3d(0, 0, -9.81);
    for (const PlainSpring& s : springs_) {
      const Eigen::Vector3d along = positions_[s.b] - positions_[s.a];
      const double length = along.norm();
      const Eigen::Vector3d direction = along / length;
      const double rate = (velocities_[s.b] - velocities_[s.a]).dot(direction);
      const Eigen::Vector3d force = direction * (s.stiffness * (length - s.rest_length) + s.damping * rate);
      forces_[s.a] += force;
      forces_[s.b] -= force;
    }
    for (std::size_t n = 1; n < positions_.size(); ++n) {
      velocities_[n] += forces_[n] / masses_[n] * time_step;
      positions_[n] += velocities_[n] * time_step;
    }
  }

 private:
  struct PlainSpring {
    std::uint32_t a, b;
    double rest_length, stiffness, damping;
  };
  std::vector<Eigen::Vector3d> positions_, velocities_, forces_;
  std::vector<double> masses_;
  std::vector<PlainSpring> springs_;
};

}  // namespace msdm

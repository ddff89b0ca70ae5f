// Sums over the whole simulation: mass, momentum, energy. In: the simulation's arrays and the mesh's
// positions. Sums run by increasing index.
#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"

namespace cut {

double Simulation::total_mass() const {
  double sum = 0;
  for (const double m : mass_) sum += m;
  return sum;
}

Eigen::Vector3d Simulation::momentum() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < mass_.size(); ++n) sum += mass_[n] * velocity(NodeId{n});
  return sum;
}

Eigen::Vector3d Simulation::angular_momentum(const HybridMesh& mesh) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < mass_.size(); ++n)
    sum += mass_[n] * cross(mesh.positions[n], velocity(NodeId{n}));
  return sum;
}

Eigen::Vector3d Simulation::centre_of_mass(const HybridMesh& mesh) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < mass_.size(); ++n) sum += mass_[n] * mesh.positions[n];
  return sum / total_mass();
}

Energy Simulation::energy(const HybridMesh& mesh) const {
  Energy energy;
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    energy.kinetic += mass_[n] * squared_length(velocity(NodeId{n})) / 2;
    energy.gravity -= mass_[n] * dot(surroundings.gravity, mesh.positions[n]);
  }
  for (const SpringArrays* springs : spring_lists())
    for (std::size_t i = 0; i < springs->nodes.size(); ++i) {
      const auto [a, b] = springs->nodes[i];
      const double stretch = length(mesh.positions[b] - mesh.positions[a]) - springs->rest_length[i];
      energy.elastic += springs->stiffness[i] * stretch * stretch / 2;
    }
  return energy;
}

}  // namespace cut

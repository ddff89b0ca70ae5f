// Building a simulation and access to single nodes. In: a hybrid mesh, cut or not, and a material. Out: the
// flat arrays that a step works on. Masses and springs are set by the functions that also take over cuts
// (fragments.cpp).
#include "cut/simulation.hpp"

#include <cmath>
#include <string>

#include "mesh/vector3.hpp"
#include "simulation/padded.hpp"

namespace cut {
namespace {

const char* fault_of(const Material& m) {
  // A limit far from the ends of double keeps every sum and ratio finite.
  const auto usable = [](double v) { return v >= 0 && v < 1e100; };
  if (!usable(m.density) || m.density < 1e-100) return "the density must be positive and finite";
  if (!usable(m.stiffness)) return "the stiffness must be finite and not negative";
  if (!usable(m.damping)) return "the damping must be finite and not negative";
  if (!usable(m.bending_stiffness)) return "the bending stiffness must be finite and not negative";
  if (!usable(m.bending_damping)) return "the bending damping must be finite and not negative";
  return nullptr;
}

/// Cuts add entries: with room for an eighth more, the first ones need not move whole arrays.
template <class... Arrays>
void make_room(std::size_t entries, Arrays&... arrays) {
  (arrays.reserve(entries + entries / 8 + 4), ...);
}

void make_room(std::size_t entries, SpringArrays& springs) {
  make_room(entries, springs.nodes, springs.rest_length, springs.stiffness, springs.damping);
}

}  // namespace

Result<Simulation> Simulation::build(const HybridMesh& mesh, const Material& material) {
  if (const char* fault = fault_of(material)) return Error{Error::Kind::bad_parameter, fault, 0};
  Simulation s;
  s.material_ = material;
  s.topology_version_ = mesh.topology_version;
  if (!mesh.ancestors.rest_positions.empty()) {
    Eigen::Vector3d low = mesh.ancestors.rest_positions[0], high = low;
    for (const Eigen::Vector3d& p : mesh.ancestors.rest_positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    s.diagonal_ = length(high - low);
  }
  const std::size_t nodes = mesh.buffers.nodes.size(), springs = mesh.buffers.springs.size();
  make_room(nodes, s.mass_, s.inverse_mass_, s.anchored_, s.velocities_, s.positions_, s.forces_);
  make_room(springs, s.springs_);
  make_room(springs, s.places_);
  if (material.mode == MaterialMode::conserving) make_room(mesh.buffers.triangles.size(), s.weights_);
  s.resize(mesh);
  for (std::size_t i = 0; i < mesh.buffers.springs.size(); ++i) s.set_spring(SpringId{i}, mesh);
  if (material.mode == MaterialMode::conserving) {
    for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) s.measure_weights(mesh, AncestorId{t});
    for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) s.update_springs(mesh, AncestorEdgeId{e});
  }
  for (std::size_t n = 0; n < mesh.ancestors.rest_positions.size(); ++n)
    s.update_copies(mesh, AncestorNodeId{n});
  if (material.bending_stiffness > 0 || material.bending_damping > 0) {
    const std::size_t edges = mesh.ancestors.edges.size();
    make_room(edges, s.bending_);
    make_room(edges, s.next_bending_, s.bending_places_);
    s.reserve_bending(edges);
    for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e) s.update_bending(mesh, AncestorEdgeId{e});
  }
  s.blocks_.reset(nodes, frequent_offsets(s.spring_lists(), nodes));
  s.settle_springs();
  s.sound_.resize(s.blocks_.blocks().size());
  return s;
}

void Simulation::resize(const HybridMesh& mesh) {
  const std::size_t nodes = mesh.buffers.nodes.size();
  mass_.resize(nodes);
  inverse_mass_.resize(nodes);
  anchored_.resize(nodes);
  velocities_.resize(nodes);
  positions_.resize(nodes);
  forces_.resize(nodes);
  if (!external_forces_.empty()) external_forces_.resize(nodes);
  const std::size_t springs = (mesh.buffers.springs.size() + 3) / 4 * 4;
  springs_.nodes.resize(springs);
  springs_.rest_length.resize(springs);
  springs_.stiffness.resize(springs);
  springs_.damping.resize(springs);
  if (material_.mode == MaterialMode::conserving) weights_.resize(mesh.buffers.triangles.size(), {1, 1, 1});
}

void Simulation::set_mass(NodeId node, double mass) {
  const std::size_t n = node.index();
  if (!external_forces_.empty() && mass_[n] > 0 && mass != mass_[n]) {
    const double share = mass / mass_[n];
    PaddedVector& f = external_forces_[n];
    f = {f.x * share, f.y * share, f.z * share, 0};
  }
  mass_[n] = mass;
  inverse_mass_[n] = mass > 0 && !anchored(node) ? 1 / mass : 0;
}

void Simulation::anchor(NodeId node) {
  anchored_[node.index()] = 1;
  velocities_[node.index()] = {};
  set_mass(node, mass(node));
}

void Simulation::release(NodeId node) {
  anchored_[node.index()] = 0;
  set_mass(node, mass(node));
}

Eigen::Vector3d Simulation::velocity(NodeId node) const { return plain(velocities_[node.index()]); }

void Simulation::set_velocity(NodeId node, const Eigen::Vector3d& velocity) {
  velocities_[node.index()] = padded(velocity);
}

void Simulation::set_force(NodeId node, const Eigen::Vector3d& force) {
  external_forces_.reserve(mass_.capacity());
  external_forces_.resize(mass_.size());
  external_forces_[node.index()] = padded(force);
}

Eigen::Vector3d Simulation::force(NodeId node) const {
  return external_forces_.empty() ? Eigen::Vector3d::Zero() : plain(external_forces_[node.index()]);
}

}  // namespace cut

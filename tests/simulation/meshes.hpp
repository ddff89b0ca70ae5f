/// @file
/// Hybrid meshes for tests of the simulation, and cuts of a single triangle made by hand.
#pragma once
#include <array>
#include <cut/changes.hpp>
#include <cut/hybrid_mesh.hpp>
#include <cut/simulation.hpp>
#include <random>
#include <scenes/cloths.hpp>
#include <vector>

namespace testing {

inline constexpr std::array integrators{cut::Integrator::forward_euler, cut::Integrator::semi_implicit_euler,
                                        cut::Integrator::implicit_euler};

inline cut::HybridMesh built(const cut::TriangleMesh& mesh) {
  auto result = cut::HybridMesh::build(mesh);
  return std::move(result).value();
}

inline cut::Simulation simulated(const cut::HybridMesh& mesh, const cut::Material& material) {
  auto result = cut::Simulation::build(mesh, material);
  return std::move(result).value();
}

/// Equilateral, nodes 0 and 1 at the ends of the lower side, node 2 above.
inline cut::HybridMesh equilateral(double side) {
  return built({{{0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0}}, {{0, 1, 2}}});
}

inline Eigen::Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> component(-size, size);
  const double x = component(random), y = component(random), z = component(random);
  return {x, y, z};
}

/// Moves every node and gives it a velocity, at random.
inline void shake(cut::HybridMesh& mesh, cut::Simulation& simulation, std::mt19937& random, double way,
                  double speed) {
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    mesh.positions[n] += random_vector(random, way);
    simulation.set_velocity(cut::NodeId{n}, random_vector(random, speed));
  }
  mesh.moved();
}

/// Cuts the only triangle of a mesh into polygons that share no edge: polygon 0 keeps the physics triangle
/// that is there, each other one gets three new nodes and three new springs. Polygons are counterclockwise
/// and together cover the triangle. May be repeated with a finer partition, old polygons first; `parents[i]`
/// is the old polygon that new polygon i was a part of. Render buffers are left as they are.
cut::Changes cut_apart(cut::HybridMesh& mesh, const std::vector<std::vector<cut::LatticePoint>>& polygons,
                       const std::vector<std::size_t>& parents);

}  // namespace testing

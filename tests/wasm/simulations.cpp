// Simulated and cut cloth: the hash of positions and velocities after the last step. Every kernel, integrator
// and kind of contact once.
#include <cut/cutter.hpp>
#include <cut/simulation.hpp>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>

#include "hash.hpp"

namespace {

using Vector3 = Eigen::Vector3d;

void add(hashes::Hash& hash, const Vector3& v) {
  for (const double component : {v.x(), v.y(), v.z()}) hash.add(component);
}

/// A sheet that hangs on two corners, over a ball and a floor and in the wind unless it is alone; is cut half
/// way and simulated on. 0 when something fails.
std::uint64_t hung_and_cut(cut::Integrator integrator, bool alone, double time_step, std::size_t steps) {
  constexpr std::size_t cells = 40;
  auto built = cut::HybridMesh::build(scenes::grid(cells, cells, 0.02));
  if (!built) return 0;
  cut::HybridMesh mesh = std::move(built).value();
  cut::Material material;
  material.density = 0.2;
  material.stiffness = 100;
  auto made = cut::Simulation::build(mesh, material);
  if (!made) return 0;
  cut::Simulation simulation = std::move(made).value();
  simulation.anchor(cut::NodeId{cells * (cells + 1)});
  simulation.anchor(cut::NodeId{(cells + 1) * (cells + 1) - 1});
  cut::Surroundings& around = simulation.surroundings;
  around.integrator = integrator;
  around.gravity = {0, -9.81, -1};
  around.air_drag = 0.05;
  if (!alone) {
    around.wind = {0.5, 0, 1};
    around.normal_drag = 0.1;
    around.spheres.push_back({{0.4, 0.4, -0.2}, 0.199, Vector3::Zero(), 0.3});
    around.half_spaces.push_back({{0, 0, -0.21}, {0, 0, 1}, Vector3::Zero(), 0.3});
  }
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  for (const bool is_cut : {false, true}) {
    if (is_cut) {
      const auto changes =
          cutter.cut(mesh, scenes::ribbon({{-0.1, 0.43, 0}, {0.5, 0.37, 0}}, {0.01, 0.02, 4}));
      if (!changes || simulation.apply(*changes, mesh)) return 0;
    }
    if (simulation.step(mesh, time_step, steps)) return 0;
  }
  hashes::Hash hash;
  for (std::uint32_t n = 0; n < mesh.positions.size(); ++n) {
    add(hash, mesh.positions[n]);
    add(hash, simulation.velocity(cut::NodeId{n}));
  }
  return hash.value();
}

const hashes::Case cases[]{
    {"simulation/alone", [] { return hung_and_cut(cut::Integrator::semi_implicit_euler, true, 1e-4, 40); }},
    {"simulation/forward", [] { return hung_and_cut(cut::Integrator::forward_euler, false, 1e-4, 40); }},
    {"simulation/semi_implicit",
     [] { return hung_and_cut(cut::Integrator::semi_implicit_euler, false, 1e-4, 40); }},
    {"simulation/implicit", [] { return hung_and_cut(cut::Integrator::implicit_euler, false, 1e-2, 2); }},
};

}  // namespace

// The estimated stable time step, against the eigenvalues of the linearised cloth and against runs.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;

namespace {

/// Largest eigenvalue ω² of M⁻¹K at rest.
double largest_squared_frequency(const cut::HybridMesh& mesh, const cut::Simulation& simulation) {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(mesh.positions.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size, size);
  const auto add = [&](std::array<std::uint32_t, 2> ends, double k) {
    const Eigen::Vector3d along = (mesh.positions[ends[1]] - mesh.positions[ends[0]]).normalized();
    for (const std::size_t i : {0u, 1u})
      for (const std::size_t j : {0u, 1u})
        system.block<3, 3>(3 * ends[i], 3 * ends[j]) +=
            (i == j ? 1 : -1) * k /
            std::sqrt(simulation.mass(NodeId{ends[i]}) * simulation.mass(NodeId{ends[j]})) * along *
            along.transpose();
  };
  for (std::size_t s = 0; s < mesh.buffers.springs.size(); ++s) {
    const auto& ends = mesh.buffers.springs[s].nodes;
    add({ends[0].value, ends[1].value}, simulation.stiffness(cut::SpringId{s}));
  }
  const cut::SpringArrays& bending = simulation.bending_springs();
  for (std::size_t s = 0; s < bending.nodes.size(); ++s)
    if (bending.stiffness[s] > 0) add(bending.nodes[s], bending.stiffness[s]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(system, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// The largest stable step of a single mode, by bisection on the size of the step's matrix.
double true_limit(Integrator integrator, double squared, double damping) {
  const auto stable = [&](double h) {
    Eigen::Matrix2d step;
    if (integrator == Integrator::forward_euler)
      step << 1, h, -h * squared, 1 - h * damping;
    else
      step << 1 - h * h * squared, h * (1 - h * damping), -h * squared, 1 - h * damping;
    return Eigen::EigenSolver<Eigen::Matrix2d>(step, false).eigenvalues().cwiseAbs().maxCoeff() <= 1 + 1e-12;
  };
  double low = 0, high = 1e3;
  for (int i = 0; i < 100; ++i) (stable((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace

TEST_CASE("The estimate is below the true limit of the linearised cloth, and near it") {
  CHECK(rc::check([] {
    const cut::HybridMesh mesh = testing::built(scenes::random_sheet(
        1 + *rc::gen::inRange<std::size_t>(0, 4), 1 + *rc::gen::inRange<std::size_t>(0, 4), 0.5,
        *rc::gen::arbitrary<std::uint64_t>()));
    const double ratio = *rc::gen::element(0.0001, 0.001, 0.01, 0.1, 1.0);  // c / k
    const cut::Material material{cut::MaterialMode::conserving, 0.3, 200, 200 * ratio};
    const cut::Simulation simulation = testing::simulated(mesh, material);
    const double squared = largest_squared_frequency(mesh, simulation);
    for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler}) {
      const double limit = true_limit(integrator, squared, ratio * squared);
      const double estimate = simulation.stable_time_step(integrator);
      RC_ASSERT(estimate <= limit * (1 + 1e-6));
      RC_ASSERT(estimate >= 0.2 * limit);
      RC_ASSERT(simulation.cut_proof_time_step(integrator, mesh) <= estimate * (1 + 1e-12));
    }
  }));
}

TEST_CASE("Bending springs damped otherwise than the edges: stable below the estimate, in both integrators") {
  // Damping and stiffness then have different modes, and the estimate has no closed form to be near to.
  for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler})
    for (const double bending_damping : {0.0005, 0.02, 1.0}) {
      std::mt19937 random(12);
      cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 5, 0.4, 9));
      cut::Simulation simulation =
          testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.05, 30, bending_damping});
      simulation.surroundings.integrator = integrator;
      testing::shake(mesh, simulation, random, 1e-6, 0);
      const double before = simulation.energy(mesh).total();
      const double time_step = simulation.stable_time_step(integrator);
      CHECK(time_step > 1e-5);
      CHECK(simulation.cut_proof_time_step(integrator, mesh) <= time_step * (1 + 1e-12));
      REQUIRE_FALSE(simulation.step(mesh, 0.95 * time_step, 50000));
      CHECK(simulation.energy(mesh).total() < before);
    }
}

TEST_CASE("Drag alone limits the step, and forward Euler without damping has none") {
  const cut::HybridMesh mesh = testing::built(scenes::twelve_triangles());
  cut::Simulation soft = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.5, 0, 0});
  CHECK(std::isinf(soft.stable_time_step(Integrator::forward_euler)));
  CHECK(std::isinf(soft.stable_time_step(Integrator::semi_implicit_euler)));
  soft.surroundings.air_drag = 4;
  CHECK(soft.stable_time_step(Integrator::forward_euler) == doctest::Approx(2 / 8.0));
  CHECK(soft.stable_time_step(Integrator::semi_implicit_euler) == doctest::Approx(2 / 8.0));
  soft.surroundings.air_drag = 1;
  soft.surroundings.normal_drag = 3;
  for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler}) {
    CHECK(soft.stable_time_step(integrator) == doctest::Approx(2 / 8.0));
    CHECK(soft.cut_proof_time_step(integrator, mesh) == doctest::Approx(2 / 8.0));
    for (const double factor : {0.9, 1.1}) {  // across the cloth that is the limit, and not an estimate
      cut::HybridMesh falling = mesh;
      cut::Simulation simulation = soft;
      simulation.surroundings.integrator = integrator;
      for (std::size_t n = 0; n < mesh.positions.size(); ++n)
        simulation.set_velocity(NodeId{n}, {0, 0, 0.01});
      REQUIRE_FALSE(simulation.step(falling, factor / 4, 20));
      CHECK((simulation.velocity(NodeId{5u}).norm() > 0.01) == (factor > 1));
    }
  }
  cut::Simulation undamped = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.5, 10, 0});
  CHECK(undamped.stable_time_step(Integrator::forward_euler) == 0);
}

TEST_CASE("Cloth is stable a little below the estimate and blows up well above it") {
  for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler}) {
    for (const double factor : {0.95, 4.0}) {
      std::mt19937 random(11);
      cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 5, 0.4, 9));
      cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.05});
      simulation.surroundings.integrator = integrator;
      testing::shake(mesh, simulation, random, 1e-6, 0);
      const double before = simulation.energy(mesh).total();
      const auto error = simulation.step(mesh, factor * simulation.stable_time_step(integrator), 50000);
      CHECK(error.has_value() == (factor > 1));
      if (!error) CHECK(simulation.energy(mesh).total() < before);
    }
  }
}

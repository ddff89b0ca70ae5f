// Momentum, angular momentum and energy of a cloth on which nothing acts from outside.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;

TEST_CASE("Without external forces momentum stays, and angular momentum in semi-implicit Euler") {
  CHECK(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 4, 0.5, random()));
    cut::Simulation simulation = testing::simulated(mesh, {});
    simulation.surroundings.integrator =
        *rc::gen::element(Integrator::forward_euler, Integrator::semi_implicit_euler);
    testing::shake(mesh, simulation, random, 0.02, 1);
    const double size = simulation.total_mass() * 3;
    const Eigen::Vector3d momentum = simulation.momentum();
    const Eigen::Vector3d spin = simulation.angular_momentum(mesh);
    const Eigen::Vector3d centre = simulation.centre_of_mass(mesh);
    const double h = 1e-4;
    RC_ASSERT_FALSE(simulation.step(mesh, h, 200).has_value());
    RC_ASSERT((simulation.momentum() - momentum).norm() < 1e-13 * size);
    RC_ASSERT(
        (simulation.centre_of_mass(mesh) - centre - 200 * h * momentum / simulation.total_mass()).norm() <
        1e-12);
    if (simulation.surroundings.integrator == Integrator::semi_implicit_euler)
      RC_ASSERT((simulation.angular_momentum(mesh) - spin).norm() < 1e-12 * size);
  }));
}

TEST_CASE("Energy without damping: forward Euler gains it, semi-implicit Euler keeps it") {
  const auto drift = [](Integrator integrator, double time_step) {
    std::mt19937 random(5);
    cut::HybridMesh mesh = testing::built(scenes::twelve_triangles());
    cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::paper, 1, 1000, 0});
    simulation.surroundings.integrator = integrator;
    testing::shake(mesh, simulation, random, 0.05, 0);
    const double before = simulation.energy(mesh).total();
    double largest = 0;
    for (int i = 0; i < 500; ++i) {
      REQUIRE_FALSE(simulation.step(mesh, time_step, 20));
      largest = std::max(largest, std::abs(simulation.energy(mesh).total() / before - 1));
    }
    return std::pair{largest, simulation.energy(mesh).total() / before - 1};
  };
  const double h = 1e-4;
  CHECK(drift(Integrator::forward_euler, h).second > 0.1);
  const double coarse = drift(Integrator::semi_implicit_euler, h).first;
  const double fine = drift(Integrator::semi_implicit_euler, h / 4).first;
  CHECK(coarse < 0.01);
  CHECK(fine < coarse / 2);
}

TEST_CASE("Damping takes energy away until the cloth is at rest") {
  std::mt19937 random(6);
  cut::HybridMesh mesh = testing::built(scenes::hexagon(2, 0.5));
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::paper, 1, 1000, 1});
  testing::shake(mesh, simulation, random, 0.02, 0);
  double energy = simulation.energy(mesh).total();
  const double start = energy;
  for (int i = 0; i < 20; ++i) {
    REQUIRE_FALSE(simulation.step(mesh, 1e-4, 500));
    const double now = simulation.energy(mesh).total();
    CHECK(now < energy);
    energy = now;
  }
  CHECK(energy < 0.05 * start);
}

TEST_CASE("Energy of gravity becomes kinetic energy") {
  cut::HybridMesh mesh = testing::built(scenes::grid(2, 2));
  cut::Simulation simulation = testing::simulated(mesh, {});
  simulation.surroundings.gravity = {0, 0, -9.81};
  REQUIRE_FALSE(simulation.step(mesh, 1e-5, 10000));
  const cut::Energy energy = simulation.energy(mesh);
  CHECK(energy.kinetic == doctest::Approx(simulation.total_mass() * 0.981 * 0.981 / 2));
  CHECK(energy.gravity == doctest::Approx(-energy.kinetic).epsilon(1e-3));
  CHECK(energy.elastic < 1e-12);
}

// The simulation against closed forms: a damped oscillator, its energy, free fall, the speed that drag
// allows, a hanging chain.
#include <doctest/doctest.h>

#include <cmath>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;

namespace {

/// An equilateral triangle that stands on two anchored nodes; the third one swings up and down. For small
/// amplitudes its two springs act as one of stiffness 2 k cos²(30°).
struct Oscillator {
  static constexpr double side = 1;
  cut::HybridMesh mesh = testing::equilateral(side);
  cut::Simulation simulation;
  double mass, stiffness, damping;
  double rest_height = mesh.positions[2].y();
  static constexpr double amplitude = 1e-7;

  Oscillator(double k, double c, Integrator integrator)
      : simulation(testing::simulated(mesh, {cut::MaterialMode::conserving, 2, k, c})) {
    simulation.surroundings.integrator = integrator;
    simulation.anchor(NodeId{0u});
    simulation.anchor(NodeId{1u});
    mass = 2 * std::sqrt(3.0) / 4 * side * side / 3;
    stiffness = 1.5 * k;
    damping = 1.5 * c;
    mesh.positions[2].y() += amplitude;
  }
  double height() const { return (mesh.positions[2].y() - rest_height) / amplitude; }
};

/// Closed form of the damped oscillator that starts at 1 at rest.
double swing(double mass, double stiffness, double damping, double time) {
  const double decay = damping / (2 * mass);
  const double frequency = std::sqrt(stiffness / mass - decay * decay);
  return std::exp(-decay * time) *
         (std::cos(frequency * time) + decay / frequency * std::sin(frequency * time));
}

double largest_error(Integrator integrator, double time_step) {
  Oscillator o(100, 0.1, integrator);
  REQUIRE(o.simulation.mass(NodeId{2u}) == doctest::Approx(o.mass));
  double error = 0;
  for (int i = 1; i * time_step < 2; ++i) {
    REQUIRE_FALSE(o.simulation.step(o.mesh, time_step));
    error = std::max(error, std::abs(o.height() - swing(o.mass, o.stiffness, o.damping, i * time_step)));
  }
  return error;
}

}  // namespace

TEST_CASE("A damped oscillator has the frequency and decay of the closed form, to first order in the step") {
  for (const Integrator integrator : testing::integrators) {
    const double coarse = largest_error(integrator, 2e-5);
    const double fine = largest_error(integrator, 1e-5);
    CHECK(fine < 0.01);
    CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));
  }
}

TEST_CASE("Period and logarithmic decrement of a damped oscillator") {
  Oscillator o(100, 0.05, Integrator::semi_implicit_euler);
  const double h = 1e-5;
  std::vector<double> peak_times, peaks;
  double before = 2, now = 1;
  for (int i = 1; peaks.size() < 10; ++i) {
    REQUIRE_FALSE(o.simulation.step(o.mesh, h));
    const double next = o.height();
    if (now > before && now >= next && now > 0) {
      peak_times.push_back((i - 1) * h);
      peaks.push_back(now);
    }
    before = now;
    now = next;
  }
  const double decay = o.damping / (2 * o.mass);
  const double frequency = std::sqrt(o.stiffness / o.mass - decay * decay);
  const double period = (peak_times.back() - peak_times.front()) / 9;
  CHECK(period == doctest::Approx(2 * std::acos(-1.0) / frequency).epsilon(1e-4));
  CHECK(std::log(peaks.front() / peaks.back()) / 9 == doctest::Approx(decay * period).epsilon(1e-3));
}

TEST_CASE("The energy of an undamped oscillator: grows, stays, decays as the scheme's closed form") {
  const double h = 1e-3;
  const int steps = 500;
  for (const Integrator integrator : testing::integrators) {
    Oscillator o(100, 0, integrator);
    const double factor = 1 + o.stiffness / o.mass * h * h;
    const auto energy = [&] {
      const double x = o.mesh.positions[2].y() - o.rest_height, v = o.simulation.velocity(NodeId{2u}).y();
      // Semi-implicit Euler conserves this one exactly.
      const double mixed = integrator == Integrator::semi_implicit_euler ? h * o.stiffness * x * v : 0;
      return (o.mass * v * v + o.stiffness * x * x - mixed) / 2;
    };
    const double before = energy();
    REQUIRE_FALSE(o.simulation.step(o.mesh, h, steps));
    const double growth = std::log(energy() / before) / steps;
    const double expected = integrator == Integrator::forward_euler    ? std::log(factor)
                            : integrator == Integrator::implicit_euler ? -std::log(factor)
                                                                       : 0;
    CHECK(growth == doctest::Approx(expected).epsilon(1e-3 * std::log(factor)).scale(1));
  }
}

TEST_CASE("The energy of an undamped cloth grows, swings, decays") {
  for (const Integrator integrator : testing::integrators) {
    std::mt19937 random(5);
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 5, 0.3, 8));
    cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0});
    simulation.surroundings.integrator = integrator;
    testing::shake(mesh, simulation, random, 0.005, 0.05);
    const double h = 0.1 * simulation.stable_time_step(Integrator::semi_implicit_euler);
    const double first = simulation.energy(mesh).total();
    double least = first, most = first;
    for (int i = 0; i < 1000; ++i) {
      REQUIRE_FALSE(simulation.step(mesh, h));
      const double now = simulation.energy(mesh).total();
      least = std::min(least, now);
      most = std::max(most, now);
      if (integrator == Integrator::implicit_euler) REQUIRE(now <= least);
    }
    const double last = simulation.energy(mesh).total();
    if (integrator == Integrator::forward_euler) CHECK(last > 1.5 * first);
    if (integrator == Integrator::implicit_euler) CHECK(last < 0.8 * first);
    if (integrator == Integrator::semi_implicit_euler) CHECK((most - least) < 0.1 * first);
  }
}

TEST_CASE("Free fall is the closed form of the discrete scheme to the bit, and leaves springs at rest") {
  // All numbers are multiples of a power of two: no operation of an explicit step rounds.
  const double h = 1.0 / 64, g = -8;
  const int steps = 100;
  for (const Integrator integrator : testing::integrators) {
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 4, 0.3, 7));
    const std::vector<Eigen::Vector3d> start = mesh.positions;
    cut::Simulation simulation = testing::simulated(mesh, {});
    simulation.surroundings.integrator = integrator;
    simulation.surroundings.gravity = {0, 0, g};
    REQUIRE_FALSE(simulation.step(mesh, h, steps));
    const int n = integrator == Integrator::forward_euler ? steps * (steps - 1) : steps * (steps + 1);
    const double rounding = integrator == Integrator::implicit_euler ? 1e-6 : 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Eigen::Vector3d place(start[i].x(), start[i].y(), g * h * h * n / 2);
      CHECK((mesh.positions[i] - place).norm() <= rounding);
      CHECK((simulation.velocity(NodeId{i}) - Eigen::Vector3d(0, 0, g * h * steps)).norm() <= rounding);
    }
  }
}

TEST_CASE("Air drag leads to the speed at which it balances gravity, and wind carries cloth along") {
  for (const Integrator integrator : testing::integrators) {
    cut::HybridMesh mesh = testing::built(scenes::grid(2, 2));
    cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.5, 10, 0.1});
    simulation.surroundings.integrator = integrator;
    simulation.surroundings.gravity = {0, 0, -10};
    simulation.surroundings.air_drag = 2;
    simulation.surroundings.wind = {3, 0, 0};
    simulation.surroundings.longest_way = 1;
    REQUIRE_FALSE(simulation.step(mesh, 0.01, 1000));
    CHECK((simulation.velocity(NodeId{4u}) - Eigen::Vector3d(3, 0, -10 * 0.5 / 2)).norm() < 1e-9);
  }
}

TEST_CASE("A ribbon that hangs from its two ends is a catenary") {
  const std::size_t cells = 40;
  const double span = 0.8, step = 1.0 / cells;
  cut::HybridMesh mesh = testing::built(scenes::grid(cells, 1, step));
  cut::Material material{cut::MaterialMode::conserving, 0.2, 5000, 0.5, 0, 0};
  cut::Simulation simulation = testing::simulated(mesh, material);
  simulation.surroundings.gravity = {0, 0, -9.81};
  simulation.surroundings.air_drag = 0.4;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    Eigen::Vector3d& p = mesh.positions[n];
    if (p.x() < 1e-9 || p.x() > 1 - 1e-9) simulation.anchor(NodeId{n});
    p = {span * (p.x() - 0.5), p.y(), p.x() * (p.x() - 1)};
  }
  mesh.moved();
  simulation.surroundings.integrator = Integrator::implicit_euler;
  REQUIRE_FALSE(simulation.step(mesh, 1.0 / 60, 600));
  // The length is that of the ribbon: 2 a sinh(span / 2a) = 1.
  double low = 0.01, high = 10;
  for (int i = 0; i < 100; ++i) {
    const double a = (low + high) / 2;
    (2 * a * std::sinh(span / (2 * a)) > 1 ? low : high) = a;
  }
  const double a = low;
  const double sag = a * (std::cosh(span / (2 * a)) - 1);
  for (const Eigen::Vector3d& p : mesh.positions)
    CHECK(
        p.z() ==
        doctest::Approx(a * (std::cosh(p.x() / a) - std::cosh(span / (2 * a)))).epsilon(0.01 * sag).scale(1));
  // It hangs still for the explicit integrator as well.
  const std::vector<Eigen::Vector3d> hanging = mesh.positions;
  simulation.surroundings.integrator = Integrator::semi_implicit_euler;
  REQUIRE_FALSE(
      simulation.step(mesh, 0.5 * simulation.stable_time_step(Integrator::semi_implicit_euler), 2000));
  for (std::size_t n = 0; n < hanging.size(); ++n)
    CHECK((mesh.positions[n] - hanging[n]).norm() < 1e-4 * sag);
}

TEST_CASE("A force on an anchored node does nothing, even if it is no number") {
  const auto fallen = [](Integrator integrator, double force) {
    cut::HybridMesh mesh = testing::built(scenes::grid(3, 3));
    cut::Simulation simulation = testing::simulated(mesh, {});
    simulation.surroundings.integrator = integrator;
    simulation.surroundings.gravity = {0, 0, -10};
    simulation.anchor(NodeId{0u});
    simulation.set_force(NodeId{0u}, {force, 0, 0});
    const auto error = simulation.step(mesh, 1e-3, 20);
    CAPTURE((error ? error->message : ""));
    REQUIRE_FALSE(error);
    return mesh.positions;
  };
  for (const Integrator integrator : testing::integrators)
    CHECK(fallen(integrator, std::nan("")) == fallen(integrator, 0));
}

TEST_CASE("A constant force on one node and on its anchor") {
  cut::HybridMesh mesh = testing::built(scenes::grid(1, 1));
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 1, 0, 0});
  simulation.set_force(NodeId{0u}, {2, 0, 0});
  simulation.set_force(NodeId{3u}, {2, 0, 0});
  simulation.anchor(NodeId{3u});
  REQUIRE_FALSE(simulation.step(mesh, 0.125, 4));
  CHECK(simulation.velocity(NodeId{0u}).x() ==
        doctest::Approx(0.5 * 2 / simulation.mass(NodeId{0u})).epsilon(1e-14));
  CHECK(simulation.velocity(NodeId{1u}).x() == 0);
  CHECK(mesh.positions[3] == Eigen::Vector3d(1, 1, 0));
  CHECK(simulation.force(NodeId{0u}) == Eigen::Vector3d(2, 0, 0));
}

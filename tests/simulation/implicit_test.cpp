// The implicit step: stiff cloth at frame rate, what it conserves, what it says when it fails; and air across
// the cloth, which all integrators know.
#include <doctest/doctest.h>

#include <cmath>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <limits>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;
using Eigen::Vector3d;

namespace {

constexpr double frame = 1.0 / 60;

struct Stiff {
  cut::HybridMesh mesh = testing::built(scenes::random_sheet(8, 8, 0.1, 4));
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 5000, 0.5});
  Stiff() { simulation.surroundings.integrator = Integrator::implicit_euler; }
};

}  // namespace

TEST_CASE(
    "Stiff cloth at frame rate stays whole, before and after cuts, where explicit steps have to be far "
    "smaller") {
  Stiff s;
  CHECK(s.simulation.stable_time_step(Integrator::semi_implicit_euler) < 2e-4);
  CHECK(std::isinf(s.simulation.stable_time_step(Integrator::implicit_euler)));
  CHECK(std::isinf(s.simulation.cut_proof_time_step(Integrator::implicit_euler, s.mesh)));
  s.simulation.surroundings.gravity = {0, 0, -9.81};
  s.simulation.surroundings.air_drag = 0.1;
  s.simulation.surroundings.normal_drag = 1;
  s.simulation.surroundings.wind = {0, 3, 0};
  s.simulation.anchor(cut::AncestorNodeId{0u}, s.mesh);
  s.simulation.anchor(cut::AncestorNodeId{8u}, s.mesh);
  cut::Cutter cutter(cut::default_merge_distances(s.mesh));
  for (int k = 0; k < 4; ++k) {
    REQUIRE_FALSE(s.simulation.step(s.mesh, frame, 60));
    const Vector3d centre = s.simulation.centre_of_mass(s.mesh);
    const auto changes =
        cutter.cut(s.mesh, scenes::plane(centre + Vector3d(0.05 * k, 0, 0), {0.3, 0.1 * k, 0}, {0, 0.1, 3}));
    REQUIRE(changes);
    REQUIRE_FALSE(s.simulation.apply(*changes, s.mesh));
    CHECK(cut::validate(s.mesh).empty());
  }
  CHECK(s.mesh.positions.size() > 81);
  REQUIRE_FALSE(s.simulation.step(s.mesh, frame, 60));
  for (const Vector3d& p : s.mesh.positions) CHECK(p.norm() < 1e4);
}

TEST_CASE("An implicit step conserves momentum whatever its tolerance, and gives the same bits again") {
  for (const double tolerance : {1e-5, 1e-8}) {
    CAPTURE(tolerance);
    const auto run = [&] {
      Stiff s;
      s.simulation.surroundings.tolerance = tolerance;
      std::mt19937 random(1);
      testing::shake(s.mesh, s.simulation, random, 0.01, 1);
      const Vector3d before = s.simulation.momentum();
      const auto error = s.simulation.step(s.mesh, frame, 100);
      CAPTURE((error ? error->message : ""));
      REQUIRE_FALSE(error);
      CHECK((s.simulation.momentum() - before).norm() < 1e-12 * s.simulation.total_mass());
      return s.mesh.positions;
    };
    CHECK(run() == run());
  }
}

TEST_CASE("Explicit steps conserve momentum, semi-implicit ones angular momentum as well") {
  for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler}) {
    Stiff s;
    s.simulation.surroundings.integrator = integrator;
    std::mt19937 random(1);
    testing::shake(s.mesh, s.simulation, random, 0.01, 1);
    const Vector3d momentum = s.simulation.momentum(), turning = s.simulation.angular_momentum(s.mesh);
    REQUIRE_FALSE(s.simulation.step(s.mesh, 1e-5, 1000));
    CHECK((s.simulation.momentum() - momentum).norm() < 1e-12 * s.simulation.total_mass());
    if (integrator == Integrator::semi_implicit_euler)
      CHECK((s.simulation.angular_momentum(s.mesh) - turning).norm() < 1e-12 * s.simulation.total_mass());
  }
}

TEST_CASE(
    "An implicit step that does not converge, blows up or meets what is not finite keeps the last good "
    "state") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int fault : {0, 1, 2, 3, 4}) {
    CAPTURE(fault);
    Stiff s;
    std::mt19937 random(1);
    testing::shake(s.mesh, s.simulation, random, 0.01, 1);
    REQUIRE_FALSE(s.simulation.step(s.mesh, frame, 3));
    if (fault == 0) s.simulation.surroundings.most_iterations = 2;
    if (fault == 1) s.simulation.set_force(NodeId{7u}, {1e9, 0, 0});
    if (fault == 2) s.simulation.set_force(NodeId{7u}, {nan, 0, 0});
    if (fault == 3) s.mesh.positions[7].y() = nan;
    if (fault == 4) s.mesh.positions[7].y() = 1e60;
    const cut::HybridMesh mesh = s.mesh;
    const cut::Simulation simulation = s.simulation;
    const auto error = s.simulation.step(s.mesh, frame, 5);
    REQUIRE(error);
    CHECK(error->kind == (fault == 0 ? cut::Error::Kind::not_converged : cut::Error::Kind::unstable));
    CHECK(error->message.find("step 4") != std::string::npos);
    CHECK(error->message.find("node " + std::to_string(error->element)) != std::string::npos);
    if (fault > 1) CHECK(error->element == 7);
    CHECK(s.simulation.updates() == 3);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (n != 7) CHECK(s.mesh.positions[n] == mesh.positions[n]);
      CHECK(s.simulation.velocity(NodeId{n}) == simulation.velocity(NodeId{n}));
    }
  }
}

TEST_CASE("Anchors keep their place and their velocity in implicit steps") {
  Stiff s;
  s.simulation.surroundings.gravity = {0, 0, -9.81};
  s.simulation.anchor(NodeId{0u});
  s.simulation.anchor(NodeId{8u});
  s.simulation.set_velocity(NodeId{8u}, {0.25, 0, 0});
  const Vector3d still = s.mesh.positions[0], moving = s.mesh.positions[8];
  REQUIRE_FALSE(s.simulation.step(s.mesh, 1.0 / 64, 64));
  CHECK(s.mesh.positions[0] == still);
  CHECK(s.mesh.positions[8] == Vector3d(moving + Vector3d(0.25, 0, 0)));
}

TEST_CASE(
    "Air across the cloth: a flat sheet falls at the speed that balances gravity, an upright one falls "
    "freely") {
  for (const Integrator integrator : testing::integrators)
    for (const bool upright : {false, true}) {
      cut::HybridMesh mesh = testing::built(scenes::grid(3, 3, 0.1));
      cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.5, 10, 0.1});
      if (upright)
        for (Vector3d& p : mesh.positions) p = {p.x(), 0, p.y()};
      mesh.moved();
      simulation.surroundings.integrator = integrator;
      simulation.surroundings.gravity = {0, 0, -10};
      simulation.surroundings.normal_drag = 4;
      REQUIRE_FALSE(simulation.step(mesh, 1e-3, 4000));
      for (std::size_t n = 0; n < mesh.positions.size(); ++n)
        CHECK((simulation.velocity(NodeId{n}) - Vector3d(0, 0, upright ? -40 : -10 * 0.5 / 4)).norm() < 1e-4);
    }
}

TEST_CASE("Air across the cloth pushes a cut cloth as the whole one") {
  std::array<Vector3d, 2> momentum;
  for (const bool cut : {false, true}) {
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(5, 5, 0.2, 3));
    cut::Simulation simulation = testing::simulated(mesh, {});
    for (Vector3d& p : mesh.positions) p.z() = 0.2 * std::sin(3 * p.x() + p.y());
    mesh.moved();
    if (cut) {
      cut::Cutter cutter(cut::default_merge_distances(mesh));
      const auto changes = cutter.cut(mesh, scenes::plane({0.5, 0.45, 0}, {2, 0.3, 0}, {0, 0, 1}));
      REQUIRE(changes);
      REQUIRE_FALSE(simulation.apply(*changes, mesh));
      CHECK(mesh.positions.size() > 36);
    }
    simulation.surroundings.normal_drag = 2;
    simulation.surroundings.wind = {1, 2, 5};
    REQUIRE_FALSE(simulation.step(mesh, 1e-6));
    momentum[cut] = simulation.momentum();
  }
  CHECK(momentum[0].norm() > 0);
  CHECK((momentum[0] - momentum[1]).norm() < 1e-9 * momentum[0].norm());
}

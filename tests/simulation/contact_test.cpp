// Obstacles: nodes stay out, friction follows Coulomb's law, nothing else changes; for all integrators.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;
using Eigen::Vector3d;

namespace {

struct Block {
  cut::HybridMesh mesh = testing::built(scenes::random_sheet(4, 3, 0.1, 6));
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.1});

  explicit Block(Integrator integrator) { simulation.surroundings.integrator = integrator; }
  /// Onto a plane through the origin that is tilted about y; gravity as usual.
  void lay_on_slope(double angle, double friction) {
    const Eigen::AngleAxisd tilt(angle, Vector3d::UnitY());
    for (Vector3d& p : mesh.positions) p = tilt * p;
    mesh.moved();
    simulation.surroundings.gravity = {0, 0, -9.81};
    cut::HalfSpace plane;
    plane.normal = 3 * (tilt * Vector3d::UnitZ());
    plane.friction = friction;
    simulation.surroundings.half_spaces = {plane};
  }
};

double lowest(const cut::HybridMesh& mesh, const cut::HalfSpace& o) {
  double least = 1e300;
  for (const Vector3d& p : mesh.positions) least = std::min(least, (p - o.point).dot(o.normal.normalized()));
  return least;
}

}  // namespace

TEST_CASE("A block on a slope sticks below the friction angle and slides above it with g (sin - mu cos)") {
  const double angle = 0.5, h = 2e-4;
  for (const Integrator integrator : testing::integrators)
    for (const double friction : {0.0, 0.3, 0.99 * std::tan(angle), 1.01 * std::tan(angle), 2.0}) {
      CAPTURE(friction);
      CAPTURE(static_cast<int>(integrator));
      Block block(integrator);
      block.lay_on_slope(angle, friction);
      const std::vector<Vector3d> start = block.mesh.positions;
      REQUIRE_FALSE(block.simulation.step(block.mesh, h, 2500));
      const double acceleration = std::max(0.0, 9.81 * (std::sin(angle) - friction * std::cos(angle)));
      const Vector3d down(std::cos(angle), 0, -std::sin(angle));
      for (std::size_t n = 0; n < start.size(); ++n) {
        CHECK((block.simulation.velocity(NodeId{n}) - 0.5 * acceleration * down).norm() < 1e-8);
        const double steps = integrator == Integrator::forward_euler ? 2499 : 2501;
        CHECK((block.mesh.positions[n] - start[n] - 0.5 * acceleration * 2500 * steps * h * h * down).norm() <
              1e-8);
      }
      CHECK(lowest(block.mesh, block.simulation.surroundings.half_spaces[0]) > -1e-11);
    }
}

TEST_CASE("Friction slows down a sliding block evenly, stops it, and never turns it round") {
  for (const Integrator integrator : testing::integrators) {
    Block block(integrator);
    block.lay_on_slope(0, 0.5);
    for (std::size_t n = 0; n < block.mesh.positions.size(); ++n)
      block.simulation.set_velocity(NodeId{n}, {0.3, -0.4, 0});
    const double h = 2e-4, stop = 0.5 / (0.5 * 9.81);
    for (int i = 1; i < 1000; ++i) {
      REQUIRE_FALSE(block.simulation.step(block.mesh, h));
      const double left = std::max(0.0, 1 - i * h / stop);
      for (std::size_t n = 0; n < block.mesh.positions.size(); n += 5)
        CHECK((block.simulation.velocity(NodeId{n}) - left * Vector3d(0.3, -0.4, 0)).norm() < 1e-8);
    }
  }
}

TEST_CASE("Cloth that falls onto a ball and a floor goes into neither, at any time") {
  for (const Integrator integrator : testing::integrators)
    for (const double friction : {0.0, 0.4}) {
      CAPTURE(static_cast<int>(integrator));
      cut::HybridMesh mesh = testing::built(scenes::grid(12, 12, 1.0 / 12));
      for (Vector3d& p : mesh.positions) p += Vector3d(-0.5, -0.5, 0.05);
      mesh.moved();
      cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 50, 0.05});
      cut::Surroundings& s = simulation.surroundings;
      s.integrator = integrator;
      s.gravity = {0, 0, -9.81};
      s.spheres = {{{0.02, 0.01, -0.3}, 0.3, {0, 0, 0}, friction}};
      s.half_spaces = {{{0, 0, -0.4}, {0, 0, 1}, {0, 0, 0}, friction}};
      const double h = integrator == Integrator::implicit_euler ? 1.0 / 60 : 2e-4;
      const int steps = static_cast<int>(1 / h);
      bool touched = false;
      for (int i = 0; i < steps; ++i) {
        REQUIRE_FALSE(simulation.step(mesh, h));
        for (const Vector3d& p : mesh.positions) {
          const double distance = (p - s.spheres[0].centre).norm() - 0.3;
          touched |= distance < 1e-6;
          // Where ball and floor meet, both push in turn.
          REQUIRE(distance > -1e-6);
          REQUIRE(p.z() + 0.4 > -1e-6);
        }
      }
      CHECK(touched);
    }
}

TEST_CASE(
    "Without friction a floor leaves momentum along it, and cloth that touches nothing moves to the bit as "
    "without obstacles") {
  for (const Integrator integrator : testing::integrators) {
    std::mt19937 random(2);
    Block block(integrator);
    testing::shake(block.mesh, block.simulation, random, 0.01, 0.1);
    Block other = block;
    block.simulation.surroundings.half_spaces = {{{0, 0, -50}, {0, 0, 1}, {0, 0, 0}, 1}};
    REQUIRE_FALSE(block.simulation.step(block.mesh, 2e-4, 500));
    REQUIRE_FALSE(other.simulation.step(other.mesh, 2e-4, 500));
    CHECK(block.mesh.positions == other.mesh.positions);

    block.simulation.surroundings.half_spaces[0].point.z() = -0.02;
    block.simulation.surroundings.half_spaces[0].friction = 0;
    block.simulation.surroundings.gravity = {0, 0, -9.81};
    const Vector3d before = block.simulation.momentum();
    REQUIRE_FALSE(block.simulation.step(block.mesh, 2e-4, 2500));
    const Vector3d after = block.simulation.momentum();
    const double tolerance = integrator == Integrator::implicit_euler ? 1e-6 : 1e-12;
    CHECK(std::abs(after.x() - before.x()) < tolerance * block.simulation.total_mass());
    CHECK(std::abs(after.y() - before.y()) < tolerance * block.simulation.total_mass());
    CHECK(lowest(block.mesh, block.simulation.surroundings.half_spaces[0]) > -1e-11);
  }
}

TEST_CASE("Moving obstacles carry cloth along, and are where their velocity brings them") {
  for (const Integrator integrator : testing::integrators) {
    Block block(integrator);
    block.lay_on_slope(0, 0.8);
    block.simulation.surroundings.half_spaces[0].velocity = {0.2, 0, 0.1};
    block.simulation.surroundings.spheres = {{{0, 0, -9}, 1, {1, 0, 0}, 0}};
    REQUIRE_FALSE(block.simulation.step(block.mesh, 1.0 / 4096, 2048));
    CHECK(block.simulation.surroundings.half_spaces[0].point.z() == doctest::Approx(0.05).epsilon(1e-12));
    CHECK(block.simulation.surroundings.spheres[0].centre.x() == doctest::Approx(0.5).epsilon(1e-12));
    for (std::size_t n = 0; n < block.mesh.positions.size(); ++n)
      CHECK((block.simulation.velocity(NodeId{n}) - Vector3d(0.2, 0, 0.1)).norm() < 1e-7);
    CHECK(lowest(block.mesh, block.simulation.surroundings.half_spaces[0]) > -1e-11);
  }
}

TEST_CASE(
    "Cloth that starts inside of an obstacle is put on its surface, and anchored nodes go where they want") {
  for (const Integrator integrator : testing::integrators) {
    Block block(integrator);
    block.simulation.surroundings.half_spaces = {{{0, 0, 0.01}, {0, 0, 1}, {0, 0, 0}, 0}};
    block.simulation.anchor(NodeId{3u});
    const Vector3d held = block.mesh.positions[3];
    REQUIRE_FALSE(block.simulation.step(block.mesh, 1e-4));
    CHECK(block.mesh.positions[3] == held);
    for (std::size_t n = 0; n < block.mesh.positions.size(); ++n)
      if (n != 3) CHECK(block.mesh.positions[n].z() == doctest::Approx(0.01).epsilon(1e-3));
    CHECK(block.simulation.velocity(NodeId{0u}).norm() < 1);
  }
}

TEST_CASE("In a corner of two walls nodes stay out of both") {
  for (const Integrator integrator : testing::integrators) {
    Block block(integrator);
    cut::Surroundings& s = block.simulation.surroundings;
    s.gravity = {-5, 0, -8};
    s.half_spaces = {{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.2}, {{0, 0, 0}, {2, 0, 1}, {0, 0, 0}, 0.2}};
    for (Vector3d& p : block.mesh.positions) p += Vector3d(0.1, 0, 0.05);
    for (int i = 0; i < 2500; ++i) {
      REQUIRE_FALSE(block.simulation.step(block.mesh, 2e-4));
      for (const cut::HalfSpace& o : s.half_spaces) REQUIRE(lowest(block.mesh, o) > -1e-9);
    }
  }
}

TEST_CASE("Friction of stiff cloth over an edge does not depend on the integrator") {
  // A ribbon lies on a rough table and is pulled by a force at its end: it holds up to mu m g, and slides
  // above.
  for (const Integrator integrator : {Integrator::semi_implicit_euler, Integrator::implicit_euler})
    for (const double part : {0.9, 1.1}) {
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(part);
      cut::HybridMesh mesh = testing::built(scenes::grid(10, 1, 0.1));
      cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 3000, 0.3});
      cut::Surroundings& s = simulation.surroundings;
      s.integrator = integrator;
      s.gravity = {0, 0, -10};
      s.half_spaces = {{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 0.5}};
      const double most = 0.5 * simulation.total_mass() * 10;
      simulation.set_force(NodeId{10u}, {part * most / 2, 0, 0});
      simulation.set_force(NodeId{21u}, {part * most / 2, 0, 0});
      const bool implicit = integrator == Integrator::implicit_euler;
      const double h = implicit ? 1.0 / 60 : 5e-5;
      const auto error = simulation.step(mesh, h, static_cast<std::size_t>(2 / h));
      CAPTURE((error ? error->message : ""));
      REQUIRE_FALSE(error);
      const double speed = simulation.momentum().x() / simulation.total_mass();
      if (part < 1)
        CHECK(std::abs(speed) < 1e-3);
      else
        CHECK(speed == doctest::Approx(0.1 * 0.5 * 10 * 2).epsilon(0.15));
    }
}

TEST_CASE("Implicit steps find a solution when friction and push chase each other") {
  // Without averaged limits of friction the second step has none.
  cut::HybridMesh mesh = testing::built(scenes::grid(12, 12, 0.1));
  for (Vector3d& p : mesh.positions) p += Vector3d(-0.6, -0.6, 0.72);
  mesh.moved();
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.3, 300, 0.2});
  cut::Surroundings& s = simulation.surroundings;
  s.integrator = Integrator::implicit_euler;
  s.gravity = {0, 0, -9.81};
  s.spheres = {{{0, 0, 0.35}, 0.35, {0, 0, 0}, 5}};
  s.half_spaces = {{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 5}};
  for (int i = 0; i < 40; ++i) {
    const auto error = simulation.step(mesh, 1.0 / 20);
    CAPTURE((error ? error->message : ""));
    REQUIRE_FALSE(error);
    for (const Vector3d& p : mesh.positions) REQUIRE((p - s.spheres[0].centre).norm() > 0.35 - 1e-6);
  }
}

TEST_CASE("Obstacles out of range are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& change) {
    Block block(Integrator::semi_implicit_euler);
    change(block.simulation.surroundings);
    const auto before = block.mesh.positions;
    const auto error = block.simulation.step(block.mesh, 1e-3);
    return error && error->kind == cut::Error::Kind::bad_parameter && block.mesh.positions == before;
  };
  const auto plane = [&](const cut::HalfSpace& o) {
    return refused([&](cut::Surroundings& s) { s.half_spaces = {o}; });
  };
  const auto ball = [&](const cut::Sphere& o) {
    return refused([&](cut::Surroundings& s) { s.spheres = {o}; });
  };
  CHECK_FALSE(plane({}));
  CHECK(plane({{0, 0, nan}, {0, 0, 1}, {0, 0, 0}, 0}));
  CHECK(plane({{0, 0, -9}, {0, 0, 0}, {0, 0, 0}, 0}));
  CHECK(plane({{0, 0, -9}, {0, 0, 1}, {0, nan, 0}, 0}));
  CHECK(plane({{0, 0, -9}, {0, 0, 1}, {0, 1e9, 0}, 0}));
  CHECK(plane({{0, 0, -9}, {0, 0, 1}, {0, 0, 0}, -1}));
  CHECK(ball({{0, 0, -9}, 0, {0, 0, 0}, 0}));
  CHECK(ball({{0, 0, -9}, nan, {0, 0, 0}, 0}));
  CHECK(ball({{0, 0, -9}, 1, {0, 0, 0}, nan}));
  CHECK(refused([&](cut::Surroundings& s) { s.gravity.x() = nan; }));
  CHECK(refused([&](cut::Surroundings& s) { s.wind.x() = nan; }));
  CHECK(refused([&](cut::Surroundings& s) { s.air_drag = -1; }));
  CHECK(refused([&](cut::Surroundings& s) { s.normal_drag = nan; }));
  CHECK(refused([&](cut::Surroundings& s) { s.tolerance = 0; }));
}

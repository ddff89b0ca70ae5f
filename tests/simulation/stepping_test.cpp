// Springs of an uncut mesh, anchors, blow-ups and wrong parameters; both versions of the loops.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "simulation/kernels.hpp"
#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::NodeId;

TEST_CASE("The paper's patch has 12 nodes and 23 springs, and its area's mass") {
  const cut::HybridMesh mesh = testing::built(scenes::twelve_triangles(0.1));
  for (const auto mode : {cut::MaterialMode::paper, cut::MaterialMode::conserving}) {
    const cut::Simulation simulation = testing::simulated(mesh, {mode, 0.3, 40, 0.2});
    CHECK(simulation.node_count() == 12);
    CHECK(simulation.spring_count() == 23);
    CHECK(simulation.total_mass() == doctest::Approx(0.3 * 12 * std::sqrt(3.0) / 4 * 0.01));
    for (std::size_t i = 0; i < 23; ++i) {
      CHECK(simulation.stiffness(cut::SpringId{i}) == 40);
      CHECK(simulation.damping(cut::SpringId{i}) == 0.2);
    }
  }
}

TEST_CASE("Both materials move an uncut cloth alike, to the bit") {
  std::vector<Eigen::Vector3d> first;
  for (const auto mode : {cut::MaterialMode::paper, cut::MaterialMode::conserving}) {
    std::mt19937 random(3);
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(4, 4, 0.5, 3));
    cut::Simulation simulation = testing::simulated(mesh, {mode});
    testing::shake(mesh, simulation, random, 0.05, 1);
    REQUIRE_FALSE(simulation.step(mesh, 1e-4, 500));
    if (first.empty()) first = mesh.positions;
    CHECK(first == mesh.positions);
  }
}

TEST_CASE("Anchored nodes stay, moving anchors move evenly, released nodes fall") {
  cut::HybridMesh mesh = testing::built(scenes::grid(3, 3));
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 1, 50, 1});
  simulation.surroundings.gravity = {0, 0, -10};
  simulation.anchor(cut::AncestorNodeId{0u}, mesh);
  simulation.anchor(NodeId{3u});
  simulation.set_velocity(NodeId{3u}, {0, 0, 0.25});
  const Eigen::Vector3d corner = mesh.positions[0], moving = mesh.positions[3];
  REQUIRE_FALSE(simulation.step(mesh, 1.0 / 256, 256));
  CHECK(simulation.anchored(NodeId{0u}));
  CHECK(mesh.positions[0] == corner);
  CHECK(mesh.positions[3] == Eigen::Vector3d(moving + Eigen::Vector3d(0, 0, 0.25)));
  CHECK(mesh.positions[5].z() < -0.5);
  simulation.release(NodeId{0u});
  REQUIRE_FALSE(simulation.step(mesh, 1.0 / 256, 16));
  CHECK(mesh.positions[0].z() < 0);
}

TEST_CASE("A step starts from the mesh's positions, counts and tells the mesh") {
  cut::HybridMesh mesh = testing::built(scenes::grid(1, 1));
  cut::Simulation simulation = testing::simulated(mesh, {});
  const std::uint64_t before = mesh.state;
  REQUIRE_FALSE(simulation.step(mesh, 0.01, 3));
  CHECK(simulation.updates() == 3);
  CHECK(mesh.state != before);
  for (auto& p : mesh.positions) p.z() += 5;
  REQUIRE_FALSE(simulation.step(mesh, 0.01));
  CHECK(mesh.positions[2].z() == 5);
  CHECK(simulation.updates() == 4);
}

TEST_CASE("A blow-up names step and node and leaves the state before that step") {
  for (const Integrator integrator : {Integrator::forward_euler, Integrator::semi_implicit_euler}) {
    const auto run = [&](std::size_t steps, cut::HybridMesh& mesh, cut::Simulation& simulation) {
      std::mt19937 random(8);
      simulation.surroundings.integrator = integrator;
      testing::shake(mesh, simulation, random, 1e-6, 0);
      return simulation.step(mesh, 1.5 * simulation.stable_time_step(Integrator::semi_implicit_euler), steps);
    };
    cut::HybridMesh mesh = testing::built(scenes::random_sheet(6, 6, 0.3, 2));
    cut::Simulation simulation = testing::simulated(mesh, {});
    const auto error = run(100000, mesh, simulation);
    REQUIRE(error);
    CHECK(error->kind == cut::Error::Kind::unstable);
    const std::size_t good = simulation.updates();
    CHECK(good > 5);
    CHECK(good < 1000);
    CHECK(error->message.find("step " + std::to_string(good + 1)) != std::string::npos);
    CHECK(error->message.find("node " + std::to_string(error->element)) != std::string::npos);

    cut::HybridMesh again = testing::built(scenes::random_sheet(6, 6, 0.3, 2));
    cut::Simulation other = testing::simulated(again, {});
    REQUIRE_FALSE(run(good, again, other));
    CHECK(mesh.positions == again.positions);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n)
      CHECK(simulation.velocity(NodeId{n}) == other.velocity(NodeId{n}));
  }
}

TEST_CASE("A velocity or position that is not finite is found at once") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  cut::HybridMesh mesh = testing::built(scenes::grid(2, 2));
  cut::Simulation simulation = testing::simulated(mesh, {});
  simulation.set_velocity(NodeId{4u}, {0, nan, 0});
  auto error = simulation.step(mesh, 0.01);
  REQUIRE(error);
  CHECK(error->kind == cut::Error::Kind::unstable);
  simulation.set_velocity(NodeId{4u}, {0, 0, 0});
  CHECK_FALSE(simulation.step(mesh, 0.01));
  mesh.positions[1].x() = std::numeric_limits<double>::infinity();
  CHECK(simulation.step(mesh, 0.01));
  CHECK(simulation.updates() == 1);
}

TEST_CASE("Wrong parameters are refused") {
  cut::HybridMesh mesh = testing::built(scenes::grid(2, 2));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const cut::Material& bad :
       {cut::Material{cut::MaterialMode::paper, 0, 1, 1}, cut::Material{cut::MaterialMode::paper, -1, 1, 1},
        cut::Material{cut::MaterialMode::paper, nan, 1, 1}, cut::Material{cut::MaterialMode::paper, 1, -1, 1},
        cut::Material{cut::MaterialMode::paper, 1, 1, nan}}) {
    const auto result = cut::Simulation::build(mesh, bad);
    REQUIRE_FALSE(result);
    CHECK(result.error().kind == cut::Error::Kind::bad_parameter);
  }
  cut::Simulation simulation = testing::simulated(mesh, {});
  for (const double h : {0.0, -0.1, nan, std::numeric_limits<double>::infinity()}) {
    const auto error = simulation.step(mesh, h);
    REQUIRE(error);
    CHECK(error->kind == cut::Error::Kind::bad_parameter);
  }
  for (const double way : {-1.0, nan, std::numeric_limits<double>::infinity(), 1e50}) {
    simulation.surroundings.longest_way = way;
    const auto error = simulation.step(mesh, 0.01);
    REQUIRE(error);
    CHECK(error->kind == cut::Error::Kind::bad_parameter);
  }
  simulation.surroundings.longest_way = 0;
  ++mesh.topology_version;
  CHECK(simulation.step(mesh, 0.01)->kind == cut::Error::Kind::bad_parameter);
}

TEST_CASE("Nodes at the same place exert no force on each other") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::paper, 1, 0.01, 0});
  mesh.positions[1] = mesh.positions[0];
  REQUIRE_FALSE(simulation.step(mesh, 0.01));
  CHECK(mesh.positions[1] == mesh.positions[0]);
}

TEST_CASE("The loops for AVX2 give the bits of the plain ones") {
  std::mt19937 random(4);
  const std::size_t nodes = 50, springs = 200;
  std::vector<cut::ListedSprings> arrays(springs / 4);
  std::vector<cut::PaddedVector> positions, velocities, forces;
  std::vector<double> inverse_mass;
  const auto padded = [&](double size) {
    const Eigen::Vector3d v = testing::random_vector(random, size);
    return cut::PaddedVector{v.x(), v.y(), v.z(), 0};
  };
  for (std::size_t n = 0; n < nodes; ++n) {
    positions.push_back(n % 7 == 1 ? positions.back() : padded(1));
    velocities.push_back(n % 5 == 0 ? cut::PaddedVector{-0.0, 0.0, -0.0, 0} : padded(1));
    forces.push_back(padded(10));
    inverse_mass.push_back(n % 6 == 0 ? 0 : 1 + 0.01 * static_cast<double>(n));
  }
  for (std::size_t i = 0; i < springs; ++i) {
    const auto a = static_cast<std::uint32_t>(random() % nodes),
               b = static_cast<std::uint32_t>(random() % nodes);
    cut::ListedSprings& four = arrays[i / 4];
    four.nodes[i % 4] = i % 9 == 0 ? std::array<std::uint32_t, 2>{0, 0} : std::array{a, b};
    four.springs.rest_length[i % 4] = 0.5;
    four.springs.stiffness[i % 4] = i % 9 == 0 ? 0 : 3;
    four.springs.damping[i % 4] = i % 9 == 0 ? 0 : 0.7;
  }
  const auto run = [&](const cut::Kernels& kernels, double limit, bool old_first) {
    auto p = positions;
    auto v = velocities;
    auto f = forces;
    auto next = positions;
    std::vector<cut::SlottedNode> others;
    for (auto slot = static_cast<std::uint32_t>(nodes); slot-- > nodes / 2;) others.push_back({7, slot});
    const cut::VelocityUpdate update{0.01, {0.1, 0, -9.81, 0}, 0.3, limit, old_first};
    bool sound = true;
    for (int i = 0; i < 50 && sound; ++i) {
      kernels.add_spring_forces(arrays, p.data(), v.data(), f.data());
      kernels.add_forces_at_first_node(arrays, p.data(), v.data(), f.data());
      cut::NodeArrays arrays_of_nodes{};
      arrays_of_nodes.positions = p.data();
      arrays_of_nodes.velocities = v.data();
      arrays_of_nodes.forces = f.data();
      arrays_of_nodes.next_positions = next.data();
      arrays_of_nodes.inverse_mass_at_slots = inverse_mass.data();
      arrays_of_nodes.moves = i % 2 == 0;
      sound = kernels.advance_nodes(update, arrays_of_nodes, 0, nodes / 2, others);
      if (arrays_of_nodes.moves)
        p.swap(next);
      else
        kernels.move(0.01, p, f.data(), p.data());
      v.swap(f);
      f = forces;
    }
    return std::tuple{sound, p, v};
  };
  for (const auto& [limit, old_first] :
       {std::pair{1e9, false}, std::pair{1e9, true}, std::pair{2.0, false}}) {
    const auto [sound_a, p_a, v_a] = run(cut::portable_kernels(), limit, old_first);
    const auto [sound_b, p_b, v_b] = run(cut::best_kernels(), limit, old_first);
    CHECK(sound_a == (limit > 1e6));
    CHECK(sound_a == sound_b);
    for (std::size_t n = 0; n < nodes; ++n) {
      CHECK(std::tie(p_a[n].x, p_a[n].y, p_a[n].z) == std::tie(p_b[n].x, p_b[n].y, p_b[n].z));
      CHECK(std::tie(v_a[n].x, v_a[n].y, v_a[n].z) == std::tie(v_b[n].x, v_b[n].y, v_b[n].z));
    }
  }
}

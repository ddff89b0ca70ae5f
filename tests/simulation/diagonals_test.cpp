// Springs in diagonals: both versions of the loops give the same bits, and a sheet whose springs are in
// diagonals moves as one whose are not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <numeric>
#include <scenes/cutters.hpp>
#include <span>

#include "simulation/diagonals.hpp"
#include "simulation/meshes.hpp"

using cut::PaddedVector;

namespace {

struct State {
  std::vector<PaddedVector> positions, velocities, given;
  std::vector<double> inverse_mass;
  std::vector<cut::CacheLine> columns, given_columns;
  bool sound = true;
};

/// One step of all blocks with this version of the loops.
/// @param at_once  whether blocks follow each other in one window
State stepped(const cut::Kernels& kernels, const cut::SpringBlocks& blocks, State state,
              const cut::VelocityUpdate* update, bool moves, bool begun, bool at_once) {
  const std::size_t nodes = state.inverse_mass.size();
  cut::ColumnSpace space(state.columns, 4, nodes + cut::reach_of(blocks.diagonals()));
  cut::NodeArrays arrays{};
  arrays.in_columns = nodes;
  arrays.inverse_mass = state.inverse_mass.data();
  arrays.position_columns = space.take();
  arrays.velocity_columns = space.take();
  arrays.next_position_columns = space.take();
  arrays.next_velocity_columns = space.take();
  arrays.moves = moves;
  kernels.to_columns(state.positions.data(), 0, nodes, arrays.position_columns);
  kernels.to_columns(state.velocities.data(), 0, nodes, arrays.velocity_columns);
  cut::ForceWindow window;
  for (const cut::SpringBlock& block : blocks.blocks()) {
    const std::size_t size = block.last - block.first;
    const cut::ColumnArrays given = cut::ColumnSpace(state.given_columns, 1, size + 4).take();
    kernels.to_columns(state.given.data() + block.first, 0, size, given);
    std::vector<std::uint32_t> fours;  // backwards
    for (std::size_t i = (size + 3) / 4; i-- > 0;) fours.push_back(static_cast<std::uint32_t>(4 * i));
    if (!at_once) window.close();
    state.sound &= kernels.advance_range(
        {blocks.diagonals(), block.first, block.last, begun ? &given : nullptr, fours.data()}, update, arrays,
        window);
  }
  return state;
}

/// The same mesh with its vertices in another order.
cut::TriangleMesh renumbered(const cut::TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  cut::TriangleMesh result = mesh;
  for (std::size_t n = 0; n < number.size(); ++n) result.positions[number[n]] = mesh.positions[n];
  for (auto& triangle : result.triangles)
    for (auto& corner : triangle) corner = number[corner];
  return result;
}

}  // namespace

TEST_CASE("The loops over diagonals for AVX2 give the bits of the plain ones") {
  std::mt19937 random(12);
  for (const std::size_t nodes : {std::size_t{64}, std::size_t{133}, std::size_t{3002}}) {
    cut::SpringBlocks blocks;
    blocks.reset(nodes, {1, 7, 31});
    cut::SpringArrays springs;
    for (std::uint32_t a = 0; a < nodes; ++a)
      for (const std::uint32_t offset : {1u, 7u, 31u})
        if (a + offset < nodes && random() % 4 != 0) springs.nodes.push_back({a, a + offset});
    springs.rest_length.assign(springs.nodes.size(), 0.5);
    springs.stiffness.assign(springs.nodes.size(), 3);
    springs.damping.assign(springs.nodes.size(), 0.7);
    std::vector<cut::SpringPlace> places(springs.nodes.size());
    for (std::size_t i = 0; i < springs.nodes.size(); ++i) blocks.set(springs, i, places[i]);
    for (const cut::SpringBlock& block : blocks.blocks()) CHECK(block.inner.size() + block.outer.size() == 0);
    State start;
    const auto padded = [&](double size) {
      const Eigen::Vector3d v = testing::random_vector(random, size);
      return PaddedVector{v.x(), v.y(), v.z(), 0};
    };
    for (std::size_t n = 0; n < nodes; ++n) {
      start.positions.push_back(n % 9 == 1 ? start.positions.back() : padded(1));
      start.velocities.push_back(n % 5 == 0 ? PaddedVector{-0.0, 0.0, -0.0, 0} : padded(1));
      start.given.push_back(padded(10));
      start.inverse_mass.push_back(n % 6 == 0 ? 0 : 1 + 0.01 * static_cast<double>(n % 100));
    }
    const auto compare = [&](const cut::VelocityUpdate* update, bool moves, bool begun) {
      const State a = stepped(cut::portable_kernels(), blocks, start, update, moves, begun, false);
      for (const bool at_once : {false, true}) {
        const State b = stepped(cut::best_kernels(), blocks, start, update, moves, begun, at_once);
        CHECK(a.sound == b.sound);
        CHECK(a.columns == b.columns);
      }
      return a.sound;
    };
    for (const bool begun : {false, true}) {
      CHECK(compare(nullptr, false, begun));
      for (const bool old_first : {false, true}) {
        const cut::VelocityUpdate update{0.01, {0.1, 0, -9.81, 0}, 0.3, 1e9, old_first};
        CHECK(compare(&update, false, begun));
        CHECK(compare(&update, true, begun));
        const cut::VelocityUpdate slow{0.01, {0.1, 0, -9.81, 0}, 0.3, 0.5, old_first};
        CHECK_FALSE(compare(&slow, true, begun));
      }
    }
  }
}

namespace {

/// Compares a sheet with the same sheet whose nodes are numbered at random.
void moves_alike(const cut::TriangleMesh& sheet, std::span<const cut::Integrator> integrators,
                 std::size_t steps) {
  std::vector<std::uint32_t> number(sheet.positions.size());
  std::iota(number.begin(), number.end(), 0u);
  std::shuffle(number.begin(), number.end(), std::mt19937(5));
  for (const auto integrator : integrators) {
    std::array meshes{testing::built(sheet), testing::built(renumbered(sheet, number))};
    const auto run = [&](cut::HybridMesh& mesh, bool ordered) {
      const auto at = [&](std::size_t n) { return cut::NodeId{ordered ? n : number[n]}; };
      cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.05});
      simulation.surroundings.integrator = integrator;
      simulation.surroundings.gravity = {0, 1, -9.81};
      simulation.surroundings.air_drag = 0.1;
      simulation.surroundings.longest_way = 10;
      simulation.surroundings.tolerance = 1e-12;
      simulation.anchor(at(0));
      simulation.set_force(at(700), {0.1, 0.2, 0.3});
      for (std::size_t n = 0; n < number.size(); ++n)
        mesh.positions[at(n).index()].z() += 0.01 * static_cast<double>(n % 5);
      REQUIRE_FALSE(simulation.step(mesh, 1e-3, integrator == cut::Integrator::implicit_euler ? 5 : steps));
      return simulation;
    };
    const auto compare = [&](const cut::Simulation& a, const cut::Simulation& b) {
      double way = 0, speed = 0;
      for (std::size_t n = 0; n < number.size(); ++n) {
        way = std::max(way, (meshes[0].positions[n] - meshes[1].positions[number[n]]).norm());
        speed = std::max(speed, (a.velocity(cut::NodeId{n}) - b.velocity(cut::NodeId{number[n]})).norm());
      }
      CHECK(way < 1e-11);
      CHECK(speed < 1e-9);
    };
    cut::Simulation a = run(meshes[0], true);
    const cut::Simulation b = run(meshes[1], false);
    compare(a, b);
  }
}

}  // namespace

TEST_CASE("A sheet moves alike with its springs in diagonals and anywhere") {
  moves_alike(scenes::grid(50, 40), testing::integrators, 60);  // more than one block
  // Blocks with more nodes than forces are kept for.
  constexpr std::array integrators{cut::Integrator::semi_implicit_euler};
  moves_alike(scenes::grid(200, 200), integrators, 5);
}

TEST_CASE("After cuts a sheet in diagonals moves as a simulation that starts with the cut sheet") {
  cut::HybridMesh mesh = testing::built(scenes::grid(50, 40));
  cut::Simulation simulation = testing::simulated(mesh, {});
  simulation.surroundings.gravity = {0, 0, -9.81};
  simulation.surroundings.longest_way = 10;
  cut::Cutter knife(cut::default_merge_distances(mesh));
  for (const double y : {3.3, 17.7, 18.1}) {
    const auto changes = knife.cut(mesh, scenes::ribbon({{2.2, y, 0}, {45.1, y + 9, 0}}, {0.01, 0, 4}));
    REQUIRE(changes);
    REQUIRE_FALSE(simulation.apply(*changes, mesh));
    REQUIRE(cut::validate(mesh, 1).empty());
    REQUIRE_FALSE(simulation.step(mesh, 1e-4, 50));
  }
  cut::HybridMesh copy = mesh;
  cut::Simulation fresh = testing::simulated(copy, {});
  fresh.surroundings = simulation.surroundings;
  for (std::size_t n = 0; n < copy.positions.size(); ++n)
    fresh.set_velocity(cut::NodeId{n}, simulation.velocity(cut::NodeId{n}));
  REQUIRE_FALSE(fresh.step(copy, 1e-4, 100));
  REQUIRE_FALSE(simulation.step(mesh, 1e-4, 100));
  double way = 0;
  for (std::size_t n = 0; n < copy.positions.size(); ++n)
    way = std::max(way, (copy.positions[n] - mesh.positions[n]).norm());
  CHECK(way < 1e-9);
}

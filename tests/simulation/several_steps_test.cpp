// Several steps in one call: the order in which blocks go through them, and the same bits, errors and kept
// states as one step after the other, for any number of threads, whatever the cloth has been through.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cut/adapt/threads.hpp>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <numeric>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"
#include "simulation/trapezoids.hpp"

using cut::NodeId;

TEST_CASE("Blocks go through steps when their neighbours are ready for it, whoever comes first") {
  CHECK(rc::check([] {
    const auto blocks = *rc::gen::inRange<std::size_t>(1, 150);
    const auto wanted = *rc::gen::inRange<std::size_t>(1, 12);
    const std::size_t steps = blocks == 1 ? wanted : cut::most_steps_in_trapezoids(blocks, wanted);
    RC_ASSERT(steps >= 1);
    const cut::Executor shuffled([](std::size_t count, const cut::Executor::Turn& turn) {
      std::vector<std::size_t> turns(count);
      std::iota(turns.begin(), turns.end(), std::size_t{0});
      const auto seed = *rc::gen::arbitrary<std::uint32_t>();
      std::shuffle(turns.begin(), turns.end(), std::mt19937(seed));
      for (const std::size_t i : turns) turn(i);
    });
    std::vector<std::size_t> done(blocks, 0), next(steps, 0);
    cut::go_in_trapezoids(
        shuffled, blocks, steps, [&] { std::fill(next.begin(), next.end(), blocks); },
        [&](std::size_t step, std::size_t block) {
          RC_ASSERT(done[block] == step);
          // What a neighbour was two steps ago is overwritten.
          for (const std::size_t n : {block - 1, block + 1})
            if (n < blocks) RC_ASSERT((done[n] == step || done[n] == step + 1));
          // Forces are kept for the next block.
          RC_ASSERT((next[step] == blocks || next[step] == block));
          next[step] = block + 1;
          ++done[block];
        });
    RC_ASSERT(done == std::vector<std::size_t>(blocks, steps));
  }));
}

namespace {

struct Cloth {
  cut::HybridMesh mesh;
  cut::Simulation simulation;
};

/// More nodes than go through one step at a time, in several ways.
enum class Kind : std::uint8_t { small, fresh, cut, without_pattern };

cut::TriangleMesh sheet_of(Kind kind) {
  if (kind == Kind::small) return scenes::grid(20, 20);
  cut::TriangleMesh sheet = scenes::grid(200, 180);
  if (kind != Kind::without_pattern) return sheet;
  // Numbers that differ a little from those of a sheet.
  std::vector<std::uint32_t> number(sheet.positions.size());
  std::iota(number.begin(), number.end(), 0u);
  std::mt19937 random(3);
  for (std::size_t n = 0; n + 16 <= number.size(); n += 16)
    std::shuffle(number.begin() + static_cast<std::ptrdiff_t>(n),
                 number.begin() + static_cast<std::ptrdiff_t>(n + 16), random);
  const auto positions = sheet.positions;
  for (std::size_t n = 0; n < number.size(); ++n) sheet.positions[number[n]] = positions[n];
  for (auto& triangle : sheet.triangles)
    for (auto& corner : triangle) corner = number[corner];
  return sheet;
}

Cloth cloth_of(Kind kind, cut::Integrator integrator) {
  cut::HybridMesh mesh = testing::built(sheet_of(kind));
  cut::Simulation simulation =
      testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.01, 0, 0});
  simulation.surroundings.integrator = integrator;
  simulation.surroundings.gravity = {0, 1, -9.81};
  simulation.surroundings.air_drag = 0.1;
  simulation.surroundings.longest_way = 10;
  simulation.anchor(NodeId{0u});
  simulation.anchor(NodeId{300u});
  simulation.set_velocity(NodeId{300u}, {1, 2, 3});
  std::mt19937 random(11);
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    mesh.positions[n].z() += 0.01 * static_cast<double>(random() % 5);
  if (kind != Kind::fresh) {
    cut::Cutter knife(cut::default_merge_distances(mesh));
    for (const double y : {3.3, 3.9, 10.1, 160.2}) {
      const auto changes = knife.cut(mesh, scenes::ribbon({{1.2, y, 0}, {190.3, y + 7.4, 0}}, {0.01, 0, 4}));
      REQUIRE(changes);
      REQUIRE_FALSE(simulation.apply(*changes, mesh));
    }
    REQUIRE(cut::validate(mesh, 1).empty());
    simulation.set_force(NodeId{mesh.positions.size() - 1}, {0.1, 0.2, 0.3});
    simulation.set_force(NodeId{200u}, {0.3, 0.1, 0.3});
  }
  return {std::move(mesh), std::move(simulation)};
}

void check_same(const Cloth& a, const Cloth& b) {
  CHECK(a.mesh.positions == b.mesh.positions);
  CHECK(a.simulation.updates() == b.simulation.updates());
  bool same = true;
  for (std::size_t n = 0; n < a.mesh.positions.size(); ++n)
    same &= a.simulation.velocity(NodeId{n}) == b.simulation.velocity(NodeId{n});
  CHECK(same);
}

}  // namespace

TEST_CASE("Several steps give the bits of one after the other, for any number of threads") {
  for (const Kind kind : {Kind::small, Kind::fresh, Kind::cut, Kind::without_pattern})
    for (const auto integrator : {cut::Integrator::forward_euler, cut::Integrator::semi_implicit_euler}) {
      const Cloth start = cloth_of(kind, integrator);
      Cloth single = start;
      for (int i = 0; i < 23; ++i) REQUIRE_FALSE(single.simulation.step(single.mesh, 1e-3));
      CHECK(single.mesh.positions != start.mesh.positions);
      for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{8}}) {
        Cloth several = start;
        several.simulation.executor = cut::thread_executor(threads);
        for (const std::size_t count : {3u, 13u, 7u})
          REQUIRE_FALSE(several.simulation.step(several.mesh, 1e-3, count));
        check_same(several, single);
      }
    }
}

TEST_CASE("A blow-up amid several steps is that of one after the other, and leaves the same state") {
  for (const Kind kind : {Kind::small, Kind::fresh, Kind::cut, Kind::without_pattern}) {
    Cloth single = cloth_of(kind, cut::Integrator::semi_implicit_euler);
    const double time_step = 1.3 * single.simulation.stable_time_step(cut::Integrator::semi_implicit_euler);
    single.simulation.surroundings.longest_way = 0.3;
    Cloth several = single;
    several.simulation.executor = cut::thread_executor(2);
    std::optional<cut::Error> error;
    for (int i = 0; i < 1000 && !error; ++i) error = single.simulation.step(single.mesh, time_step);
    REQUIRE(error);
    CHECK(error->kind == cut::Error::Kind::unstable);
    CHECK(single.simulation.updates() > 20);
    const auto other = several.simulation.step(several.mesh, time_step, 1000);
    REQUIRE(other);
    CHECK(other->message == error->message);
    CHECK(other->element == error->element);
    check_same(several, single);
  }
}

// The simulation follows random sequences of real cuts while the cloth moves: mass and momentum, the stable
// time step, anchors, and whether local updates agree with a simulation
// built anew.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cut/bending.hpp>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>
#include <cut/validate.hpp>
#include <map>
#include <scenes/cutters.hpp>
#include <scenes/surfaces.hpp>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::MaterialMode;
using cut::NodeId;
using cut::SpringId;

namespace {

cut::TriangleMesh random_cloth(std::mt19937& random) {
  const std::size_t columns = 1 + random() % 5, rows = 1 + random() % 5;
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return scenes::twelve_triangles();
    case 1:
      return scenes::grid(columns, rows);
    case 2:
      return scenes::hexagon(1 + random() % 3);
    default:
      return scenes::random_sheet(columns, rows, 1, random());
  }
}

/// A flat blade through a random point of the cloth, upright and a little tilted, short or long.
cut::TriangleMesh random_blade(const cut::HybridMesh& mesh, std::mt19937& random) {
  const Eigen::Vector3d centre =
      mesh.positions[random() % mesh.positions.size()] + testing::random_vector(random, 0.7);
  Eigen::Vector3d along = testing::random_vector(random, 1);
  along.z() = 0;
  if (along.norm() < 0.1) along.x() += 1;
  const double length = std::uniform_real_distribution<double>(0.3, 6)(random);
  return scenes::plane(centre, along.normalized() * length,
                       Eigen::Vector3d(0, 0, 4) + testing::random_vector(random, 0.5));
}

/// Stiffness and damping of the bending springs, by nodes and rest length: their order is nobody's business.
using BendingOf = std::map<std::pair<std::array<std::uint32_t, 2>, double>, std::array<double, 2>>;

BendingOf bending_of(const cut::Simulation& simulation) {
  const cut::SpringArrays& springs = simulation.bending_springs();
  BendingOf result;
  for (std::size_t s = 0; s < springs.nodes.size(); ++s) {
    if (springs.nodes[s][0] == springs.nodes[s][1]) continue;
    auto& sum = result[{springs.nodes[s], springs.rest_length[s]}];
    sum[0] += springs.stiffness[s];
    sum[1] += springs.damping[s];
  }
  return result;
}

/// Local updates leave the masses and springs of a simulation that is built from the cut mesh, but for what
/// old cuts were bent by new ones: half a lattice cell each time.
bool same_constants(const cut::Simulation& a, const cut::Simulation& b, const cut::HybridMesh& mesh,
                    double tolerance) {
  bool same = a.node_count() == b.node_count() && a.spring_count() == b.spring_count();
  const auto compare = [&](double v, double w, double unit) {
    same = same && std::abs(v - w) <= tolerance * unit;
  };
  const cut::Material& material = a.material();
  const BendingOf bending_a = bending_of(a), bending_b = bending_of(b);
  same = same && bending_a.size() == bending_b.size();
  for (auto i = bending_a.begin(), j = bending_b.begin(); same && i != bending_a.end(); ++i, ++j) {
    same = i->first == j->first;
    compare(i->second[0], j->second[0], material.bending_stiffness);
    compare(i->second[1], j->second[1], material.bending_damping);
  }
  for (std::size_t n = 0; same && n < mesh.positions.size(); ++n)
    compare(a.mass(NodeId{n}), b.mass(NodeId{n}), material.density);
  for (std::size_t s = 0; same && s < mesh.buffers.springs.size(); ++s) {
    compare(a.stiffness(SpringId{s}), b.stiffness(SpringId{s}), material.stiffness);
    compare(a.damping(SpringId{s}), b.damping(SpringId{s}), material.damping);
  }
  return same;
}

struct Cloth {
  std::mt19937 random{*rc::gen::arbitrary<unsigned>()};
  cut::HybridMesh mesh = testing::built(random_cloth(random));
  cut::Cutter cutter{cut::default_merge_distances(mesh)};
  cut::Simulation simulation;
  double time_step;

  explicit Cloth(MaterialMode mode)
      : simulation(testing::simulated(mesh, {mode, 0.2, 100, 0.01, *rc::gen::element(0.0, 5.0, 200.0),
                                             *rc::gen::element(0.0, 0.0005, 0.02)})),
        time_step(simulation.cut_proof_time_step(Integrator::semi_implicit_euler, mesh) / 2) {
    testing::shake(mesh, simulation, random, 0.01, 0.1);
  }
  cut::Changes cut_once() {
    auto changes = cutter.cut(mesh, random_blade(mesh, random));
    RC_ASSERT(changes.has_value());
    RC_ASSERT(cut::validate(mesh, 1).empty());
    return std::move(changes).value();
  }
};

}  // namespace

TEST_CASE("Conserving material over random cuts of moving cloth") {
  std::size_t cuts_that_copied = 0;
  CHECK(rc::check([&] {
    Cloth cloth(MaterialMode::conserving);
    auto& [random, mesh, cutter, simulation, time_step] = cloth;
    const double mass = simulation.total_mass();
    const double speed = 0.2, reach = 10;
    const int cuts = *rc::gen::inRange(1, 15);
    for (int c = 0; c < cuts; ++c) {
      const Eigen::Vector3d momentum = simulation.momentum(), spin = simulation.angular_momentum(mesh);
      const Eigen::Vector3d centre = simulation.centre_of_mass(mesh);
      const cut::Changes changes = cloth.cut_once();
      RC_ASSERT_FALSE(simulation.apply(changes, mesh).has_value());
      cuts_that_copied += !changes.node_copies.empty();

      RC_ASSERT(std::abs(simulation.total_mass() - mass) <= 1e-12 * mass);
      RC_ASSERT((simulation.momentum() - momentum).norm() <= 1e-12 * mass * speed);
      RC_ASSERT((simulation.angular_momentum(mesh) - spin).norm() <= 1e-12 * mass * speed * reach);
      RC_ASSERT((simulation.centre_of_mass(mesh) - centre).norm() <= 1e-12 * reach);
      for (std::size_t n = 0; n < mesh.positions.size(); ++n) RC_ASSERT(simulation.mass(NodeId{n}) > 0);
      RC_ASSERT(simulation.stable_time_step(Integrator::semi_implicit_euler) >= 2 * time_step * (1 - 1e-12));
      RC_ASSERT(simulation.stable_time_step(Integrator::forward_euler) >=
                simulation.cut_proof_time_step(Integrator::forward_euler, mesh) * (1 - 1e-12));
      RC_ASSERT(same_constants(simulation, testing::simulated(mesh, simulation.material()), mesh, 1e-6));
      RC_ASSERT_FALSE(simulation.step(mesh, time_step, 20).has_value());
    }
  }));
  CHECK(cuts_that_copied > 50);
}

TEST_CASE("Paper material over random cuts of moving cloth") {
  CHECK(rc::check([&] {
    Cloth cloth(MaterialMode::paper);
    auto& [random, mesh, cutter, simulation, time_step] = cloth;
    const int cuts = *rc::gen::inRange(1, 10);
    for (int c = 0; c < cuts; ++c) {
      double mass = simulation.total_mass();
      const cut::Changes changes = cloth.cut_once();
      RC_ASSERT_FALSE(simulation.apply(changes, mesh).has_value());
      for (const cut::NodeCopy& copy : changes.node_copies) {
        mass += simulation.mass(copy.source);
        RC_ASSERT(simulation.velocity(copy.node) == simulation.velocity(copy.source));
      }
      RC_ASSERT(std::abs(simulation.total_mass() - mass) <= 1e-12 * mass);
      // A simulation built anew has the same constants and, from the same velocities, moves the same way:
      // what steps go through was kept up to date, too.
      cut::Simulation anew = testing::simulated(mesh, simulation.material());
      RC_ASSERT(same_constants(simulation, anew, mesh, 0));
      for (std::size_t n = 0; n < mesh.positions.size(); ++n)
        anew.set_velocity(NodeId{n}, simulation.velocity(NodeId{n}));
      cut::HybridMesh copy = mesh;
      RC_ASSERT_FALSE(simulation.step(mesh, time_step, 20).has_value());
      RC_ASSERT_FALSE(anew.step(copy, time_step, 20).has_value());
      for (std::size_t n = 0; n < mesh.positions.size(); ++n)
        RC_ASSERT((mesh.positions[n] - copy.positions[n]).norm() <= 1e-9);
    }
  }));
}

TEST_CASE("A piece that does not contain its anchor falls in conserving mode and hangs in paper mode") {
  // The left third of a square is cut off; the anchors are at the left end, the cut runs inside of triangles.
  for (const MaterialMode mode : {MaterialMode::conserving, MaterialMode::paper}) {
    cut::HybridMesh mesh = testing::built(scenes::grid(1, 1, 1));
    cut::Cutter cutter(cut::default_merge_distances(mesh));
    cut::Simulation simulation = testing::simulated(mesh, {mode, 0.2, 100, 0.05});
    simulation.anchor(cut::AncestorNodeId{0u}, mesh);
    simulation.anchor(cut::AncestorNodeId{2u}, mesh);
    const auto changes = cutter.cut(mesh, scenes::plane({0.3, 0.5, 0}, {0, 4, 0}, {0, 0, 4}));
    REQUIRE(changes);
    REQUIRE(changes->node_copies.size() == 4);
    REQUIRE_FALSE(simulation.apply(*changes, mesh));
    simulation.surroundings.gravity = {0, 0, -10};
    REQUIRE_FALSE(simulation.step(mesh, 1e-4, 2000));
    std::size_t anchors = 0;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) anchors += simulation.anchored(NodeId{n});
    CHECK(anchors == (mode == MaterialMode::conserving ? 2 : 4));
    const cut::Pieces pieces = cut::pieces(mesh);
    REQUIRE(pieces.list.size() == 2);
    std::vector<double> highest(2, -1);
    for (std::size_t v = 0; v < mesh.buffers.render_vertices.size(); ++v) {
      const cut::RenderVertex& vertex = mesh.buffers.render_vertices[v];
      if (!vertex.triangle.valid()) continue;
      double& z = highest[pieces.of_vertex[v]];
      z = std::max(z, mesh.position(vertex).z());
    }
    const double of_free_piece = std::min(highest[0], highest[1]);
    // Free fall for 0.2 s is 0.2 m for all of it; a hanging piece only turns about its anchors.
    if (mode == MaterialMode::conserving)
      CHECK(of_free_piece == doctest::Approx(-0.2).epsilon(0.02));
    else
      CHECK(of_free_piece > -0.1);
  }
}

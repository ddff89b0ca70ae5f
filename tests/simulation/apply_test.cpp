// How the simulation takes over cuts, on single triangles cut by hand.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "simulation/meshes.hpp"

using cut::lattice_corner;
using cut::lattice_point_on_edge;
using cut::lattice_size;
using cut::LatticePoint;
using cut::Material;
using cut::MaterialMode;
using cut::NodeId;
using cut::SpringId;

namespace {

using Polygons = std::vector<std::vector<LatticePoint>>;

/// Two pieces: the part with corners 2 and 0, and the tip at corner 1.
Polygons halves(std::int32_t from = lattice_size / 2, std::int32_t to = lattice_size / 2) {
  const LatticePoint a = lattice_point_on_edge(0, from), b = lattice_point_on_edge(1, to);
  return {{lattice_corner(0), a, b, lattice_corner(2)}, {a, lattice_corner(1), b}};
}

void check_same_constants(const cut::Simulation& a, const cut::Simulation& b, const cut::HybridMesh& mesh) {
  REQUIRE(a.node_count() == b.node_count());
  CHECK(a.spring_count() == b.spring_count());
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    CHECK(a.mass(NodeId{n}) == doctest::Approx(b.mass(NodeId{n})).epsilon(1e-14));
  for (std::size_t s = 0; s < mesh.buffers.springs.size(); ++s) {
    CHECK(a.stiffness(SpringId{s}) == doctest::Approx(b.stiffness(SpringId{s})).epsilon(1e-14));
    CHECK(a.damping(SpringId{s}) == doctest::Approx(b.damping(SpringId{s})).epsilon(1e-14));
  }
}

}  // namespace

TEST_CASE("Paper mode: copies are full copies of their source") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {MaterialMode::paper});
  std::mt19937 random(1);
  testing::shake(mesh, simulation, random, 0.1, 1);
  simulation.anchor(NodeId{0u});
  simulation.set_force(NodeId{1u}, {1, 2, 3});
  const double mass = simulation.total_mass();
  const auto changes = testing::cut_apart(mesh, halves(), {0, 0});
  REQUIRE_FALSE(simulation.apply(changes, mesh));
  CHECK(simulation.node_count() == 6);
  CHECK(simulation.spring_count() == 6);
  CHECK(simulation.total_mass() == doctest::Approx(2 * mass));
  for (const cut::NodeCopy& copy : changes.node_copies) {
    CHECK(simulation.velocity(copy.node) == simulation.velocity(copy.source));
    CHECK(simulation.mass(copy.node) == simulation.mass(copy.source));
    CHECK(simulation.anchored(copy.node) == simulation.anchored(copy.source));
    CHECK(simulation.force(copy.node) == simulation.force(copy.source));
  }
  for (std::size_t s = 0; s < 6; ++s)
    CHECK(simulation.stiffness(SpringId{s}) == simulation.material().stiffness);
  check_same_constants(simulation, testing::simulated(mesh, simulation.material()), mesh);
}

TEST_CASE("Conserving mode: fragments share mass, springs and forces as the integrals say") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {});
  const auto corner = [&](std::size_t fragment, std::size_t i) {
    return mesh.buffers.triangles[fragment].nodes[i];
  };
  const double third = simulation.mass(NodeId{0u});
  const double k = simulation.material().stiffness;
  simulation.set_force(corner(0, 1), {8, 0, 0});
  REQUIRE_FALSE(simulation.apply(testing::cut_apart(mesh, halves(), {0, 0}), mesh));
  // The tip is a quarter of the area; the mean of N there is 2/3 at its own corner and 1/6 at the others.
  CHECK(simulation.mass(corner(1, 1)) == doctest::Approx(third * 0.25 * 3 * 2 / 3).epsilon(1e-15));
  CHECK(simulation.mass(corner(1, 0)) == doctest::Approx(third * 0.25 * 3 / 6).epsilon(1e-15));
  CHECK(simulation.mass(corner(0, 1)) == doctest::Approx(third * 0.5).epsilon(1e-15));
  CHECK(simulation.mass(corner(0, 2)) == doctest::Approx(third * 0.875).epsilon(1e-15));
  CHECK(simulation.force(corner(0, 1)) == Eigen::Vector3d(4, 0, 0));
  CHECK(simulation.force(corner(1, 1)) == Eigen::Vector3d(4, 0, 0));
  for (std::size_t s = 0; s < 6; ++s) {
    const cut::Spring& spring = mesh.buffers.springs[s];
    const bool tip = s >= 3;
    const bool at_corner_1 = spring.nodes[0] == corner(tip, 1) || spring.nodes[1] == corner(tip, 1);
    const double weight = tip ? 0.125 : (at_corner_1 ? 0.5 : 0.875);
    CHECK(simulation.stiffness(SpringId{s}) == doctest::Approx(k * weight).epsilon(1e-15));
    CHECK(simulation.damping(SpringId{s}) ==
          doctest::Approx(simulation.material().damping * weight).epsilon(1e-15));
  }
}

TEST_CASE("Conserving mode: only copies that render the node keep its anchor") {
  for (const MaterialMode mode : {MaterialMode::conserving, MaterialMode::paper}) {
    cut::HybridMesh mesh = testing::equilateral(1);
    cut::Simulation simulation = testing::simulated(mesh, {mode});
    const auto corner = [&](std::size_t fragment, std::size_t i) {
      return mesh.buffers.triangles[fragment].nodes[i];
    };
    simulation.anchor(corner(0, 0));
    simulation.anchor(corner(0, 1));
    REQUIRE_FALSE(simulation.apply(testing::cut_apart(mesh, halves(), {0, 0}), mesh));
    const bool all = mode == MaterialMode::paper;
    CHECK(simulation.anchored(corner(0, 0)));
    CHECK(simulation.anchored(corner(0, 1)) == all);
    CHECK(simulation.anchored(corner(1, 0)) == all);
    CHECK(simulation.anchored(corner(1, 1)));
    CHECK_FALSE(simulation.anchored(corner(1, 2)));
    // The released copies fall, the held ones do not.
    simulation.surroundings.gravity = {0, 0, -10};
    REQUIRE_FALSE(simulation.step(mesh, 0.001, 10));
    CHECK((mesh.positions[corner(1, 0).index()].z() < 0) == !all);
    CHECK(mesh.positions[corner(1, 1).index()].z() == 0);
    // Anchoring by the node of the uncut mesh finds the same copies.
    cut::Simulation other = testing::simulated(mesh, {mode});
    const cut::AncestorNodeId ancestor = mesh.buffers.nodes[corner(0, 1).index()];
    other.anchor(ancestor, mesh);
    CHECK_FALSE(other.anchored(corner(0, 1)));
    CHECK(other.anchored(corner(1, 1)));
  }
}

TEST_CASE("A cut through the anchored node leaves the anchor on both sides") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {});
  const auto corner = [&](std::size_t fragment, std::size_t i) {
    return mesh.buffers.triangles[fragment].nodes[i];
  };
  simulation.anchor(corner(0, 2));
  const LatticePoint middle = lattice_point_on_edge(0, lattice_size / 2);
  const Polygons polygons{{lattice_corner(0), middle, lattice_corner(2)},
                          {middle, lattice_corner(1), lattice_corner(2)}};
  REQUIRE_FALSE(simulation.apply(testing::cut_apart(mesh, polygons, {0, 0}), mesh));
  CHECK(simulation.anchored(corner(0, 2)));
  CHECK(simulation.anchored(corner(1, 2)));
}

TEST_CASE("A triangle cut into random slivers, with motion in between, keeps mass and momentum") {
  CHECK(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());
    cut::HybridMesh mesh = testing::equilateral(0.7);
    cut::Simulation simulation = testing::simulated(mesh, {});
    testing::shake(mesh, simulation, random, 0.02, 0.5);
    const double mass = simulation.total_mass();
    const double bound = simulation.cut_proof_time_step(cut::Integrator::semi_implicit_euler, mesh);
    // Each cut runs from edge 0 to edge 1 and takes the strip towards corner 1 from the last piece.
    Polygons polygons{{lattice_corner(0), lattice_corner(1), lattice_corner(2)}};
    std::int32_t at = 0;
    const int cuts = *rc::gen::inRange(1, 12);
    for (int c = 0; c < cuts; ++c) {
      const std::int32_t left = lattice_size - at;
      const std::int32_t width =
          *rc::gen::element(1, 2, 1 + static_cast<std::int32_t>(random() % 1000u), left / 3);
      at += width;
      RC_PRE(at < lattice_size);
      const LatticePoint a = lattice_point_on_edge(0, at), b = lattice_point_on_edge(1, lattice_size - at);
      std::vector<LatticePoint>& last = polygons.back();
      const LatticePoint old_a = last.front(), old_b = last.back();
      last = {old_a, a, b, old_b};
      polygons.push_back({a, lattice_corner(1), b});
      std::vector<std::size_t> parents(polygons.size());
      for (std::size_t p = 0; p < parents.size(); ++p) parents[p] = p + 1 == parents.size() ? p - 1 : p;

      const Eigen::Vector3d momentum = simulation.momentum(), spin = simulation.angular_momentum(mesh);
      const Eigen::Vector3d centre = simulation.centre_of_mass(mesh);
      RC_ASSERT_FALSE(simulation.apply(testing::cut_apart(mesh, polygons, parents), mesh).has_value());
      RC_ASSERT(std::abs(simulation.total_mass() / mass - 1) < 1e-14);
      RC_ASSERT((simulation.momentum() - momentum).norm() < 1e-14 * mass);
      RC_ASSERT((simulation.angular_momentum(mesh) - spin).norm() < 1e-14 * mass);
      RC_ASSERT((simulation.centre_of_mass(mesh) - centre).norm() < 1e-14);
      RC_ASSERT(simulation.stable_time_step(cut::Integrator::semi_implicit_euler) >= bound * (1 - 1e-12));
      for (std::size_t n = 0; n < mesh.positions.size(); ++n) RC_ASSERT(simulation.mass(NodeId{n}) > 0);
      check_same_constants(simulation, testing::simulated(mesh, {}), mesh);
      RC_ASSERT_FALSE(simulation.step(mesh, 0.9 * bound, 50).has_value());
    }
  }));
}

TEST_CASE("Change sets must come in turn") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {});
  const auto changes = testing::cut_apart(mesh, halves(), {0, 0});
  CHECK(simulation.step(mesh, 0.01)->kind == cut::Error::Kind::bad_parameter);
  cut::HybridMesh later = mesh;
  ++later.topology_version;
  CHECK(simulation.apply(changes, later)->kind == cut::Error::Kind::bad_parameter);
  CHECK(simulation.node_count() == 3);
  CHECK_FALSE(simulation.apply(changes, mesh));
  CHECK(simulation.apply(changes, mesh)->kind == cut::Error::Kind::bad_parameter);
  CHECK_FALSE(simulation.apply(cut::Changes{}, mesh));
  CHECK_FALSE(simulation.step(mesh, 0.001));
}

TEST_CASE("A spring that is freed exerts no force and is not counted") {
  cut::HybridMesh mesh = testing::equilateral(1);
  cut::Simulation simulation = testing::simulated(mesh, {MaterialMode::paper});
  cut::Changes changes;
  changes.version_before = mesh.topology_version;
  changes.version_after = ++mesh.topology_version;
  const cut::Spring freed = mesh.buffers.springs[1];
  mesh.buffers.springs[1] = {};
  changes.springs = {{{1, {}}}, 3};
  REQUIRE_FALSE(simulation.apply(changes, mesh));
  CHECK(simulation.spring_count() == 2);
  CHECK(simulation.stiffness(SpringId{1u}) == 0);
  // Stretched along the freed spring only, the other two being turned about their common node.
  mesh.positions[freed.nodes[1].index()] += Eigen::Vector3d(0, 0, 0);
  REQUIRE_FALSE(simulation.step(mesh, 0.01));
  changes.version_before = mesh.topology_version;
  changes.version_after = ++mesh.topology_version;
  mesh.buffers.springs[1] = freed;
  changes.springs = {{{1, freed}}, 3};
  REQUIRE_FALSE(simulation.apply(changes, mesh));
  CHECK(simulation.spring_count() == 3);
  CHECK(simulation.stiffness(SpringId{1u}) == simulation.material().stiffness);
}

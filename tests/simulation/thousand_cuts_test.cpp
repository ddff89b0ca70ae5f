// What a cut must not change holds over a long sequence of them: a thousand cuts through the same few
// triangles, in cloth that swings freely meanwhile. In the end nearly all fragments are as small as the merge
// distances let them be.
#include <doctest/doctest.h>

#include <algorithm>
#include <cut/cutter.hpp>
#include <cut/pieces.hpp>
#include <cut/validate.hpp>
#include <numbers>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"

using cut::Integrator;

namespace {

/// An upright blade of random direction in the rest of the cloth, where no piece of it may have gone.
cut::TriangleMesh random_blade(const cut::HybridMesh& mesh, std::mt19937& random) {
  const auto& places = mesh.positions;
  const Eigen::Vector3d centre = (places[random() % places.size()] + places[random() % places.size()]) / 2 +
                                 testing::random_vector(random, 0.2);
  const double angle = std::uniform_real_distribution<double>(0, 2 * std::numbers::pi)(random);
  return scenes::plane(centre, Eigen::Vector3d(std::cos(angle), std::sin(angle), 0) * 2, {0, 0, 4});
}

struct Motion {
  double mass;
  Eigen::Vector3d centre, momentum, spin;
};

Motion motion_of(const cut::HybridMesh& mesh, const cut::Simulation& simulation) {
  return {simulation.total_mass(), simulation.centre_of_mass(mesh), simulation.momentum(),
          simulation.angular_momentum(mesh)};
}

}  // namespace

TEST_CASE("A thousand cuts keep mass, centre of mass, both momenta and the stable time step") {
  std::mt19937 random(4);
  cut::HybridMesh mesh = testing::built(scenes::twelve_triangles());
  cut::Simulation simulation = testing::simulated(mesh, cut::Material{});
  REQUIRE(simulation.material().bending_stiffness > 0);
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  testing::shake(mesh, simulation, random, 0.02, 0.3);
  const Motion start = motion_of(mesh, simulation);
  const double stable = simulation.cut_proof_time_step(Integrator::semi_implicit_euler, mesh);
  const double reach = 4, speed = 0.3;  // what the errors are measured by

  double worst = 0, time = 0;
  for (int c = 0; c < 1000; ++c) {
    const Motion before = motion_of(mesh, simulation);
    const auto changes = cutter.cut(mesh, random_blade(mesh, random));
    REQUIRE(changes);
    REQUIRE(cut::validate(mesh, 1).empty());
    REQUIRE_FALSE(simulation.apply(*changes, mesh));
    const Motion after = motion_of(mesh, simulation);
    worst = std::max({worst, std::abs(after.mass - start.mass) / start.mass,
                      (after.centre - start.centre - time / start.mass * start.momentum).norm() / reach,
                      (after.momentum - start.momentum).norm() / (start.mass * speed),
                      (after.spin - start.spin).norm() / (start.mass * speed * reach)});
    REQUIRE((after.centre - before.centre).norm() <= 1e-12 * reach);
    REQUIRE(simulation.stable_time_step(Integrator::semi_implicit_euler) >= stable * (1 - 1e-12));
    if (c % 20 != 0) continue;
    REQUIRE_FALSE(simulation.step(mesh, stable / 4, 2));
    time += stable / 2;
  }
  CHECK(worst <= 1e-12);
  CHECK(cut::pieces(mesh).list.size() > 1000);
}

// Springs that resist bending: two triangles with a common edge, whose motion has a closed form, and what
// cuts across and along that edge leave of their spring.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cut/bending.hpp>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <numbers>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"

using cut::Integrator;
using cut::MaterialMode;
using cut::NodeId;

namespace {

constexpr double half_width = 0.6, height = 0.8, side = 1;  // side² = half_width² + height²

/// Nodes 0 and 1 at the ends of the common edge, 2 and 3 opposite of it; folded up by so many degrees.
cut::HybridMesh hinge(double degrees) {
  const double fold = degrees * std::numbers::pi / 180;
  return testing::built({{{-half_width, 0, 0},
                          {half_width, 0, 0},
                          {0, height, 0},
                          {0, -height * std::cos(fold), height * std::sin(fold)}},
                         {{0, 1, 2}, {1, 0, 3}}});
}

/// How much of an uncut bending spring each one in use has, largest first.
std::vector<double> shares(const cut::Simulation& simulation) {
  const cut::SpringArrays& springs = simulation.bending_springs();
  std::vector<double> result;
  for (std::size_t s = 0; s < springs.nodes.size(); ++s) {
    if (springs.nodes[s][0] == springs.nodes[s][1]) continue;
    result.push_back(springs.stiffness[s] / simulation.material().bending_stiffness);
    CHECK(springs.damping[s] == doctest::Approx(result.back() * simulation.material().bending_damping));
    CHECK(springs.rest_length[s] == doctest::Approx(2 * height));
  }
  std::sort(result.rbegin(), result.rend());
  return result;
}

/// The shares after a cut from one point to another of the flat hinge.
std::vector<double> shares_after(MaterialMode mode, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  cut::HybridMesh mesh = hinge(0);
  cut::Simulation simulation = testing::simulated(mesh, {mode});
  cut::Cutter cutter(cut::default_merge_distances(mesh));
  const auto changes = cutter.cut(mesh, scenes::plane((from + to) / 2, to - from, {0, 0, 1}));
  REQUIRE(changes);
  REQUIRE(cut::validate(mesh, 1).empty());
  REQUIRE_FALSE(simulation.apply(*changes, mesh));
  return shares(simulation);
}

/// The largest difference from the closed form in 2 s, when node 3 of a hinge with a right angle swings in
/// one of the two modes across its edge; the amplitude is 1.
double largest_error(int mode, double time_step) {
  cut::HybridMesh mesh = hinge(90);
  const double k = 40, bending = 25, lag = 0.002;  // lag: damping over stiffness
  cut::Simulation simulation =
      testing::simulated(mesh, {MaterialMode::conserving, 2, k, lag * k, bending, lag * bending});
  for (const unsigned n : {0u, 1u, 2u}) simulation.anchor(NodeId{n});
  // In y and z: the bending spring runs at 45°; the edges' springs act along z.
  Eigen::Matrix2d stiffness;
  stiffness << bending / 2, -bending / 2, -bending / 2, bending / 2 + 2 * k * height * height / (side * side);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(stiffness);
  const Eigen::Vector2d along = modes.eigenvectors().col(mode);
  const double squared = modes.eigenvalues()[mode] / (2 * half_width * height / 3);
  const double decay = lag * squared / 2, frequency = std::sqrt(squared - decay * decay);

  const double amplitude = 1e-7;
  const Eigen::Vector3d rest = mesh.positions[3];
  mesh.positions[3].tail<2>() += amplitude * along;
  double error = 0;
  for (int i = 1; i * time_step < 2; ++i) {
    REQUIRE_FALSE(simulation.step(mesh, time_step));
    const double t = i * time_step;
    const double expected =
        std::exp(-decay * t) * (std::cos(frequency * t) + decay / frequency * std::sin(frequency * t));
    const Eigen::Vector3d way = (mesh.positions[3] - rest) / amplitude;
    error = std::max({error, std::abs(way.x()), (way.tail<2>() - expected * along).norm()});
  }
  return error;
}

}  // namespace

TEST_CASE("Two triangles at a right angle fold and stretch with the frequencies of the closed form") {
  for (const int mode : {0, 1}) {
    const double coarse = largest_error(mode, 2e-5), fine = largest_error(mode, 1e-5);
    CHECK(fine < 0.01);
    CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));
  }
}

TEST_CASE("A flat hinge folds under a load as far as statics says, and without bending springs all the way") {
  for (const double degrees : {20.0, 60.0}) {
    const double bending = 1, fold = degrees * std::numbers::pi / 180;
    // Around the edge: load · height · cos(fold) = 2 · bending · height² · (1 − cos(fold / 2)) · sin(fold /
    // 2).
    const double load = 2 * bending * height * (1 - std::cos(fold / 2)) * std::sin(fold / 2) / std::cos(fold);
    for (const bool bends : {true, false}) {
      cut::HybridMesh mesh = hinge(0);
      cut::Simulation simulation =
          testing::simulated(mesh, {MaterialMode::conserving, 0.2, 1e4, 1, bends ? bending : 0.0, 0});
      for (const unsigned n : {0u, 1u, 2u}) simulation.anchor(NodeId{n});
      simulation.set_force(NodeId{3u}, {0, 0, load});
      simulation.surroundings.air_drag = 0.5;
      REQUIRE_FALSE(simulation.step(mesh, 1e-4, 400'000));
      const double opened = std::atan2(mesh.positions[3].z(), -mesh.positions[3].y());
      if (bends) CHECK(simulation.velocity(NodeId{3u}).norm() < 1e-6);
      if (bends) CHECK(opened == doctest::Approx(fold).epsilon(1e-3));
      if (!bends) CHECK(opened > 1.4);
    }
  }
}

TEST_CASE("A cut across an edge divides its bending spring, one along it takes what it cuts") {
  const auto conserving = MaterialMode::conserving, paper = MaterialMode::paper;
  const std::vector<double> none, half{0.5}, two_halves{0.5, 0.5}, one{1}, two{1, 1};
  for (const auto mode : {conserving, paper}) CHECK(shares(testing::simulated(hinge(0), {mode})) == one);

  const std::vector<double> halves = shares_after(conserving, {0, -2, 0}, {0, 2, 0});
  REQUIRE(halves.size() == 2);
  for (const double share : halves) CHECK(share == doctest::Approx(0.5));
  CHECK(shares_after(paper, {0, -2, 0}, {0, 2, 0}) == two);

  for (const auto mode : {conserving, paper}) CHECK(shares_after(mode, {-2, 0, 0}, {2, 0, 0}) == none);
  CHECK(shares_after(conserving, {-2, 0, 0}, {0, 0, 0}) == half);
  CHECK(shares_after(paper, {-2, 0, 0}, {0, 0, 0}) == one);
}

TEST_CASE("Without bending stiffness and damping there are no bending springs") {
  const cut::HybridMesh mesh = hinge(0);
  CHECK(testing::simulated(mesh, {MaterialMode::conserving, 1, 1, 1, 0, 0}).bending_springs().nodes.empty());
  CHECK(shares(testing::simulated(mesh, {MaterialMode::conserving, 1, 1, 1})).size() == 1);
  CHECK(cut::Material{MaterialMode::conserving, 1, 40, 8}.bending_stiffness == 2);
  CHECK(cut::Material{MaterialMode::conserving, 1, 40, 8}.bending_damping == doctest::Approx(0.4));
}

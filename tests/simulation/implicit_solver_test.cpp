// The solver of an implicit step: how close it comes to the solution of the same system by elimination, that
// its number of iterations hardly grows with that of nodes, its coarse grids, and both versions of its loops.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <scenes/cutters.hpp>

#include "simulation/coarse_grids.hpp"
#include "simulation/implicit_kernels.hpp"
#include "simulation/meshes.hpp"

using cut::NodeId;
using cut::PaddedVector;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// (M + h·C + h²·K) Δv = h·(f − h·K·v) of the springs alone, put together.
struct System {
  MatrixXd matrix;
  VectorXd right;

  System(const cut::HybridMesh& mesh, const cut::Simulation& simulation, double h)
      : matrix(MatrixXd::Zero(size(mesh), size(mesh))), right(VectorXd::Zero(size(mesh))) {
    for (std::size_t n = 0; n < mesh.positions.size(); ++n)
      at(n, n) = simulation.mass(NodeId{n}) * Matrix3d::Identity();
    for (std::size_t i = 0; i < mesh.buffers.springs.size(); ++i) {
      const cut::Spring& s = mesh.buffers.springs[i];
      if (!s.nodes[0].valid()) continue;
      const cut::SpringId id{i};
      add(mesh, simulation, h, s.nodes, mesh.ancestors.rest_length(s.edge), simulation.stiffness(id),
          simulation.damping(id));
    }
    const cut::SpringArrays& bending = simulation.bending_springs();
    for (std::size_t i = 0; i < bending.nodes.size(); ++i)
      add(mesh, simulation, h, {NodeId{bending.nodes[i][0]}, NodeId{bending.nodes[i][1]}},
          bending.rest_length[i], bending.stiffness[i], bending.damping[i]);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (!simulation.anchored(NodeId{n})) continue;
      matrix.middleRows<3>(start(n)).setZero();
      matrix.middleCols<3>(start(n)).setZero();
      at(n, n).setIdentity();
      right.segment<3>(start(n)).setZero();
    }
  }

  static Eigen::Index start(std::size_t n) { return 3 * static_cast<Eigen::Index>(n); }

 private:
  static Eigen::Index size(const cut::HybridMesh& mesh) { return start(mesh.positions.size()); }
  Eigen::Block<MatrixXd, 3, 3> at(std::size_t a, std::size_t b) {
    return matrix.block<3, 3>(start(a), start(b));
  }
  void add(const cut::HybridMesh& mesh, const cut::Simulation& simulation, double h,
           const std::array<NodeId, 2>& nodes, double rest, double stiffness, double damping) {
    const std::size_t a = nodes[0].index(), b = nodes[1].index();
    if (a == b) return;
    const Vector3d between = mesh.positions[b] - mesh.positions[a];
    const Vector3d d = between.normalized();
    const Vector3d u = simulation.velocity(nodes[1]) - simulation.velocity(nodes[0]);
    const double across = stiffness * std::max(0.0, 1 - rest / between.norm());
    const Matrix3d k = across * Matrix3d::Identity() + (stiffness - across) * d * d.transpose();
    const Matrix3d c = damping * d * d.transpose();
    const Vector3d impulse = h * ((stiffness * (between.norm() - rest)) * d + c * u + h * (k * u));
    right.segment<3>(start(a)) += impulse;
    right.segment<3>(start(b)) -= impulse;
    const Matrix3d block = h * c + h * h * k;
    at(a, a) += block;
    at(b, b) += block;
    at(a, b) -= block;
    at(b, a) -= block;
  }
};

/// A sheet that was cut, stretched and pushed at random, and that one or no node is held of.
struct Shaken {
  cut::HybridMesh mesh;
  cut::Simulation simulation;

  Shaken(const cut::TriangleMesh& cloth, std::mt19937& random, std::size_t cuts)
      : mesh(testing::built(cloth)),
        simulation(testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 300, 0.05, 3, 0.01})) {
    simulation.surroundings.integrator = cut::Integrator::implicit_euler;
    simulation.surroundings.longest_way = 1e6;
    cut::Cutter knife(cut::default_merge_distances(mesh));
    for (std::size_t i = 0; i < cuts; ++i) {
      const Vector3d centre = mesh.positions[random() % mesh.positions.size()];
      Vector3d along = testing::random_vector(random, 1);
      along.z() = 0;
      const auto changes =
          knife.cut(mesh, scenes::plane(centre + testing::random_vector(random, 0.01), along, {0, 0.01, 3}));
      RC_ASSERT(changes.has_value());
      RC_ASSERT(!simulation.apply(*changes, mesh));
      RC_ASSERT(cut::validate(mesh, 1).empty());
    }
    if (random() % 2 == 0) simulation.anchor(NodeId{random() % mesh.positions.size()});
    for (Vector3d& p : mesh.positions) p *= 1.1;
    testing::shake(mesh, simulation, random, 0.02, 1);
  }
};

}  // namespace

TEST_CASE(
    "An implicit step is as near to the solution by elimination as the tolerance says, also after cuts") {
  rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const std::size_t columns = 1 + random() % 7, rows = 1 + random() % 7;
    Shaken s(scenes::random_sheet(columns, rows, 0.1, random()), random, random() % 4);
    const double h = random() % 2 == 0 ? 1e-3 : 1.0 / 60, tolerance = random() % 2 == 0 ? 1e-3 : 1e-8;
    s.simulation.surroundings.tolerance = tolerance;
    const System system(s.mesh, s.simulation, h);
    const VectorXd solution = system.matrix.ldlt().solve(system.right);
    std::vector<Vector3d> before;
    for (std::size_t n = 0; n < s.mesh.positions.size(); ++n)
      before.push_back(s.simulation.velocity(NodeId{n}));
    const auto failed = s.simulation.step(s.mesh, h);
    if (failed) RC_FAIL(failed->message);
    // |Δv − solution|² · m ≤ tolerance² · |right|² / m, since the matrix is no less than the mass.
    double error = 0, right = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
      const double mass = s.simulation.mass(NodeId{n});
      if (!(mass > 0)) continue;
      const auto of_node = [&](const VectorXd& v) -> Vector3d { return v.segment<3>(System::start(n)); };
      const Vector3d change = s.simulation.velocity(NodeId{n}) - before[n];
      error += mass * (change - of_node(solution)).squaredNorm();
      right += of_node(system.right).squaredNorm() / mass;
    }
    RC_ASSERT(std::sqrt(error) <= (tolerance + 1e-11) * std::sqrt(right));
  });
}

TEST_CASE("A stiff sheet of sixteen times the nodes takes hardly more iterations") {
  for (const std::size_t cells : {24u, 96u}) {
    cut::HybridMesh mesh = testing::built(scenes::grid(cells, cells, 0.01));
    cut::Simulation simulation = testing::simulated(mesh, {cut::MaterialMode::conserving, 0.2, 1000, 0.01});
    simulation.surroundings.integrator = cut::Integrator::implicit_euler;
    simulation.surroundings.gravity = {0, -9.81, 0};
    simulation.anchor(NodeId{0u});
    simulation.surroundings.most_iterations = 100;
    const auto error = simulation.step(mesh, 1.0 / 60, 3);
    CAPTURE((error ? error->message : ""));
    CHECK_FALSE(error);
  }
}

TEST_CASE("Functions of a coarse grid sum to one at each node, and none reaches across a cut") {
  cut::HybridMesh mesh = testing::built(scenes::random_sheet(50, 20, 0.1, 5));
  cut::Simulation simulation = testing::simulated(mesh, {});
  cut::Cutter knife(cut::default_merge_distances(mesh));
  const auto changes = knife.cut(mesh, scenes::plane({1.52, 1, 0}, {0.1, 3, 0}, {0, 0, 1}));
  REQUIRE(changes);
  cut::SpringArrays springs;
  for (const cut::Spring& s : mesh.buffers.springs) {
    springs.nodes.push_back(s.nodes[0].valid() ? std::array{s.nodes[0].value, s.nodes[1].value}
                                               : std::array{0u, 0u});
    springs.rest_length.push_back(s.nodes[0].valid() ? mesh.ancestors.rest_length(s.edge) : 0);
  }
  // Which side each node is on: springs do not join the two.
  std::vector<int> side(mesh.positions.size(), 0);
  side[0] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : springs.nodes)
      if (side[a] != side[b]) {
        side[a] = side[b] = 1;
        grows = true;
      }
  }
  const auto on_side = static_cast<std::size_t>(std::count(side.begin(), side.end(), 1));
  CHECK(on_side > 200);
  CHECK(on_side + 200 < side.size());

  const std::vector<cut::CoarseGrid> grids = cut::coarse_grids(mesh, springs);
  CHECK(grids.size() > 2);
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const cut::WeightRows& rows = g == 0 ? grids[g].to_finer : grids[g].at_nodes;
    REQUIRE(rows.begins.size() == mesh.positions.size() + 1);
    std::vector<int> sides(grids[g].residual.size(), 0);
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      double sum = 0;
      for (std::size_t i = rows.begins[n]; i < rows.begins[n + 1]; ++i) {
        CHECK(rows.weights[i] > 0);
        sum += rows.weights[i];
        sides[rows.columns[i]] |= 1 << side[n];
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-12));
    }
    for (const int s : sides) CHECK((s == 1 || s == 2));
    // Both matrices are one.
    const cut::WeightRows &to = grids[g].to_finer, &from = grids[g].from_finer;
    CHECK(to.columns.size() == from.columns.size());
    for (std::uint32_t r = 0; r + 1 < from.begins.size(); ++r)
      for (std::size_t i = from.begins[r]; i < from.begins[r + 1]; ++i) {
        double weight = 0;
        for (std::size_t k = to.begins[from.columns[i]]; k < to.begins[from.columns[i] + 1]; ++k)
          if (to.columns[k] == r) weight += to.weights[k];
        CHECK(weight == from.weights[i]);
      }
  }
}

TEST_CASE("The solver's loops for AVX2 give the bits of the plain ones") {
  std::mt19937 random(4);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  const auto vectors = [&](std::size_t count) {
    std::vector<PaddedVector> result(count);
    for (PaddedVector& v : result) v = {number(), random() % 7 == 0 ? -0.0 : number(), number(), 0};
    return result;
  };
  constexpr std::size_t nodes = 41, fours = 11, functions = 5;
  cut::ImplicitWork start;
  start.row_begins = {0};
  for (std::size_t i = 0; i < fours; ++i) {
    start.row_begins.push_back(start.row_begins.back() + static_cast<std::uint32_t>(random() % 9));
    cut::ImplicitWork::FourBlocks block, inverse;
    for (auto& values : block.values)
      for (double& v : values) v = number();
    for (auto& values : inverse.values)
      for (double& v : values) v = number();
    start.blocks.push_back(block);
    start.inverses.push_back(inverse);
  }
  for (std::size_t s = 0; s < start.row_begins.back(); ++s) {
    std::array<std::uint32_t, 4> others{};
    for (std::uint32_t& n : others) n = static_cast<std::uint32_t>(random() % nodes);
    start.others.push_back(others);
    cut::ImplicitWork::FourCouplings coupling;
    for (auto* values : {&coupling.x, &coupling.y, &coupling.z, &coupling.along, &coupling.across})
      for (double& v : *values) v = number();
    start.couplings.push_back(coupling);
  }
  for (std::size_t n = 0; n < 4 * fours; ++n)
    start.inverse_mass.push_back(n < nodes && n % 5 != 0 ? 1 + number() : 0);
  for (auto* v : {&start.change, &start.right, &start.residual, &start.preconditioned, &start.direction,
                  &start.product})
    *v = vectors(4 * fours);
  cut::CoarseGrid grid;
  for (std::size_t n = 0; n < nodes; ++n) {
    for (std::size_t i = random() % 5; i > 0; --i) {
      grid.to_finer.columns.push_back(static_cast<std::uint32_t>(random() % functions));
      grid.to_finer.weights.push_back(number());
    }
    grid.to_finer.begins.push_back(static_cast<std::uint32_t>(grid.to_finer.columns.size()));
  }
  grid.correction = vectors(functions);
  start.grids.push_back(grid);

  const auto run = [&](const cut::ImplicitKernels& kernels) {
    cut::ImplicitWork w = start;
    const double curvature = kernels.multiply(w, w.direction.data(), w.product.data(), 0, 7) +
                             kernels.multiply(w, w.direction.data(), w.product.data(), 7, fours);
    const double left = kernels.advance(w, 0.3, 0, fours), size = kernels.correct(w, 0, fours);
    kernels.turn(w, 0.7, 0, fours);
    kernels.approach(w, 0, 6);
    kernels.add_weighted(grid.to_finer, grid.correction.data(), w.change.data(), 3, nodes);
    return std::pair{std::array{curvature, left, size}, w};
  };
  const auto [sums, plain] = run(cut::portable_implicit_kernels());
  const auto [best_sums, best] = run(cut::best_implicit_kernels());
  CHECK(sums == best_sums);
  CHECK(sums[0] != 0);
  for (auto vector :
       {&cut::ImplicitWork::change, &cut::ImplicitWork::residual, &cut::ImplicitWork::preconditioned,
        &cut::ImplicitWork::direction, &cut::ImplicitWork::product})
    for (std::size_t n = 0; n < 4 * fours; ++n) {
      const PaddedVector &a = (plain.*vector)[n], &b = (best.*vector)[n];
      CHECK(std::array{a.x, a.y, a.z} == std::array{b.x, b.y, b.z});
    }
}

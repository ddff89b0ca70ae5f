#include "simulation/linear.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "simulation/meshes.hpp"

namespace testing {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr Eigen::Index none = -1;

/// The linear system of what is not held, x and y of each node.
struct System {
  std::vector<Eigen::Index> number;  ///< per node: of its x among the unknowns; `none`: held
  Sparse stiffness;
  Eigen::MatrixXd load;    ///< forces by held nodes, per given displacement field
  Eigen::VectorXd energy;  ///< of springs between held nodes and of the held ends alone
};

/// Calls visit(node, node, k) for all springs.
template <class Visit>
void for_each_spring(const cut::HybridMesh& mesh, const cut::Simulation& simulation, Visit&& visit) {
  for (std::size_t s = 0; s < mesh.buffers.springs.size(); ++s) {
    const auto& ends = mesh.buffers.springs[s].nodes;
    if (ends[0].valid()) visit(ends[0].index(), ends[1].index(), simulation.stiffness(cut::SpringId{s}));
  }
  const cut::SpringArrays& bending = simulation.bending_springs();
  for (std::size_t s = 0; s < bending.nodes.size(); ++s)
    if (bending.stiffness[s] > 0) visit(bending.nodes[s][0], bending.nodes[s][1], bending.stiffness[s]);
}

Eigen::Vector2d rest(const cut::HybridMesh& mesh, std::size_t node) {
  return mesh.ancestors.rest_positions[mesh.buffers.nodes[node].index()].head<2>();
}

/// @param fields  displacement of a held node at a place, one column for each field
System assemble(const cut::HybridMesh& mesh, const cut::Simulation& simulation, const Held& held,
                const std::vector<Eigen::Matrix2d>& fields) {
  System system;
  Eigen::Index unknowns = 0;
  for (std::size_t n = 0; n < mesh.buffers.nodes.size(); ++n) {
    const bool fixed = held(mesh.ancestors.rest_positions[mesh.buffers.nodes[n].index()]);
    system.number.push_back(fixed ? none : unknowns);
    if (!fixed) unknowns += 2;
  }
  const auto columns = static_cast<Eigen::Index>(fields.size());
  system.load = Eigen::MatrixXd::Zero(unknowns, columns);
  system.energy = Eigen::VectorXd::Zero(columns);
  std::vector<Eigen::Triplet<double>> entries;
  for_each_spring(mesh, simulation, [&](std::size_t a, std::size_t b, double k) {
    const Eigen::Vector2d along = (rest(mesh, b) - rest(mesh, a)).normalized();
    const Eigen::Matrix2d block = k * along * along.transpose();
    const std::array<std::size_t, 2> ends{a, b};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const Eigen::Index row = system.number[ends[i]], column = system.number[ends[j]];
        const double sign = i == j ? 1 : -1;
        if (row != none && column != none)
          for (Eigen::Index x = 0; x < 2; ++x)
            for (Eigen::Index y = 0; y < 2; ++y)
              entries.emplace_back(row + x, column + y, sign * block(x, y));
        for (Eigen::Index f = 0; column == none && f < columns; ++f) {
          const Eigen::Matrix2d& field = fields[static_cast<std::size_t>(f)];
          const Eigen::Vector2d force = sign * block * (field * rest(mesh, ends[j]));
          if (row != none)
            system.load.col(f).segment<2>(row) -= force;
          else
            system.energy[f] += (field * rest(mesh, ends[i])).dot(force) / 2;
        }
      }
  });
  system.stiffness.resize(unknowns, unknowns);
  system.stiffness.setFromTriplets(entries.begin(), entries.end());
  return system;
}

Sparse unit(Eigen::Index size) {
  Sparse result(size, size);
  result.setIdentity();
  return result;
}

}  // namespace

std::vector<double> frequencies(const cut::HybridMesh& mesh, const cut::Simulation& simulation,
                                const Held& held, std::size_t count) {
  System system = assemble(mesh, simulation, held, {});
  const Eigen::Index size = system.stiffness.rows();
  Eigen::VectorXd root_mass(size);
  for (std::size_t n = 0; n < system.number.size(); ++n)
    if (system.number[n] != none)
      root_mass.segment<2>(system.number[n]).setConstant(std::sqrt(simulation.mass(cut::NodeId{n})));
  const Eigen::VectorXd inverse = root_mass.cwiseInverse();
  const Sparse scaled = inverse.asDiagonal() * system.stiffness * inverse.asDiagonal();
  // Shifted, since a flap that hangs on one node turns without strain.
  const double shift = 1e-6 * scaled.diagonal().mean();
  const Eigen::SimplicialLDLT<Sparse> solver(scaled + shift * unit(size));
  // Subspace iteration: a few vectors more than wanted turn towards the lowest modes.
  const auto columns = static_cast<Eigen::Index>(2 * count + 4);
  Eigen::MatrixXd modes(size, columns);
  std::mt19937 random(1);
  for (Eigen::Index i = 0; i < modes.size(); ++i) modes(i) = random_vector(random, 1).x();
  Eigen::VectorXd squared;
  for (int i = 0; i < 40; ++i) {
    modes = solver.solve(modes);
    modes = Eigen::HouseholderQR<Eigen::MatrixXd>(modes).householderQ() *
            Eigen::MatrixXd::Identity(size, columns);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(modes.transpose() * scaled * modes);
    modes = modes * small.eigenvectors();
    squared = small.eigenvalues();
  }
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(std::sqrt(std::max(0.0, squared[static_cast<Eigen::Index>(i)])));
  return result;
}

std::vector<double> stretch_energies(const cut::HybridMesh& mesh, const cut::Simulation& simulation,
                                     const Held& held, const std::vector<double>& directions) {
  std::vector<Eigen::Matrix2d> fields;
  for (const double degrees : directions) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    fields.emplace_back(along * along.transpose());
  }
  const System system = assemble(mesh, simulation, held, fields);
  const double shift = 1e-12 * system.stiffness.diagonal().mean();  // against flaps, as above
  const Eigen::SimplicialLDLT<Sparse> solver(system.stiffness + shift * unit(system.stiffness.rows()));
  const Eigen::MatrixXd moved = solver.solve(system.load);
  std::vector<double> energies;
  for (Eigen::Index f = 0; f < moved.cols(); ++f)
    energies.push_back(system.energy[f] - moved.col(f).dot(system.load.col(f)) / 2);
  return energies;
}

cut::HybridMesh refined(const cut::HybridMesh& mesh) {
  cut::HybridMesh at_rest = mesh;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    at_rest.positions[n] = mesh.ancestors.rest_positions[mesh.buffers.nodes[n].index()];
  cut::TriangleMesh triangles;
  for (const cut::RenderVertex& vertex : mesh.buffers.render_vertices)
    triangles.positions.push_back(vertex.triangle.valid() ? at_rest.position(vertex)
                                                          : Eigen::Vector3d(0, 0, 0));
  for (const cut::RenderTriangle& triangle : mesh.buffers.render_triangles)
    if (triangle.triangle.valid())
      triangles.triangles.push_back(
          {triangle.vertices[0].value, triangle.vertices[1].value, triangle.vertices[2].value});
  return built(triangles);
}

}  // namespace testing

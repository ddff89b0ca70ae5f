// An implicit step (docs/simulation.md, "The implicit step"). In: positions, velocities, forces at the start.
// Out: the next velocities.
//
// Backward Euler, linearised at the start of the step, with K = −∂f/∂p and C = −∂f/∂v:
//   (M + h·C + h²·K) Δv = h·(f − h·K·v)
// The part of K across a compressed spring would be negative and is left out, so that the matrix is positive
// definite. Of it there are the springs of each node, by nodes in fours. Solved by conjugate gradients,
// preconditioned with the inverses of the 3×3 blocks of its diagonal and with coarse grids
// (coarse_grids.hpp).
#include <algorithm>
#include <cmath>
#include <string>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/coarse_grids.hpp"
#include "simulation/contact.hpp"
#include "simulation/drag.hpp"
#include "simulation/implicit_kernels.hpp"
#include "simulation/implicit_system.hpp"
#include "simulation/kernels.hpp"
#include "simulation/padded.hpp"

namespace cut {

using Vectors = std::vector<PaddedVector>;

/// Finds the springs of each node and the coarse grids, after a cut.
void Simulation::arrange_system(const HybridMesh& mesh) {
  ImplicitWork& w = implicit_;
  if (w.topology_version == topology_version_) return;
  w.topology_version = topology_version_;
  const std::size_t nodes = mass_.size(), fours = (nodes + 3) / 4;
  for (Vectors* v : {&w.change, &w.right, &w.residual, &w.preconditioned, &w.direction, &w.product})
    v->assign(4 * fours, {});
  w.blocks.assign(fours, {});
  w.inverses.assign(fours, {});
  w.inverse_mass.assign(4 * fours, 0);

  std::vector<std::uint32_t> counts(4 * fours, 0);
  const auto for_each_spring = [&](const auto& act) {
    for (const SpringArrays* springs : spring_lists())
      for (std::size_t i = 0; i < springs->nodes.size(); ++i) {
        const auto [a, b] = springs->nodes[i];
        if (a == b) continue;
        act(*springs, i, a, b);
        act(*springs, i, b, a);
      }
  };
  for_each_spring([&](const auto&, std::size_t, std::uint32_t from, std::uint32_t) { ++counts[from]; });
  w.row_begins.assign(1, 0);
  for (std::size_t i = 0; i < fours; ++i)
    w.row_begins.push_back(w.row_begins.back() + *std::max_element(&counts[4 * i], &counts[4 * i] + 4));
  w.others.resize(w.row_begins.back());
  w.springs.assign(w.row_begins.back(), {});
  w.couplings.assign(w.row_begins.back(), {});
  for (std::uint32_t i = 0; i < fours; ++i)
    for (std::size_t s = w.row_begins[i]; s < w.row_begins[i + 1]; ++s)
      w.others[s] = {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3};
  std::fill(counts.begin(), counts.end(), 0);
  for_each_spring([&](const SpringArrays& springs, std::size_t i, std::uint32_t from, std::uint32_t to) {
    const std::size_t s = w.row_begins[from / 4] + counts[from]++, lane = from % 4;
    w.others[s][lane] = to;
    w.springs[s].rest_length[lane] = springs.rest_length[i];
    w.springs[s].stiffness[lane] = springs.stiffness[i];
    w.springs[s].damping[lane] = springs.damping[i];
  });
  w.grids = coarse_grids(mesh, springs_);
}

/// Matrix and right side of a step.
void Simulation::set_up_system(const HybridMesh& mesh, double time_step) {
  arrange_system(mesh);
  ImplicitWork& w = implicit_;
  const std::size_t nodes = mass_.size();
  w.touches.assign(nodes, 0);
  w.contacts.clear();
  if (surroundings.normal_drag > 0) find_air_forces(mesh);
  static_cast<void>(find_forces(nullptr));
  const double drag = surroundings.air_drag / material_.density;
  const PaddedVector acceleration = padded(surroundings.gravity + drag * surroundings.wind);
  for (std::size_t n = 0; n < nodes; ++n) {
    w.inverse_mass[n] = inverse_mass_[n];
    const double diagonal = inverse_mass_[n] > 0 ? mass_[n] * (1 + time_step * drag) : 0;
    put_block(w.blocks, n, {diagonal, diagonal, diagonal, 0, 0, 0});
  }
  if (surroundings.normal_drag > 0)
    for_each_dragged_corner(mesh.buffers, positions_, weights_, surroundings.normal_drag,
                            [&](std::size_t n, const Eigen::Vector3d& normal, double c) {
                              if (!(inverse_mass_[n] > 0)) return;
                              SymmetricBlock block = block_of(w.blocks, n);
                              add_square(block, time_step * c, normal);
                              put_block(w.blocks, n, block);
                            });
  // A node with all its springs, which those at their other ends look at for themselves.
  const auto set_up_node = [&](std::size_t n) {
    SymmetricBlock diagonal = block_of(w.blocks, n);
    PaddedVector right = time_step * (forces_[n] + mass_[n] * (acceleration - drag * velocities_[n]));
    const bool held = !(inverse_mass_[n] > 0);
    for (std::size_t s = w.row_begins[n / 4]; s < w.row_begins[n / 4 + 1]; ++s) {
      ImplicitWork::FourCouplings& c = w.couplings[s];
      const std::size_t lane = n % 4, other = w.others[s][lane];
      c.across[lane] = c.along[lane] = 0;
      if (held || other == n) continue;
      const Eigen::Vector3d between = plain(positions_[other] - positions_[n]);
      const double squared = squared_length(between);
      const double size = std::sqrt(squared);
      const double stiffness = time_step * time_step * w.springs[s].stiffness[lane];
      const bool apart = squared >= smallest_squared_length;
      const double across = apart ? stiffness * std::max(0.0, 1 - w.springs[s].rest_length[lane] / size) : 0;
      const Eigen::Vector3d d = apart ? Eigen::Vector3d(between / size) : Eigen::Vector3d::Zero();
      // −h²·K·v.
      const PaddedVector u = velocities_[other] - velocities_[n];
      const double part = (stiffness - across) * ((d.x() * u.x + d.y() * u.y) + d.z() * u.z);
      right = right + PaddedVector{across * u.x + part * d.x(), across * u.y + part * d.y(),
                                   across * u.z + part * d.z(), 0};
      c.x[lane] = d.x();
      c.y[lane] = d.y();
      c.z[lane] = d.z();
      c.across[lane] = across;
      c.along[lane] = (stiffness - across) + time_step * w.springs[s].damping[lane];
      add_square(diagonal, c.along[lane], d);
      for (std::size_t k = 0; k < 3; ++k) diagonal[k] += across;
    }
    put_block(w.inverses, n, held ? SymmetricBlock{} : inverse(diagonal));
    w.right[n] = held ? PaddedVector{} : right;  // a force there need not even be finite
  };
  for_each_range(executor, w.blocks.size(), range_size,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t n = 4 * first; n < std::min(nodes, 4 * last); ++n) set_up_node(n);
                 });
  look_at_system(w, executor);
}

/// `product` = matrix · vector, both 0 at nodes that are held. Returns vector · product.
double Simulation::multiply(const Vectors& vector) {
  ImplicitWork& w = implicit_;
  return sum_over(executor, w, [&](std::size_t first, std::size_t last) {
    return best_implicit_kernels().multiply(w, vector.data(), w.product.data(), first, last);
  });
}

/// `residual` = what is left of the right side. Returns its size, as `advance` of ImplicitKernels does, and
/// leaves in `preconditioned` what that does.
double Simulation::find_residual() {
  ImplicitWork& w = implicit_;
  multiply(w.change);
  w.residual = w.right;
  w.direction.assign(w.direction.size(), {});
  return advance(1);
}

/// Goes along `direction`.
double Simulation::advance(double way) {
  return sum_over(executor, implicit_, [&](std::size_t first, std::size_t last) {
    return best_implicit_kernels().advance(implicit_, way, first, last);
  });
}

/// Adds to `preconditioned` what the coarse grids know. Returns residual · preconditioned.
double Simulation::precondition() {
  find_correction(implicit_, executor);
  return sum_over(executor, implicit_, [&](std::size_t first, std::size_t last) {
    return best_implicit_kernels().correct(implicit_, first, last);
  });
}

/// Improves `change` until the residual is small. Free nodes then get the rest of it as an impulse: sums of
/// pairs of forces, which conserve momentum whatever the tolerance is.
std::optional<Error> Simulation::solve(double tolerance) {
  ImplicitWork& w = implicit_;
  const double enough = tolerance * tolerance * weighted_square(w.right, w.inverse_mass);
  double left = find_residual(), size = 0;
  for (std::size_t i = 0; !(left <= enough); ++i) {
    const double next = precondition(), part = i == 0 ? 0 : next / size;
    size = next;
    for_each_range(executor, w.blocks.size(), range_size,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     best_implicit_kernels().turn(w, part, first, last);
                   });
    const double curvature = multiply(w.direction);
    // Not even a direction is left when rounding is all there is, and none is sound after an overflow.
    if (i == surroundings.most_iterations || !(curvature > 0)) return not_solved(i);
    left = advance(size / curvature);
  }
  find_residual();
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    w.change[n] = w.change[n] + inverse_mass_[n] * w.residual[n];
    forces_[n] = velocities_[n] + w.change[n];
  }
  return std::nullopt;
}

/// Names the node with the largest residual.
Error Simulation::not_solved(std::size_t iterations) const {
  std::size_t node = 0;
  double largest = -1;
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    const double size = squared_length(plain(implicit_.residual[n])) * inverse_mass_[n];
    if (size <= largest) continue;  // also takes what is not a number
    node = n;
    largest = size;
    if (!std::isfinite(size)) break;
  }
  return {Error::Kind::not_converged,
          "implicit step " + std::to_string(updates_ + 1) + " did not converge in " +
              std::to_string(iterations) + " iterations: node " + std::to_string(node) +
              " is the furthest off; the state before that step is kept (a smaller time step needs fewer)",
          node};
}

/// Leaves the next velocities in `forces_`.
std::optional<Error> Simulation::implicit_velocities(const HybridMesh& mesh, double time_step,
                                                     double speed_limit, const Obstacles& obstacles) {
  set_up_system(mesh, time_step);
  if (auto error = unsound_forces()) return error;
  const auto solve_from_rest = [&](double tolerance) {
    std::fill(implicit_.change.begin(), implicit_.change.end(), PaddedVector{});
    return solve(tolerance);
  };
  // Rough solutions show most contacts.
  const double exact = surroundings.tolerance, rough = std::max(exact, 1e-3);
  bool touches = false;
  if (!obstacles.empty()) {
    if (auto error = solve_from_rest(rough)) return error;
    touches = find_contacts(obstacles);
  }
  if (!touches) {
    if (auto error = solve_from_rest(exact)) return error;
    touches = find_contacts(obstacles);
  }
  if (!touches) return unsound_velocity(speed_limit);
  for (const double tolerance : {rough, exact}) {
    do {
      if (auto error = settle_contacts(tolerance)) return error;
    } while (find_contacts(obstacles));
  }
  return unsound_velocity(speed_limit);
}

}  // namespace cut

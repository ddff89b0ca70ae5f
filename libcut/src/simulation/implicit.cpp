// An implicit step (docs/simulation.md, "The implicit step"). In: positions, velocities, forces at the start.
// Out: the next velocities.
//
// Backward Euler, linearised at the start of the step, with K = −∂f/∂p and C = −∂f/∂v:
//   (M + h·C + h²·K) Δv = h·(f − h·K·v)
// The part of K across a compressed spring would be negative and is left out, so that the matrix is positive
// definite. It is never put together: its product with a vector is a loop over the springs. Solved by
// conjugate gradients, preconditioned with the inverses of the 3×3 blocks of its diagonal.
#include <algorithm>
#include <cmath>
#include <string>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/contact.hpp"
#include "simulation/drag.hpp"
#include "simulation/implicit_system.hpp"
#include "simulation/kernels.hpp"
#include "simulation/padded.hpp"

namespace cut {
namespace {

using Block = ImplicitWork::Block;
using Vectors = std::vector<PaddedVector>;

void add_square(Block& block, double factor, const Eigen::Vector3d& n) {
  block[0] += factor * n.x() * n.x();
  block[1] += factor * n.y() * n.y();
  block[2] += factor * n.z() * n.z();
  block[3] += factor * n.x() * n.y();
  block[4] += factor * n.y() * n.z();
  block[5] += factor * n.z() * n.x();
}

PaddedVector product(const ImplicitWork::Coupling& c, const PaddedVector& v) {
  const double part = c.along * ((c.x * v.x + c.y * v.y) + c.z * v.z);
  return {c.across * v.x + part * c.x, c.across * v.y + part * c.y, c.across * v.z + part * c.z, 0};
}

double dot(const Vectors& a, const Vectors& b) {
  PaddedVector sum;
  for (std::size_t n = 0; n < a.size(); ++n) {
    sum.x += a[n].x * b[n].x;
    sum.y += a[n].y * b[n].y;
    sum.z += a[n].z * b[n].z;
  }
  return (sum.x + sum.y) + sum.z;
}

}  // namespace

/// Matrix and right side of a step.
void Simulation::set_up_system(const HybridMesh& mesh, double time_step) {
  ImplicitWork& w = implicit_;
  const std::size_t nodes = mass_.size();
  for (Vectors* v : {&w.change, &w.right, &w.residual, &w.preconditioned, &w.direction, &w.product})
    v->resize(nodes);
  w.blocks.resize(nodes);
  w.inverses.resize(nodes);
  w.touches.assign(nodes, 0);
  w.contacts.clear();
  std::size_t count = 0;
  for (const SpringArrays* springs : spring_lists()) count += springs->nodes.size();
  w.couplings.resize(count);

  if (surroundings.normal_drag > 0) find_air_forces(mesh);
  static_cast<void>(find_forces(nullptr));
  const double drag = surroundings.air_drag / material_.density;
  const PaddedVector acceleration = padded(surroundings.gravity + drag * surroundings.wind);
  for (std::size_t n = 0; n < nodes; ++n) {
    w.right[n] = time_step * (forces_[n] + mass_[n] * (acceleration - drag * velocities_[n]));
    const double diagonal = mass_[n] * (1 + time_step * drag);
    w.blocks[n] = {diagonal, diagonal, diagonal, 0, 0, 0};
  }
  if (surroundings.normal_drag > 0)
    for_each_dragged_corner(mesh.buffers, positions_, weights_, surroundings.normal_drag,
                            [&](std::size_t n, const Eigen::Vector3d& normal, double c) {
                              add_square(w.blocks[n], time_step * c, normal);
                            });
  w.inverses = w.blocks;
  auto coupling = w.couplings.begin();
  for (const SpringArrays* springs : spring_lists())
    for (std::size_t i = 0; i < springs->nodes.size(); ++i, ++coupling) {
      const auto [a, b] = springs->nodes[i];
      const Eigen::Vector3d between = plain(positions_[b] - positions_[a]);
      const double squared = squared_length(between);
      const double size = std::sqrt(squared);
      const double stiffness = time_step * time_step * springs->stiffness[i];
      const bool apart = squared >= smallest_squared_length;
      const double across = apart ? stiffness * std::max(0.0, 1 - springs->rest_length[i] / size) : 0;
      const Eigen::Vector3d d = apart ? Eigen::Vector3d(between / size) : Eigen::Vector3d::Zero();
      *coupling = {d.x(), d.y(), d.z(), stiffness - across, across};
      // −h²·K·v.
      const PaddedVector change = product(*coupling, velocities_[b] - velocities_[a]);
      w.right[a] = w.right[a] + change;
      w.right[b] = w.right[b] - change;
      coupling->along += time_step * springs->damping[i];
      for (const std::uint32_t n : {a, b}) {
        add_square(w.inverses[n], coupling->along, d);
        for (std::size_t k = 0; k < 3; ++k) w.inverses[n][k] += across;
      }
    }
  for (std::size_t n = 0; n < nodes; ++n)
    w.inverses[n] = inverse_mass_[n] > 0 ? inverse(w.inverses[n]) : Block{};
  leave_held(w.right);  // a force there need not even be finite
}

/// `product` = matrix · vector.
void Simulation::multiply(const std::vector<PaddedVector>& vector) {
  ImplicitWork& w = implicit_;
  for (std::size_t n = 0; n < vector.size(); ++n) w.product[n] = product(w.blocks[n], vector[n]);
  auto coupling = w.couplings.cbegin();
  for (const SpringArrays* springs : spring_lists())
    for (const auto& [a, b] : springs->nodes) {
      const PaddedVector change = product(*coupling++, vector[b] - vector[a]);
      w.product[a] = w.product[a] - change;
      w.product[b] = w.product[b] + change;
    }
}

/// Sets to zero what the nodes that are held cannot do.
void Simulation::leave_held(std::vector<PaddedVector>& vectors) const {
  for (std::size_t n = 0; n < vectors.size(); ++n)
    if (!(inverse_mass_[n] > 0)) vectors[n] = {};
}

/// `residual` = what is left of the right side.
void Simulation::find_residual() {
  ImplicitWork& w = implicit_;
  multiply(w.change);
  for (std::size_t n = 0; n < w.right.size(); ++n) w.residual[n] = w.right[n] - w.product[n];
  leave_held(w.residual);
}

/// Improves `change` until the residual is small. Free nodes then get the rest of it as an impulse: sums of
/// pairs of forces, which conserve momentum whatever the tolerance is.
std::optional<Error> Simulation::solve(double tolerance) {
  ImplicitWork& w = implicit_;
  const auto precondition = [&] {
    for (std::size_t n = 0; n < w.residual.size(); ++n)
      w.preconditioned[n] = product(w.inverses[n], w.residual[n]);
    leave_held(w.preconditioned);
  };
  find_residual();
  const double enough = tolerance * tolerance * weighted_square(w.right, inverse_mass_);
  const auto done = [&] { return weighted_square(w.residual, inverse_mass_) <= enough; };
  precondition();
  w.direction = w.preconditioned;
  double size = dot(w.residual, w.preconditioned);
  for (std::size_t i = 0; !done(); ++i) {
    multiply(w.direction);
    leave_held(w.product);
    const double curvature = dot(w.direction, w.product);
    // Not even a direction is left when rounding is all there is, and none is sound after an overflow.
    if (i == surroundings.most_iterations || !(curvature > 0)) return not_solved(i);
    const double way = size / curvature;
    for (std::size_t n = 0; n < w.change.size(); ++n) {
      w.change[n] = w.change[n] + way * w.direction[n];
      w.residual[n] = w.residual[n] - way * w.product[n];
    }
    precondition();
    const double next = dot(w.residual, w.preconditioned);
    for (std::size_t n = 0; n < w.direction.size(); ++n)
      w.direction[n] = w.preconditioned[n] + (next / size) * w.direction[n];
    size = next;
  }
  find_residual();
  for (std::size_t n = 0; n < w.change.size(); ++n) {
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

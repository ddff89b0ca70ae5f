// Contact in an implicit step (docs/simulation.md, "Contact"). In: the system of the step and a first
// solution without contact. Out: a solution in which each node that touches an obstacle obeys the law of
// contact, the same one as in explicit steps.
//
// Accelerated gradient steps: half the inverse of the diagonal times the residual moves each node, then the
// law is applied to each that touches, alone. Matrix ≤ 2·diagonal, since each spring has two ends, so no step
// is too long. Momentum between steps as by Nesterov, from zero again when it points uphill (O'Donoghue and
// Candès, "Adaptive Restart for Accelerated Gradient Schemes", 2015).
#include <algorithm>
#include <cmath>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/contact.hpp"
#include "simulation/implicit_kernels.hpp"
#include "simulation/implicit_system.hpp"
#include "simulation/padded.hpp"

namespace cut {
namespace {

using Contact = ImplicitWork::Contact;

/// Largest sum of a row: no less than the largest eigenvalue.
double bound(const SymmetricBlock& b) {
  return std::max({std::abs(b[0]) + std::abs(b[3]) + std::abs(b[5]),
                   std::abs(b[3]) + std::abs(b[1]) + std::abs(b[4]),
                   std::abs(b[5]) + std::abs(b[4]) + std::abs(b[2])});
}

/// The velocity after contact of a node that would have `velocity` without: the obstacle pushes as much as is
/// needed, friction brakes with what its limit allows.
/// @param mobility  change of velocity per impulse
/// @param share     how much of the friction limit that belongs to that push replaces the one so far
Eigen::Vector3d after_contact(Contact& contact, Eigen::Vector3d velocity, double mobility, double share) {
  const Eigen::Vector3d& n = contact.normal;
  const double push = std::max(0.0, contact.least - dot(velocity, n));
  contact.limit += share * (contact.friction * push / mobility - contact.limit);
  velocity += push * n;
  return braked(velocity, contact.velocity, n, contact.limit * mobility);
}

/// The law of contact makes the limit of friction a multiple of the push. With high friction the two may
/// chase each other without end. So their mean over some iterations is taken, and after that stays: the
/// problem is then convex.
double share_of_new_limit(std::size_t iteration) {
  constexpr std::size_t free = 2000, averaged = 1000;
  if (iteration < free) return 1;
  return iteration < free + averaged ? 1.0 / static_cast<double>(iteration - free + 1) : 0;
}

}  // namespace

/// Adds a contact for each node that the solution so far lets into an obstacle. Returns whether there are
/// any.
bool Simulation::find_contacts(const Obstacles& obstacles) {
  ImplicitWork& w = implicit_;
  const std::size_t before = w.contacts.size();
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    if (w.touches[n] || !(inverse_mass_[n] > 0)) continue;
    const Eigen::Vector3d velocity = plain(forces_[n]);
    const auto met = obstacles.deepest(plain(positions_[n]), velocity);
    if (!met) continue;
    w.touches[n] = 1;
    w.contacts.push_back({static_cast<std::uint32_t>(n), met->friction, met->normal,
                          dot(velocity, met->normal) + met->depth / obstacles.time_step(), met->velocity, 0,
                          bound(inverse(block_of(w.inverses, n)))});
  }
  return w.contacts.size() > before;
}

/// Improves `change` until the residual is small, what contacts give included; `solve` without contacts.
std::optional<Error> Simulation::settle_contacts(double tolerance) {
  ImplicitWork& w = implicit_;
  const std::size_t nodes = mass_.size();
  const double enough = tolerance * tolerance * weighted_square(w.right, w.inverse_mass);
  std::vector<PaddedVector>&last = w.change, &reached = w.direction, &next = w.preconditioned;
  reached = last;
  double age = 1;
  for (std::size_t i = 0;; ++i) {
    if (i == surroundings.most_iterations) return not_solved(i);
    multiply(reached);
    for_each_range(executor, w.blocks.size(), range_size,
                   [&](std::size_t, std::size_t first, std::size_t end) {
                     best_implicit_kernels().approach(w, first, end);
                   });
    for (Contact& c : w.contacts) {
      const Eigen::Vector3d start = plain(velocities_[c.node]);
      const Eigen::Vector3d before = plain(reached[c.node]) + start;
      const double mobility = 0.5 / c.stiffness;
      const Eigen::Vector3d after =
          after_contact(c, before + mobility * plain(w.residual[c.node]), mobility, share_of_new_limit(i));
      next[c.node] = padded(after - start);
      w.residual[c.node] = padded((after - before) / mobility);
    }
    if (weighted_square(w.residual, w.inverse_mass) <= enough) break;
    double downhill = 0;
    for (std::size_t n = 0; n < nodes; ++n) downhill += dot(plain(w.residual[n]), plain(next[n] - last[n]));
    const double older = downhill < 0 ? 1 : (1 + std::sqrt(1 + 4 * age * age)) / 2;
    const double momentum = downhill < 0 ? 0 : (age - 1) / older;
    age = older;
    for (std::size_t n = 0; n < nodes; ++n) reached[n] = next[n] + momentum * (next[n] - last[n]);
    std::swap(last, next);
  }
  // As in `solve`, the rest becomes an impulse.
  for (std::size_t n = 0; n < nodes; ++n)
    forces_[n] = velocities_[n] + reached[n] + inverse_mass_[n] * (w.right[n] - w.product[n]);
  for (Contact& c : w.contacts)
    forces_[c.node] = padded(after_contact(c, plain(forces_[c.node]), inverse_mass_[c.node], 0));
  for (std::size_t n = 0; n < nodes; ++n) last[n] = forces_[n] - velocities_[n];
  return std::nullopt;
}

}  // namespace cut

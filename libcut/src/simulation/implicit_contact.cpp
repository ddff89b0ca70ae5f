// Contact in an implicit step (docs/simulation.md, "Contact"). In: the solution of the system with the
// contacts so far. Out: the contacts as that solution asks for them, for the next one: a node that goes in is
// held; one that is pulled back is let go; friction holds a node as long as the impulse for it is within
// Coulomb's cone, else it slides.
#include <algorithm>
#include <cmath>

#include "cut/simulation.hpp"
#include "mesh/vector3.hpp"
#include "simulation/contact.hpp"
#include "simulation/padded.hpp"

namespace cut {
namespace {

using Contact = ImplicitWork::Contact;

/// Friction is known when it changes by less than this part of itself.
constexpr double friction_tolerance = 1e-3;

enum class Verdict { stays, changes, leaves };

/// @param impulse   what the obstacle has given to the node, and friction if the node sticks
/// @param velocity  of the node, relative to the obstacle's
/// @param late      nodes that slide no longer stick again, so that the passes come to an end
Verdict review(Contact& contact, const Eigen::Vector3d& impulse, const Eigen::Vector3d& velocity, bool late) {
  const Eigen::Vector3d& n = contact.normal;
  const double push = dot(impulse, n);
  if (push < 0) return Verdict::leaves;
  const double most = contact.friction * push;
  if (contact.sticks) {
    const Eigen::Vector3d along = impulse - push * n;
    const double size = length(along);
    if (size <= most) return Verdict::stays;
    contact.sticks = false;
    contact.impulse = most / size * along;
    return Verdict::changes;
  }
  const Eigen::Vector3d along = velocity - dot(velocity, n) * n;
  const double speed = length(along);
  if (most > 0 && dot(along, contact.impulse) > 0) {  // friction has turned it round
    if (late) {
      contact.impulse /= 2;
      return Verdict::changes;
    }
    contact.sticks = true;
    contact.impulse.setZero();
    return Verdict::changes;
  }
  const Eigen::Vector3d next = speed > 0 ? Eigen::Vector3d(-most / speed * along) : contact.impulse;
  if (length(next - contact.impulse) <= friction_tolerance * most) return Verdict::stays;
  contact.impulse = next;
  return Verdict::changes;
}

}  // namespace

/// Returns whether anything has changed; `change` then fits the contacts.
bool Simulation::update_contacts(const Obstacles& obstacles, double time_step, bool late) {
  ImplicitWork& w = implicit_;
  bool changed = false;
  w.contacts.reserve(mass_.size());
  multiply(w.change);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < w.contacts.size(); ++i) {
    Contact contact = w.contacts[i];
    const Eigen::Vector3d impulse = plain(w.product[contact.node] - w.right[contact.node]);
    const Verdict verdict =
        review(contact, impulse, plain(forces_[contact.node]) - contact.obstacle_velocity, late);
    changed |= verdict != Verdict::stays;
    if (verdict == Verdict::leaves)
      w.touched[contact.node] = 0;
    else
      w.contacts[kept++] = contact;
  }
  w.contacts.resize(kept);
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    if (w.touched[n] || !(inverse_mass_[n] > 0)) continue;
    const Eigen::Vector3d velocity = plain(forces_[n]);
    const auto met = obstacles.deepest(plain(positions_[n]), velocity);
    if (!met) continue;
    changed = true;
    w.touched[n] = 1;
    const double across = dot(velocity, met->normal) + met->depth / time_step;
    const Eigen::Vector3d along = met->velocity - dot(met->velocity, met->normal) * met->normal;
    w.contacts.push_back({static_cast<std::uint32_t>(n), met->friction > 0, met->friction, met->normal,
                          along + across * met->normal, met->velocity, Eigen::Vector3d::Zero()});
  }
  if (changed)
    for (const Contact& contact : w.contacts) {
      const Eigen::Vector3d start = plain(velocities_[contact.node]);
      Eigen::Vector3d next = plain(w.change[contact.node]) + start;
      const Eigen::Vector3d missing = contact.velocity - next;
      next += contact.sticks ? missing : dot(missing, contact.normal) * contact.normal;
      w.change[contact.node] = padded(next - start);
    }
  return changed;
}

}  // namespace cut

/// @file
/// What the cloth is made of, and what a cut does to it (§3.1; docs/decisions.md, "Conserving material").
#pragma once
#include <cstdint>

namespace cut {

/// What becomes of mass and springs where a cut copies physics nodes.
enum class MaterialMode : std::uint8_t {
  /// Every fragment carries the part of mass and springs that its render polygon stands for: for corner i the
  /// weight w_i = ∫_f N_i / ∫_T N_i of fragment f in triangle T, N_i the barycentric coordinate. A fragment's
  /// share of a spring between corners i and j is min(w_i, w_j). Fragments f and g that share the part s of
  /// an edge, of which they reach the parts l, have s · min(1, w_f / l_f, w_g / l_g) of its bending spring, w
  /// at the opposite corners. A fragment that is cut again divides its own weights among its parts. Mass,
  /// centre of mass and momentum are the
  /// same before and after a cut, and no cut shrinks `Simulation::cut_proof_time_step`. Anchors stay with the
  /// copies that render the anchored node.
  conserving,
  /// Copies are full copies, as in the paper: a cut makes cloth heavier and stiffer, and copies an anchor to
  /// pieces that do not contain it (§6, §7).
  paper
};

/// Mass-spring-damper material of a whole cloth. Any consistent units; SI are given.
struct Material {
  MaterialMode mode = MaterialMode::conserving;
  double density = 0.2;  ///< mass per area [kg/m²], > 0; each node carries a third of the triangles around it
  double stiffness = 100;  ///< k of every uncut spring [N/m], >= 0
  double damping = 0.01;   ///< c of every uncut spring [N·s/m], >= 0
  /// The same for the springs across edges that resist bending (cut/bending.hpp). Zero both: there are none.
  /// By default a twentieth of the stiffness that the edges have when the Material is made
  /// (docs/decisions.md, "Bending"), and damping in the ratio that edges have.
  double bending_stiffness = stiffness / 20;
  double bending_damping = stiffness > 0 ? damping*(bending_stiffness / stiffness) : 0;
  bool operator==(const Material&) const = default;
};

}  // namespace cut

// How large a time step may be (docs/decisions.md, "Stable time step"). In: stiffness, damping and mass of
// every node. Out: the step up to which small motions around rest do not grow.
//
// With R = max over nodes of Σ k / m, no Rayleigh quotient ω² of stiffness exceeds 2 R (Gershgorin), and none
// γ of damping 2 Σ c / m + drag; γ − drag lies between the smallest and the largest c / k times ω². One step
// maps a mode by z² − (2 − γh − ω²h²) z + 1 − γh = 0 (semi-implicit) or by z = 1 + hλ with λ² + γλ + ω² = 0
// (forward), with the mode's own quotients; the bounds below are |z| <= 1.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cut/simulation.hpp"
#include "simulation/rest_area.hpp"

namespace cut {

double Simulation::time_step_limit(Integrator integrator, double stiffness_ratio,
                                   double damping_ratio) const {
  if (integrator == Integrator::implicit_euler) return std::numeric_limits<double>::infinity();
  const double squared = 2 * stiffness_ratio;
  const double drag = (surroundings.air_drag + surroundings.normal_drag) / material_.density;
  const double damping = 2 * damping_ratio + drag;
  if (integrator == Integrator::semi_implicit_euler) {
    const double root = damping + std::sqrt(damping * damping + 4 * squared);
    return root > 0 ? 4 / root : std::numeric_limits<double>::infinity();
  }
  const double infinity = std::numeric_limits<double>::infinity();
  double least = infinity, most = 0;  // c / k
  for (const auto& [c, k] : {std::pair{material_.damping, material_.stiffness},
                             std::pair{material_.bending_damping, material_.bending_stiffness}}) {
    if (k > 0) least = std::min(least, c / k);
    if (c > 0) most = std::max(most, c / k);
  }
  const double rigid = drag > 0 ? 2 / drag : infinity;  // motion without strain, which only drag damps
  const double swinging = squared > 0 ? least + drag / squared : infinity;
  const double discriminant = damping * damping - 4 * (2 * damping_ratio) / most;
  const double creeping = most > 0 && discriminant >= 0 ? 4 / (damping + std::sqrt(discriminant)) : infinity;
  return std::min({rigid, swinging, creeping});
}

double Simulation::stable_time_step(Integrator integrator) const {
  std::vector<double> stiffness(mass_.size()), damping(mass_.size());
  for (const SpringArrays* springs : spring_lists())
    for (std::size_t i = 0; i < springs->nodes.size(); ++i)
      for (const std::uint32_t node : springs->nodes[i]) {
        stiffness[node] += springs->stiffness[i];
        damping[node] += springs->damping[i];
      }
  double stiffness_ratio = 0, damping_ratio = 0;
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    stiffness_ratio = std::max(stiffness_ratio, stiffness[n] * inverse_mass_[n]);
    damping_ratio = std::max(damping_ratio, damping[n] * inverse_mass_[n]);
  }
  return time_step_limit(integrator, stiffness_ratio, damping_ratio);
}

double Simulation::cut_proof_time_step(Integrator integrator, const HybridMesh& mesh) const {
  double stiffness_ratio = 0, damping_ratio = 0;
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const Ancestor& ancestor = mesh.ancestors.triangles[t];
    const double third = material_.density * rest_area(mesh.ancestors, AncestorId{t}) / 3;
    std::array<double, 3> stiffness{}, damping{};  // per corner
    const auto add = [&](std::size_t corner, double part, double k, double c) {
      stiffness[corner] += part * k;
      damping[corner] += part * c;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const bool inner = mesh.ancestors.edges[ancestor.edges[i].index()].triangles[1].valid();
      for (const std::size_t end : {i, next_corner(i)})
        add(end, inner ? 0.5 : 1, material_.stiffness, material_.damping);
      if (inner) add(last_corner(i), 1, material_.bending_stiffness, material_.bending_damping);
    }
    stiffness_ratio =
        std::max(stiffness_ratio, *std::max_element(stiffness.begin(), stiffness.end()) / third);
    damping_ratio = std::max(damping_ratio, *std::max_element(damping.begin(), damping.end()) / third);
  }
  return time_step_limit(integrator, stiffness_ratio, damping_ratio);
}

}  // namespace cut

// How large a time step may be (docs/decisions.md, "Stable time step"). In: stiffness, damping and mass of
// every node. Out: the step up to which small motions around rest do not grow.
//
// With R = max over nodes of Σ k / m, no eigenvalue ω² of the linear system exceeds 2 R (Gershgorin). Damping
// is that of the material: γ = (c / k) ω² + drag. One step maps a mode by z² − (2 − γh − ω²h²) z + 1 − γh = 0
// (semi-implicit) or by z = 1 + hλ with λ² + γλ + ω² = 0 (forward); the bounds below are |z| <= 1.
#include <algorithm>
#include <cmath>
#include <limits>

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
  const double rigid = drag > 0 ? 2 / drag : infinity;  // motion without strain, which only drag damps
  const double discriminant = damping * damping - 4 * squared;
  if (discriminant < 0) return std::min(rigid, damping / squared);
  return std::min(rigid, damping > 0 ? 4 / (damping + std::sqrt(discriminant)) : infinity);
}

double Simulation::stable_time_step(Integrator integrator) const {
  std::vector<double> stiffness(mass_.size()), damping(mass_.size());
  for (std::size_t i = 0; i < springs_.nodes.size(); ++i)
    for (const std::uint32_t node : springs_.nodes[i]) {
      stiffness[node] += springs_.stiffness[i];
      damping[node] += springs_.damping[i];
    }
  double stiffness_ratio = 0, damping_ratio = 0;
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    stiffness_ratio = std::max(stiffness_ratio, stiffness[n] * inverse_mass_[n]);
    damping_ratio = std::max(damping_ratio, damping[n] * inverse_mass_[n]);
  }
  return time_step_limit(integrator, stiffness_ratio, damping_ratio);
}

double Simulation::cut_proof_time_step(Integrator integrator, const HybridMesh& mesh) const {
  double ratio = 0;
  for (std::size_t t = 0; t < mesh.ancestors.triangles.size(); ++t) {
    const Ancestor& ancestor = mesh.ancestors.triangles[t];
    const double third = material_.density * rest_area(mesh.ancestors, AncestorId{t}) / 3;
    std::array<double, 3> shares{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& sides = mesh.ancestors.edges[ancestor.edges[i].index()].triangles;
      const double share = sides[0].valid() && sides[1].valid() ? 0.5 : 1;
      shares[i] += share;
      shares[next_corner(i)] += share;
    }
    ratio = std::max(ratio, *std::max_element(shares.begin(), shares.end()) / third);
  }
  return time_step_limit(integrator, material_.stiffness * ratio, material_.damping * ratio);
}

}  // namespace cut

#include "lattice/flips.hpp"

#include <algorithm>

namespace cut::lattice {
namespace {

constexpr int max_passes = 32;
// A flip has to gain more than rounding can pretend, or two flips could take turns.
constexpr double required_gain = 1 - 1e-9;

std::uint32_t next_half_edge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

/// Cotangent of the smallest angle, up to a factor that depends on the metric alone: small is good. The
/// smallest angle is opposite to the shortest edge c, and cot γ = (a² + b² - c²) / (4 area).
double needle_measure(const Metric& metric, LatticePoint p, LatticePoint q, LatticePoint r) {
  const double a = metric.squared_length(q - p);
  const double b = metric.squared_length(r - q);
  const double c = metric.squared_length(p - r);
  return (a + b + c - 2 * std::min({a, b, c})) / static_cast<double>(orientation(p, q, r));
}

}  // namespace

void flip_edges(std::span<const LatticePoint> points, const Metric& metric,
                std::span<std::array<std::uint32_t, 3>> triangles, std::span<std::uint32_t> twins) {
  const auto start = [&](std::uint32_t h) { return triangles[h / 3][h % 3]; };
  const auto join = [&](std::uint32_t h, std::uint32_t twin) {
    twins[h] = twin;
    if (twin != no_index) twins[twin] = h;
  };
  const auto flip_if_better = [&](std::uint32_t h) {
    const std::uint32_t g = twins[h];
    // The edge runs from u to v; w is opposite in the triangle of h, x in that of g.
    const std::uint32_t vw = next_half_edge(h), wu = next_half_edge(vw);
    const std::uint32_t ux = next_half_edge(g), xv = next_half_edge(ux);
    const std::uint32_t u = start(h), v = start(vw), w = start(wu), x = start(xv);
    const LatticePoint pu = points[u], pv = points[v], pw = points[w], px = points[x];
    if (orientation(pw, pu, px) <= 0 || orientation(px, pv, pw) <= 0) return false;
    const double now = std::max(needle_measure(metric, pu, pv, pw), needle_measure(metric, pv, pu, px));
    const double then = std::max(needle_measure(metric, pw, pu, px), needle_measure(metric, px, pv, pw));
    if (!(then < now * required_gain)) return false;
    const std::uint32_t beyond_wu = twins[wu], beyond_ux = twins[ux];
    const std::uint32_t beyond_xv = twins[xv], beyond_vw = twins[vw];
    const std::uint32_t t = h / 3, s = g / 3;
    triangles[t] = {w, u, x};
    triangles[s] = {x, v, w};
    join(3 * t, beyond_wu);
    join(3 * t + 1, beyond_ux);
    join(3 * s, beyond_xv);
    join(3 * s + 1, beyond_vw);
    join(3 * t + 2, 3 * s + 2);
    return true;
  };
  for (int pass = 0; pass < max_passes; ++pass) {
    bool changed = false;
    for (std::uint32_t h = 0; h < twins.size(); ++h)
      if (twins[h] != no_index && h < twins[h]) changed |= flip_if_better(h);
    if (!changed) return;
  }
}

}  // namespace cut::lattice

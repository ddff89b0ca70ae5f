#include "simulation/cut_lines.hpp"

#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace testing {
namespace {

/// Names a place of the uncut cloth: 0 node, 1 point of an edge, 2 point of a triangle; its element; where.
using Place = std::tuple<int, std::uint32_t, std::int32_t, std::int32_t>;

Place place_of(const cut::HybridMesh& mesh, cut::AncestorId t, cut::LatticePoint p) {
  const cut::Ancestor& ancestor = mesh.ancestors.triangles[t.index()];
  if (const std::size_t corner = corner_of(p); corner < 3) return {0, ancestor.nodes[corner].value, 0, 0};
  const std::size_t i = edge_of(p);
  if (i == 3) return {2, t.value, p.x, p.y};
  const std::int32_t along = p[cut::next_corner(i)];
  return {1, ancestor.edges[i].value, mesh.ancestors.reversed(t, i) ? cut::lattice_size - along : along, 0};
}

}  // namespace

std::size_t count_cut_lines(const cut::HybridMesh& mesh) {
  std::map<Place, std::vector<Place>> beside;
  for (std::size_t i = 0; i < mesh.ancestors.triangles.size(); ++i) {
    const cut::AncestorId t{i};
    const cut::Arrangement* arrangement = mesh.arrangement(t);
    if (arrangement == nullptr) continue;
    const auto join = [&](cut::LatticePoint p, cut::LatticePoint q) {
      const Place a = place_of(mesh, t, p), b = place_of(mesh, t, q);
      beside[a].push_back(b);
      beside[b].push_back(a);
    };
    for (const cut::CutEdge& e : arrangement->edges)
      join(arrangement->nodes[e.from].point, arrangement->nodes[e.to].point);
    for (std::size_t k = 0; k < 3; ++k) {
      const cut::EdgeState* state = mesh.edge_state(mesh.ancestors.triangles[i].edges[k]);
      if (state == nullptr || !mesh.ancestors.neighbour(t, k).valid()) continue;
      const auto count = static_cast<std::uint32_t>(state->nodes.size());
      for (std::uint32_t section = 0; section <= count; ++section) {
        const std::uint32_t here = mesh.ancestors.reversed(t, k) ? count - section : section;
        if (state->cut[section] != 0)
          join(arrangement->nodes[arrangement->edge_node(k, here)].point,
               arrangement->nodes[arrangement->edge_node(k, here + 1)].point);
      }
    }
  }
  std::size_t lines = 0;
  std::set<Place> seen;
  for (const auto& entry : beside) {
    if (!seen.insert(entry.first).second) continue;
    ++lines;
    for (std::vector<Place> open{entry.first}; !open.empty();) {
      const Place place = open.back();
      open.pop_back();
      for (const Place& next : beside[place])
        if (seen.insert(next).second) open.push_back(next);
    }
  }
  return lines;
}

}  // namespace testing

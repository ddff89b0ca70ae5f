/// @file
/// Whether a change set tells where everything comes from: each new node, triangle and spring is named once
/// with what it is a copy of, copies are in place of their sources, and bending pairs are as before at every
/// edge that is not named.
#pragma once
#include <string>
#include <type_traits>
#include <vector>

#include "cut/bending.hpp"
#include "cut/changes.hpp"
#include "cut/hybrid_mesh.hpp"

namespace provenance {

/// Entries of the flat arrays have no gaps, so that those that are equal are the same bytes.
template <class T>
constexpr bool is_bytes = std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>;
static_assert(is_bytes<cut::AncestorNodeId> && is_bytes<cut::PhysicsTriangle> && is_bytes<cut::Spring> &&
              is_bytes<cut::RenderVertex> && is_bytes<cut::RenderTriangle>);

using BendingPairs = std::vector<std::vector<cut::BendingPair>>;

inline BendingPairs all_bending_pairs(const cut::HybridMesh& mesh) {
  BendingPairs pairs;
  for (std::size_t e = 0; e < mesh.ancestors.edges.size(); ++e)
    pairs.push_back(bending_pairs(mesh, cut::AncestorEdgeId{e}));
  return pairs;
}

/// What each entry comes from, by its number after the cut; itself when it was there before. Empty when the
/// new entries are not named one after the other.
template <class Id, class Copies>
std::vector<std::size_t> sources(const Copies& copies, std::size_t before, std::size_t after, Id id) {
  std::vector<std::size_t> result(before);
  for (std::size_t i = 0; i < before; ++i) result[i] = i;
  for (const auto& copy : copies) {
    if ((copy.*id).index() != result.size() || copy.source.index() >= result.size()) return {};
    result.push_back(result[copy.source.index()]);
  }
  return result.size() == after ? result : std::vector<std::size_t>{};
}

/// What does not hold, in words; empty when all is well.
inline std::string fault(const cut::Changes& changes, const cut::Buffers& before, const BendingPairs& bending,
                         const cut::HybridMesh& mesh) {
  const cut::Buffers& after = mesh.buffers;
  const auto nodes =
      sources(changes.node_copies, before.nodes.size(), after.nodes.size(), &cut::NodeCopy::node);
  const auto triangles = sources(changes.triangle_copies, before.triangles.size(), after.triangles.size(),
                                 &cut::TriangleCopy::triangle);
  const auto springs =
      sources(changes.spring_copies, before.springs.size(), after.springs.size(), &cut::SpringCopy::spring);
  if (nodes.empty() || triangles.empty() || springs.empty())
    return "copies do not name all new entries in turn";
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (after.nodes[n] != before.nodes[nodes[n]]) return "a node copies another ancestor node";
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!after.triangles[t].ancestor.valid()) continue;
    const cut::PhysicsTriangle& source = before.triangles[triangles[t]];
    for (std::size_t k = 0; k < 3; ++k)
      if (nodes[after.triangles[t].nodes[k].index()] != source.nodes[k].index())
        return "a triangle's node does not come from that of its source";
    if (after.triangles[t].ancestor != source.ancestor) return "a triangle copies another ancestor";
  }
  for (std::size_t s = 0; s < springs.size(); ++s) {
    if (!after.springs[s].nodes[0].valid()) continue;
    const cut::Spring& source = before.springs[springs[s]];
    if (after.springs[s].edge != source.edge) return "a spring copies one of another edge";
    for (std::size_t k = 0; k < 2; ++k)
      if (nodes[after.springs[s].nodes[k].index()] != source.nodes[k].index())
        return "a spring's node does not come from that of its source";
  }
  auto named = changes.edges.begin();
  for (std::size_t e = 0; e < bending.size(); ++e) {
    if (named != changes.edges.end() && named->index() == e)
      ++named;
    else if (bending_pairs(mesh, cut::AncestorEdgeId{e}) != bending[e])
      return "bending pairs change at an edge that is not named";
  }
  return named == changes.edges.end() ? "" : "changed edges are not sorted";
}

}  // namespace provenance

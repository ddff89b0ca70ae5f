/// @file
/// The connectivity of the whole cloth, computed anew from arrangements and edge states: fragments, the
/// angles (wedges) that their polygons have at nodes, and the uncut sections that join them. In: the mesh.
/// Out: dense numbers for fragments and wedges, and what lies at both sides of each uncut section.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "cut/hybrid_mesh.hpp"

namespace cut::validation {

inline constexpr std::uint32_t nothing = 0xffffffffu;

/// A fragment's side of a section, seen in the direction of the ancestor edge.
struct SectionSide {
  std::uint32_t fragment = nothing;
  std::array<std::size_t, 2> corner{};  ///< of the triangle, at the start and end of its edge
  std::array<std::uint32_t, 2> wedge{nothing, nothing};  ///< at the start and end of the section
};

struct Section {
  AncestorEdgeId edge;
  std::array<SectionSide, 2> sides;
};

class Flood {
 public:
  explicit Flood(const HybridMesh& mesh);

  /// Fragment p of ancestor t is number first_fragment[t] + p. One entry more than ancestors.
  std::vector<std::uint32_t> first_fragment;
  /// The wedges of ancestor t: corners 0, 1, 2 of an uncut one, else all corners of all polygons in order.
  std::vector<std::uint32_t> first_wedge;
  std::vector<Section> joined;  ///< the uncut sections with a fragment on both sides
};

}  // namespace cut::validation

/// @file
/// Whether a fragment shows a corner of its physics triangle: only then does the copy of the node there hold
/// what hung on it (§7, anchors), and only then can a spring between two corners tear.
#pragma once
#include <algorithm>
#include <cstddef>

#include "cut/arrangement.hpp"

namespace cut {

/// @param arrangement of the fragment's ancestor, null while it is uncut
[[nodiscard]] inline bool renders_corner(const Arrangement* arrangement, std::size_t polygon, std::size_t i) {
  if (arrangement == nullptr) return true;
  const auto& corners = arrangement->polygons[polygon].corners;
  return std::any_of(corners.begin(), corners.end(), [&](const PolygonCorner& c) { return c.node == i; });
}

}  // namespace cut

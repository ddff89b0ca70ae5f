/// @file
/// A vector as the simulation keeps it for each node.
#pragma once

namespace cut {

/// A vector in space, padded so that a processor loads it whole. w stays zero.
struct alignas(32) PaddedVector {
  double x = 0, y = 0, z = 0, w = 0;
};

}  // namespace cut

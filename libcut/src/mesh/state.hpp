/// @file
/// Names for states of meshes: what was computed from a mesh in one state holds as long as the state has the
/// same name, whichever mesh was copied over it in between.
#pragma once
#include <cstdint>

namespace cut {

/// A number that this process has not had yet. Safe to call from several threads.
std::uint64_t new_state();

}  // namespace cut

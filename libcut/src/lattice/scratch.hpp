/// @file
/// Memory for the many short lists that a step needs on one triangle: taken from the stack, and from the heap
/// only when that is not enough. Asking the heap for each list took a good part of the time of a cut.
#pragma once
#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace cut::lattice {

struct ScratchSpace {
  alignas(std::max_align_t) std::array<std::byte, 8192> space;
};

/// Lives as long as the function that has it; so must the lists.
class Scratch : ScratchSpace, public std::pmr::monotonic_buffer_resource {
 public:
  Scratch() : std::pmr::monotonic_buffer_resource(space.data(), space.size()) {}
};

/// A list in such memory.
template <class T>
using ScratchList = std::pmr::vector<T>;

}  // namespace cut::lattice

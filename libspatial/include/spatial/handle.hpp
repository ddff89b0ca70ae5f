/// @file
/// The name of an element of a container. It stays valid until that element is erased, wherever the element
/// moves in memory; a handle whose element is gone is recognised as stale by its generation.
#pragma once
#include <cstdint>

namespace spatial {

/// A default constructed handle is invalid. It is also what an operation returns that refused its argument.
struct Handle {
  static constexpr std::uint32_t invalid_index = 0xffffffffu;
  std::uint32_t index = invalid_index;
  std::uint32_t generation = 0;
  [[nodiscard]] constexpr bool valid() const { return index != invalid_index; }
  friend constexpr bool operator==(Handle, Handle) = default;
};

}  // namespace spatial

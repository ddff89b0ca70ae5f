/// @file
/// A set of 32-bit numbers by open addressing, which asks for memory once in a while only: which render
/// vertices have found their node (copy_boundary_nodes.hpp).
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cut {

/// @pre no number is 2³² − 1
class NumberSet {
 public:
  void reserve(std::size_t numbers) {
    std::size_t size = 64;
    while (size < 2 * numbers) size *= 2;
    if (size > slots_.size()) grow(size);
  }
  [[nodiscard]] bool contains(std::uint32_t number) const {
    return !slots_.empty() && slots_[slot(number)] == number;
  }
  void insert(std::uint32_t number) {
    if (2 * (count_ + 1) > slots_.size()) grow(std::max<std::size_t>(64, 2 * slots_.size()));
    std::uint32_t& place = slots_[slot(number)];
    if (place != number) ++count_;
    place = number;
  }

 private:
  static constexpr std::uint32_t free = 0xffffffffu;
  /// Where it is, or would be.
  [[nodiscard]] std::size_t slot(std::uint32_t number) const {
    std::size_t i = (number * std::size_t{0x9e3779b1}) & (slots_.size() - 1);
    while (slots_[i] != number && slots_[i] != free) i = (i + 1) & (slots_.size() - 1);
    return i;
  }
  void grow(std::size_t size) {
    std::vector<std::uint32_t> old(size, free);
    old.swap(slots_);
    for (const std::uint32_t number : old)
      if (number != free) slots_[slot(number)] = number;
  }
  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
};

}  // namespace cut

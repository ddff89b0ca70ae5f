/// @file
/// Lists as sets. In: a list in any order. Out: the same entries in order, each once.
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cut/ids.hpp"

namespace cut::lattice {

inline std::uint32_t number_of(std::uint32_t number) { return number; }
template <class Tag>
std::uint32_t number_of(Id<Tag> id) {
  return id.value;
}

template <class T>
inline constexpr bool is_id = false;
template <class Tag>
inline constexpr bool is_id<Id<Tag>> = true;
template <class T>
concept Number = std::same_as<T, std::uint32_t> || is_id<T>;

/// Numbers, when they lie so close together that to set a bit for each takes less time than sorting.
/// @return false when they do not: then nothing was done. O(n)
template <Number T, class Allocator>
bool sort_unique_by_bits(std::vector<T, Allocator>& list) {
  if (list.size() < 64) return false;
  std::uint32_t least = number_of(list[0]), most = least;
  for (const T& entry : list) {
    least = std::min(least, number_of(entry));
    most = std::max(most, number_of(entry));
  }
  const std::size_t words = (most - least) / std::size_t{64} + 1;
  if (words > list.size()) return false;
  std::vector<std::uint64_t> present(words);
  for (const T& entry : list) {
    const std::uint32_t bit = number_of(entry) - least;
    present[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  auto to = list.begin();
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t left = present[w]; left != 0; left &= left - 1)
      *to++ =
          T{static_cast<std::uint32_t>(least + 64 * w + static_cast<std::size_t>(std::countr_zero(left)))};
  list.erase(to, list.end());
  return true;
}

/// O(n log n).
template <class T, class Allocator>
void sort_unique(std::vector<T, Allocator>& list) {
  if constexpr (Number<T>)
    if (sort_unique_by_bits(list)) return;
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace cut::lattice

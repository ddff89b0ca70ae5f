/// @file
/// Lists as sets. In: a list in any order. Out: the same entries in order, each once.
#pragma once
#include <algorithm>
#include <vector>

namespace cut::lattice {

/// O(n log n).
template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace cut::lattice

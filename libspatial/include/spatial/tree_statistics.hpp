/// @file
/// What can be measured of a tree and of a query. In: nothing. Out: numbers.
#pragma once
#include <cstddef>

#include "box.hpp"

namespace spatial {

struct TreeStatistics {
  std::size_t elements = 0;
  std::size_t nodes = 0;  ///< that have children
  std::size_t leaves = 0;
  std::size_t depth = 0;         ///< nodes on the longest way from the root to a leaf
  std::size_t largest_leaf = 0;  ///< elements in it
  std::size_t bytes = 0;         ///< allocated, without what the values themselves own
};

struct QueryStatistics {
  std::size_t hits = 0;
  std::size_t nodes = 0;     ///< visited
  std::size_t leaves = 0;    ///< visited
  std::size_t elements = 0;  ///< tested, in those leaves
};

/// One node or leaf, for drawing.
template <class T, std::size_t D>
struct NodeView {
  Box<T, D> volume;  ///< the node's volume (§5.1); where an axis is not divisible any more, min == max there
  Box<T, D> tight;   ///< what it holds
  std::size_t depth = 0;  ///< 0 for the root
  int side = -1;          ///< 0, 1, 2: lower, higher, centric child of its parent; -1 for the root
  bool is_leaf = false;
  std::size_t elements = 0;  ///< in a leaf
  std::size_t axis = D;      ///< of the split plane; D for a leaf
  T plane{};
};

}  // namespace spatial

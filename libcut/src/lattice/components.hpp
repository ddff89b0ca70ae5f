/// @file
/// Connected components (union-find). In: pairs of items that belong together. Out: a root for each item.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace cut::lattice {

class Components {
 public:
  /// Items 0 to items - 1, each by itself.
  explicit Components(std::size_t items, std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : parent_(memory) {
    reset(items);
  }
  void reset(std::size_t items) {
    parent_.resize(items);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t root(std::uint32_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  [[nodiscard]] std::size_t size() const { return parent_.size(); }
  /// The smallest item of a component is its root.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a < b)
      parent_[b] = a;
    else
      parent_[a] = b;
  }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

}  // namespace cut::lattice

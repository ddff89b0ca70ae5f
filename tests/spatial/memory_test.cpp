// The dictionary when memory runs out: what was called has no effect. The tree is tested through its
// allocator (values_test.cpp); the dictionary has none, so that here the operator new of this program fails.
#include <doctest/doctest.h>

#include <cstdlib>
#include <new>

#include "cluster_list.hpp"

namespace {
thread_local long allocations_left = -1;  // no limit
}

void* operator new(std::size_t size) {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left > 0) --allocations_left;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

TEST_CASE("a dictionary that finds no memory is as it was") {
  spatial::PointClusterDictionary<double, 2, int> dictionary(1);
  operations::ClusterList<double, 2> list(1);
  int failures = 0;
  for (int i = 0; i < 300; ++i) {
    const spatial::Point<double, 2> point{static_cast<double>(i * 37 % 100), static_cast<double>(i * 17 % 7)};
    const std::uint32_t owner = static_cast<std::uint32_t>(i / 2);
    for (long allowed = 0;; ++allowed) {
      bool failed = false;
      spatial::MergeResult result;
      allocations_left = allowed;
      try {
        if (i % 3 == 2) {
          result.inserted = dictionary.add_center(spatial::ClusterId{owner}, point);
        } else {
          result = dictionary.insert_or_merge(point, i);
        }
      } catch (const std::bad_alloc&) {
        failed = true;
        ++failures;
      }
      allocations_left = -1;
      if (!failed) {
        if (i % 3 == 2) {
          REQUIRE(result.inserted == list.add_center(owner, point));
        } else {
          REQUIRE(result.cluster == list.insert_or_merge(point, i).cluster);
        }
      }
      REQUIRE(dictionary.size() == list.clusters.size());
      REQUIRE(dictionary.find_nearest(point).index == list.nearest(point));
      if (!failed) break;
    }
  }
  for (const auto& centre : list.centres)
    REQUIRE(dictionary.find_nearest(centre.point).index == centre.cluster);
  CHECK(failures > 20);
}

// A tree that was loaded at once, and whose handles nobody asked for, has neither ids nor slots. What holds
// of other trees holds of it.
#include <doctest/doctest.h>

#include <cstddef>
#include <iterator>
#include <memory_resource>
#include <new>
#include <spatial/bounding_box_ternary_tree.hpp>
#include <spatial/pmr.hpp>
#include <utility>
#include <vector>

namespace {

using Box = spatial::Box<double, 2>;
using Tree = spatial::BoundingBoxTernaryTree<int, double, 2>;

// A lattice; every 50th box is one of many that cross all planes in one place, which share a big leaf.
std::vector<std::pair<Box, int>> scene(int count) {
  std::vector<std::pair<Box, int>> result;
  for (int i = 0; i < count; ++i) {
    const double x = i % 100;
    const double y = i / 100;
    result.push_back({Box{{x, y}, {x + 0.5, y + 0.5}}, i});
    if (i % 5 == 0) result.back().first = Box{{0, 0}, {99.5, count / 100 - 0.5}};
  }
  return result;
}

struct Limited : std::pmr::memory_resource {
  bool refuses = false;
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (refuses) throw std::bad_alloc();
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* p, std::size_t bytes, std::size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(p, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

std::vector<spatial::Handle> handles_of(const auto& tree, int count) {
  std::vector<spatial::Handle> result(static_cast<std::size_t>(count));
  for (auto i = tree.begin(); i != tree.end(); ++i) result[static_cast<std::size_t>(*i)] = i.handle();
  return result;
}

}  // namespace

TEST_CASE("a loaded tree whose handles nobody asked for takes less memory") {
  auto all = scene(10000);
  std::erase_if(all, [](const auto& e) { return e.second % 5 == 0; });
  std::vector<spatial::Handle> handles;
  Tree with, without;
  with.insert(all.begin(), all.end(), std::back_inserter(handles));
  without.insert(all.begin(), all.end());
  CHECK(without.statistics().bytes + 15 * all.size() < with.statistics().bytes);
  // A cleared tree is as good as a new one.
  with.clear();
  with.insert(all.begin(), all.end());
  CHECK(with.statistics().bytes == without.statistics().bytes);
  CHECK_FALSE(with.contains(handles[0]));
  CHECK_FALSE(with.contains(handles.back()));
}

TEST_CASE("a loaded tree can be emptied without any memory") {
  Limited memory;
  const auto all = scene(5000);
  spatial::pmr::BoundingBoxTernaryTree<int, double, 2> tree(&memory);
  tree.insert(all.begin(), all.end());
  auto handles = handles_of(tree, 5000);
  memory.refuses = true;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const std::size_t at = i * 1777 % handles.size();  // in some order
    REQUIRE(tree.value(handles[at]) == static_cast<int>(at));
    REQUIRE(tree.erase(handles[at]));
    REQUIRE_FALSE(tree.contains(handles[at]));
    REQUIRE_FALSE(tree.erase(handles[at]));
    if (i % 100 != 0) continue;
    REQUIRE(tree.validate().empty());
    for (std::size_t j = i + 1; j < handles.size(); j += 97) {
      REQUIRE(tree.box(handles[j * 1777 % handles.size()]) == all[j * 1777 % handles.size()].first);
    }
  }
  CHECK(tree.empty());
}

TEST_CASE("the first change of a loaded tree fails as a whole, or leaves all handles as they were") {
  Limited memory;
  const auto all = scene(2000);
  spatial::pmr::BoundingBoxTernaryTree<int, double, 2> tree(&memory);
  tree.insert(all.begin(), all.end());
  const auto handles = handles_of(tree, 2000);
  for (std::size_t i = 0; i < 2000; i += 3) tree.erase(handles[i]);
  memory.refuses = true;
  CHECK_THROWS(tree.insert(Box{{1, 1}, {2, 2}}, 9999));
  CHECK_THROWS(tree.move(handles[1], Box{{1, 1}, {2, 2}}));
  CHECK(tree.validate().empty());
  CHECK(tree.box(handles[1]) == all[1].first);
  memory.refuses = false;
  const auto fresh = tree.insert(Box{{1, 1}, {2, 2}}, 9999);
  REQUIRE(tree.move(handles[1], Box{{1, 1}, {2, 2}}));
  CHECK(tree.validate().empty());
  CHECK(tree.value(fresh) == 9999);
  for (std::size_t i = 2; i < 2000; ++i) {
    REQUIRE(tree.contains(handles[i]) == (i % 3 != 0));
    if (i % 3 != 0) REQUIRE(tree.value(handles[i]) == static_cast<int>(i));
  }
  // Leaves without ids lose elements, get some, and are split.
  for (std::size_t i = 4; i < 2000; i += 3) REQUIRE(tree.erase(handles[i]));
  for (int i = 0; i < 4000; ++i) tree.insert(all[static_cast<std::size_t>(i % 2000)].first, i);
  CHECK(tree.validate().empty());
  for (std::size_t i = 2; i < 2000; i += 3) REQUIRE(tree.value(handles[i]) == static_cast<int>(i));
}

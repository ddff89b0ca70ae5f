// A cut changes single entries of the simulation's arrays and adds some: what it allocates depends on the
// cut, not on the size of the cloth. The operator new of this program counts; but the thread sanitizer's own
// cannot be replaced by it, so that there this is left out.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SNIP_THREAD_SANITIZER
#endif
#endif
#ifndef SNIP_THREAD_SANITIZER
#include <doctest/doctest.h>

#include <cstdlib>
#include <cut/cutter.hpp>
#include <cut/validate.hpp>
#include <new>
#include <scenes/cutters.hpp>

#include "simulation/meshes.hpp"

namespace {
thread_local std::size_t allocated = 0;  // bytes

void* counted(void* memory, std::size_t size) {
  if (memory == nullptr) throw std::bad_alloc();
  allocated += size;
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size > 0 ? size : 1), size); }
// What returns null is asked by std::stable_sort; left alone it would allocate what the functions below do
// not free.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  allocated += size;
  return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size / unit + 1) * unit), size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

TEST_CASE("To take over a cut allocates as much for a large cloth as for a small one") {
  // Bytes for each of some cuts of the same places.
  const auto allocations = [](std::size_t cells, cut::MaterialMode mode) {
    cut::HybridMesh mesh = testing::built(scenes::grid(cells, cells));
    cut::Simulation simulation = testing::simulated(mesh, {mode});
    simulation.set_force(cut::NodeId{0u}, {1, 0, 0});
    cut::Cutter cutter(cut::default_merge_distances(mesh));
    std::vector<std::size_t> bytes;
    for (int i = 0; i < 5; ++i) {
      const double x = 3.3 + 2 * i;
      const auto changes = cutter.cut(mesh, scenes::ribbon({{x, 3.2, 0}, {x + 0.1, 7.4, 0}}, {0, 0, 2}));
      REQUIRE(changes);
      REQUIRE(cut::validate(mesh, 1).empty());
      REQUIRE_FALSE(changes->node_copies.empty());
      const std::size_t before = allocated;
      REQUIRE_FALSE(simulation.apply(*changes, mesh));
      bytes.push_back(allocated - before);
    }
    return bytes;
  };
  for (const auto mode : {cut::MaterialMode::conserving, cut::MaterialMode::paper}) {
    const auto small = allocations(20, mode), large = allocations(250, mode);
    for (std::size_t i = 0; i < small.size(); ++i) {
      CAPTURE(small[i]);
      CAPTURE(large[i]);
      CHECK(large[i] < 2 * small[i] + 10'000);
    }
  }
}
#endif

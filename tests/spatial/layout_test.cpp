// The parts of a leaf's block are aligned for what they hold, whatever the sizes of coordinates and values.
#include <doctest/doctest.h>

#include <cstdint>
#include <spatial/detail/leaf.hpp>

namespace {

template <class Value, class T, std::size_t D>
void check() {
  using Leaf = spatial::detail::Leaf<Value, T, D>;
  for (std::size_t capacity = 1; capacity < 100; ++capacity) {
    CHECK(Leaf::ids_offset(capacity) % alignof(std::uint32_t) == 0);
    CHECK(Leaf::values_offset(capacity) % alignof(Value) == 0);
    CHECK(Leaf::ids_offset(capacity) >= 2 * D * capacity * sizeof(T));
    CHECK(Leaf::values_offset(capacity) >= Leaf::ids_offset(capacity) + capacity * sizeof(std::uint32_t));
    CHECK(Leaf::bytes(capacity) >= Leaf::values_offset(capacity) + capacity * sizeof(Value));
  }
}

}  // namespace

TEST_CASE("slot indices and values are aligned") {
  check<int, std::uint8_t, 3>();
  check<char, std::int8_t, 1>();
  check<double, std::int16_t, 3>();
  check<std::uint32_t, float, 2>();
  check<long double, double, 3>();
}

// Lists as sets: the same whether bits or sorting finds it, for numbers and ids close together and far apart.
#include "lattice/sort_unique.hpp"

#include <doctest/doctest.h>

#include <random>
#include <set>

namespace {

using Node = cut::NodeId;

template <class T>
void check_against_set(std::vector<T> list) {
  const std::set<T> wanted(list.begin(), list.end());
  cut::lattice::sort_unique(list);
  CHECK(list == std::vector<T>(wanted.begin(), wanted.end()));
}

}  // namespace

TEST_CASE("numbers are sorted, each once, however far apart they are") {
  std::mt19937 random(7);
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 1000u}) {
    for (const std::uint32_t range : {1u, 63u, 64u, 65u, 5000u, 64000u, 64064u, 1000000u, 0xffffffffu}) {
      for (const std::uint32_t least : {0u, 77u, 0xffffffffu - range}) {
        std::vector<std::uint32_t> numbers;
        std::vector<Node> ids;
        for (std::size_t i = 0; i < count; ++i) {
          numbers.push_back(least + static_cast<std::uint32_t>(random() % (std::uint64_t{range} + 1)));
          ids.push_back(Node{numbers.back()});
        }
        if (count > 1) numbers[count - 1] = least + range;
        check_against_set(numbers);
        check_against_set(ids);
      }
    }
  }
}

TEST_CASE("bits are taken for numbers close together only, so that memory goes with the list") {
  std::vector<std::uint32_t> close(1000), apart(1000);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    close[i] = 5000 - 5 * i;
    apart[i] = 4000000 - 4000 * i;
  }
  const auto before = apart;
  CHECK(cut::lattice::sort_unique_by_bits(close));
  CHECK_FALSE(cut::lattice::sort_unique_by_bits(apart));
  CHECK(apart == before);
}

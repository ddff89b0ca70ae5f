// Executors take every turn once, and wait for all of them.
#include <doctest/doctest.h>

#include <algorithm>
#ifdef SNIP_TBB
#include <cut/adapt/tbb.hpp>
#endif
#include <cut/adapt/threads.hpp>
#include <numeric>
#include <vector>

TEST_CASE("an executor takes each turn once, and writes are seen after the loop") {
  std::vector<cut::Executor> executors{cut::Executor()};
  for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
    executors.push_back(cut::thread_executor(threads));
#ifdef SNIP_TBB
  executors.push_back(cut::tbb_executor());
#endif
  for (const cut::Executor& executor : executors)
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}})
      for (int again = 0; again < 20; ++again) {
        std::vector<int> turns(count, 0);
        executor.for_each(count, [&](std::size_t i) { ++turns[i]; });
        CHECK(std::accumulate(turns.begin(), turns.end(), std::size_t{0}) == count);
        CHECK(std::count(turns.begin(), turns.end(), 1) == static_cast<std::ptrdiff_t>(count));
      }
}

TEST_CASE("without threads turns are taken in order, by the caller") {
  std::vector<std::size_t> order;
  cut::Executor().for_each(5, [&](std::size_t i) { order.push_back(i); });
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
}

/// @file
/// An Executor over oneTBB, for programs that use it. Nothing else includes this.
#pragma once
#include <oneapi/tbb/parallel_for.h>

#include "../executor.hpp"

namespace cut {

/// Runs loops on the task arena of the calling thread: `oneapi::tbb::task_arena` and `global_control` say how
/// many threads that has.
[[nodiscard]] inline Executor tbb_executor() {
  return Executor([](std::size_t count, const Executor::Turn& turn) {
    oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { turn(i); });
  });
}

}  // namespace cut

/// @file
/// Runs a function in a process of its own: a peer that crashes does not end the benchmark, and none starts
/// with memory that another has warmed up. In: a function that fills a result. Out: the result as far as it
/// got.
#pragma once
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <type_traits>

namespace cutting {

/// @tparam Result has a flag `finished`, false in the result when the function crashed
template <class Result, class Function>
Result run_isolated(Function&& function) {
  static_assert(std::is_trivially_copyable_v<Result>);
  std::fflush(stdout);
  void* memory = mmap(nullptr, sizeof(Result), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return {};
  auto* shared = new (memory) Result;
  const pid_t child = fork();
  if (child == 0) {
    function(*shared);
    shared->finished = true;
    _exit(0);
  }
  if (child > 0) waitpid(child, nullptr, 0);
  const Result result = *shared;
  munmap(memory, sizeof(Result));
  return result;
}

}  // namespace cutting

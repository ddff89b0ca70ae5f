/// @file
/// An Executor over threads of its own, for programs that have no scheduler. Nothing else includes this.
#pragma once
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "../executor.hpp"

namespace cut {

/// Threads that take turns of one loop after the other. The thread that calls takes turns as well, so a pool
/// of n has n − 1 threads. One loop at a time: to be used from one thread, and not from within a turn.
class ThreadPool {
 public:
  explicit ThreadPool(std::size_t threads) : parts_(std::max<std::size_t>(1, threads)) {
    for (std::size_t i = 1; i < threads; ++i) helpers_.emplace_back([this, i] { help(i); });
  }
  ~ThreadPool() {
    {
      const std::scoped_lock lock(mutex_);
      ends_ = true;
      ++loops_;
    }
    begin_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  void run(std::size_t count, const Executor::Turn& turn) {
    {
      const std::scoped_lock lock(mutex_);
      turn_ = &turn;
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        parts_[p].next = p * count / parts_.size();
        parts_[p].end = (p + 1) * count / parts_.size();
      }
      ++loops_;
    }
    begin_.notify_all();
    take_turns(0, turn);
    {
      const std::scoped_lock lock(mutex_);
      turn_ = nullptr;  // who wakes up only now has nothing to do
    }
    for (int i = 0; at_work_ != 0; ++i)
      if (i < patience)
        rest();
      else
        std::this_thread::yield();
  }

 private:
  /// Turns that are next to each other, of which each thread has the same in every loop: what they work on is
  /// then in its cache.
  struct alignas(64) Part {
    std::atomic<std::size_t> next = 0;
    std::size_t end = 0;
  };

  /// Those of the own part, then what others have left of theirs.
  void take_turns(std::size_t thread, const Executor::Turn& turn) {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      Part& part = parts_[(thread + k) % parts_.size()];
      for (std::size_t i = part.next++; i < part.end; i = part.next++) turn(i);
    }
  }

  void help(std::size_t thread) {
    for (std::size_t done = 0;;) {
      // Loops often follow each other closely, and waking up takes longer than many a loop.
      for (int i = 0; i < patience_between_loops && loops_ == done; ++i) rest();
      std::unique_lock lock(mutex_);
      begin_.wait(lock, [&] { return loops_ != done; });
      if (ends_) return;
      done = loops_;
      if (turn_ == nullptr) continue;
      ++at_work_;
      const Executor::Turn& turn = *turn_;
      lock.unlock();
      take_turns(thread, turn);
      --at_work_;
    }
  }

  /// Waits for a moment without giving the processor to another program, which would keep it for much longer
  /// than a loop takes.
  static void rest() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
  }

  static constexpr int patience = 2000;
  /// Between the loops of a cut one thread works for up to some tenths of a millisecond.
  static constexpr int patience_between_loops = 20'000;
  std::mutex mutex_;
  std::condition_variable begin_;
  std::atomic<std::size_t> loops_ = 0;    ///< number of the loop, so that a helper takes part in it once
  std::vector<Part> parts_;               ///< one for each thread
  std::atomic<std::size_t> at_work_ = 0;  ///< helpers that take part in the loop
  const Executor::Turn* turn_ = nullptr;  ///< of the loop that runs
  bool ends_ = false;
  std::vector<std::thread> helpers_;
};

/// `threads` threads, the calling one included; they live as long as the Executor and its copies.
[[nodiscard]] inline Executor thread_executor(std::size_t threads) {
  return Executor([pool = std::make_shared<ThreadPool>(threads)](
                      std::size_t count, const Executor::Turn& turn) { pool->run(count, turn); });
}

}  // namespace cut

/// @file
/// How loops run whose turns do not depend on each other. The libraries start no threads: by default such a
/// loop runs in the calling thread, and a user who has threads hands them over as an Executor. cut/adapt/ has
/// two ready-made ones.
#pragma once
#include <cstddef>
#include <functional>
#include <utility>

namespace cut {

/// Runs loops. Whatever it does, results are the same to the bit: what a turn works on is settled before the
/// loop starts, and no sum depends on who comes first.
class Executor {
 public:
  using Turn = std::function<void(std::size_t)>;
  /// Calls turn(0), …, turn(count − 1), each once, in any order, at the same time or one after the other, and
  /// returns when all of them have returned; what they wrote is then visible to the caller.
  using Loop = std::function<void(std::size_t count, const Turn& turn)>;

  /// One turn after the other, in the calling thread.
  Executor() = default;
  explicit Executor(Loop loop) : loop_(std::move(loop)) {}

  /// @param turn  callable with an index; must be safe to call from several threads with different indices
  template <class Callable>
  void for_each(std::size_t count, const Callable& turn) const {
    if (loop_ && count > 1)
      loop_(count, Turn(std::cref(turn)));
    else
      for (std::size_t i = 0; i < count; ++i) turn(i);
  }

 private:
  Loop loop_;
};

}  // namespace cut

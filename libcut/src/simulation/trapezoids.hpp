/// @file
/// The order in which blocks in a row go through several steps, where a block needs what it and its two
/// neighbours were after the step before. In: how many there are. Out: calls for each block and step.
///
/// One step of all blocks after the other would fetch everything from memory for each step. Instead a part of
/// the row goes through all steps while it is in a cache. Parts can be done at the same time: in a first loop
/// each part leaves out one block more in each step where it meets the next part, and in a second one these
/// are made up for.
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>

#include "cut/executor.hpp"

namespace cut {

/// Calls turn(step, block) for the blocks [first(step), last(step)) of each step [0, steps), blocks in order,
/// when the next block has done the step before. @param widest  the largest of all last(step)
template <class First, class Last, class Turn>
void go_askew(std::size_t steps, std::size_t widest, const First& first, const Last& last, const Turn& turn) {
  for (std::size_t place = first(0); place + 1 < widest + steps; ++place)
    for (std::size_t step = 0; step < steps && step <= place; ++step) {
      const std::size_t block = place - step;
      if (block >= first(step) && block < last(step)) turn(step, block);
    }
}

/// How many of so many steps such blocks can go through at a time.
inline std::size_t most_steps_in_trapezoids(std::size_t blocks, std::size_t steps) {
  return std::min(steps, 1 + blocks / 4);
}

/// Calls turn(step, block) for all. @pre one step, or one block, or most_steps_in_trapezoids
/// @param begin  called before turns that do not follow those before: by the same thread, for the same part
template <class Begin, class Turn>
void go_in_trapezoids(const Executor& executor, std::size_t blocks, std::size_t steps, const Begin& begin,
                      const Turn& turn) {
  if (steps == 1 || blocks == 1) {
    executor.for_each(blocks, [&](std::size_t block) {
      for (std::size_t step = 0; step < steps; ++step) {
        begin();
        turn(step, block);
      }
    });
    return;
  }
  // Parts are so large that those in the second loop do not meet. The first and the last one have half the
  // size and are done in one turn, so that all turns take the same time; two, four or eight of them.
  const std::size_t parts = std::bit_floor(std::min<std::size_t>(8, blocks / (2 * (steps - 1))));
  const auto border = [&](std::size_t i) { return (2 * i + 1) * blocks / (2 * parts); };
  executor.for_each(parts, [&](std::size_t i) {
    const bool at_end = i + 1 == parts;
    begin();
    go_askew(
        steps, at_end ? blocks : border(i + 1), [&](std::size_t step) { return border(i) + step; },
        [&](std::size_t step) { return at_end ? blocks : border(i + 1) - step; }, turn);
    if (!at_end) return;
    begin();
    go_askew(
        steps, border(0), [](std::size_t) { return std::size_t{0}; },
        [&](std::size_t step) { return border(0) - step; }, turn);
  });
  executor.for_each(parts, [&](std::size_t i) {
    begin();
    go_askew(
        steps, border(i) + steps - 1, [&](std::size_t step) { return border(i) - step; },
        [&](std::size_t step) { return border(i) + step; }, turn);
  });
}

}  // namespace cut

/// @file
/// Loops whose turns are short, or find lists: in parts of a few turns, each with lists of its own. Parts are
/// the same for any number of threads, so what they found, one after the other, is in the order of the turns.
/// What gets a number is first counted in each part, then numbered from part to part, then written.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "cut/executor.hpp"

namespace cut {

/// So few turns that their times even out, and so many that handing out a part takes no time beside them.
/// @param least 1 where one turn may take long
inline std::size_t turns_per_part(std::size_t count, std::size_t least = 16) {
  return std::clamp<std::size_t>(count / 64, least, 64);
}

/// Calls visit(i, part) for each i below `count`, with the part that it belongs to. @pre the parts are from
/// `in_parts` with the same `count` and `least`
template <class Part, class Visit>
void for_parts(const Executor& executor, std::size_t count, std::vector<Part>& parts, const Visit& visit,
               std::size_t least = 16) {
  const std::size_t turns = turns_per_part(count, least);
  executor.for_each(parts.size(), [&](std::size_t p) {
    const std::size_t end = std::min(count, (p + 1) * turns);
    for (std::size_t i = p * turns; i < end; ++i) visit(i, parts[p]);
  });
}

/// The same with new parts. @return them
template <class Part, class Visit>
std::vector<Part> in_parts(const Executor& executor, std::size_t count, const Visit& visit,
                           std::size_t least = 16) {
  const std::size_t turns = turns_per_part(count, least);
  std::vector<Part> parts((count + turns - 1) / turns);
  for_parts(executor, count, parts, visit, least);
  return parts;
}

template <class T, class List>
void append(std::vector<T>& list, const List& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace cut

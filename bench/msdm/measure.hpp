/// @file
/// Times of programs that take turns, so that what else runs on the machine disturbs all of them alike. In:
/// what to measure. Out: milliseconds of the wall clock.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace msdm {

struct Contender {
  std::string name;
  std::function<void()> run;
  std::vector<double> times{};  ///< [ms], sorted by `take_turns`

  [[nodiscard]] double least() const { return times.front(); }
  [[nodiscard]] double median() const { return times[times.size() / 2]; }
};

/// Runs each once unmeasured, then all of them in turn, `rounds` times.
inline void take_turns(std::vector<Contender>& contenders, std::size_t rounds) {
  using Clock = std::chrono::steady_clock;
  for (const Contender& c : contenders) c.run();
  for (std::size_t i = 0; i < rounds; ++i)
    for (Contender& c : contenders) {
      const Clock::time_point begin = Clock::now();
      c.run();
      c.times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
  for (Contender& c : contenders) std::sort(c.times.begin(), c.times.end());
}

}  // namespace msdm

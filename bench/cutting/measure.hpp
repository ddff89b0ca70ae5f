/// @file
/// Time, memory and medians for the benchmarks of cutting. In: nothing. Out: milliseconds, mebibytes.
#pragma once
#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace cutting {

/// Processor time of this thread: everything measured here runs on one thread, and other programs on the
/// machine then disturb caches only.
class Stopwatch {
 public:
  /// Milliseconds since construction or the last call.
  double lap() {
    const double now = milliseconds();
    const double passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  static double milliseconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
  }
  double last_ = milliseconds();
};

/// @pre not empty
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The most memory that this process has held so far.
inline double peak_mebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace cutting

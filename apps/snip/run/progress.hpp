/// @file
/// How far a run is, on stderr: a bar that moves on a terminal, a line for each quarter elsewhere.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace snip {

class Progress {
 public:
  explicit Progress(std::size_t total);
  /// Takes the bar away.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Makes room for a line of text; the next update brings the bar back.
  void clear();

  /// @param note shown behind the numbers
  void update(std::size_t done, const std::string& note);

 private:
  std::size_t total_;
  bool terminal_;
  bool bar_shown_ = false;
  std::size_t quarter_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

/// "[#####-----]  50 %", 20 characters of bar.
std::string progress_bar(std::size_t done, std::size_t total);

}  // namespace snip

// Progress on stderr, see progress.hpp.
#include "snip/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "snip/console.hpp"

namespace snip {

std::string progress_bar(std::size_t done, std::size_t total) {
  const std::size_t percent = total > 0 ? std::min(done, total) * 100 / total : 100, filled = percent / 5;
  return fmt::format("[{}{}] {:3} %", std::string(filled, '#'), std::string(20 - filled, '-'), percent);
}

Progress::Progress(std::size_t total) : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (bar_shown_) print_err("\r\x1b[K");
  bar_shown_ = false;
}

void Progress::update(std::size_t done, const std::string& note) {
  if (!terminal_) {
    const std::size_t quarter = total_ > 0 ? done * 4 / total_ : 4;
    if (quarter > quarter_) print_err(fmt::format("frame {} of {}, {}\n", done, total_, note));
    quarter_ = std::max(quarter, quarter_);
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (done < total_ && bar_shown_ && now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  bar_shown_ = true;
  print_err(fmt::format("\r{} frame {} of {}, {}\x1b[K", progress_bar(done, total_), done, total_, note));
}

}  // namespace snip

/// @file
/// What all readers share: lines and words of a text file, numbers independent of the locale, and the
/// exception by which a reader says what is wrong and where. It never leaves the readers: `parse_mesh`
/// turns it into an `Error`.
#pragma once
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace snip::scan {

/// Thrown within a reader. `where` is appended to the name of the file.
struct ParseError {
  std::string where;
  std::string what;
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw ParseError{"", fmt::format(format, std::forward<Args>(args)...)};
}
template <class... Args>
[[noreturn]] void fail_at_line(std::size_t line, fmt::format_string<Args...> format, Args&&... args) {
  throw ParseError{fmt::format(":{}", line), fmt::format(format, std::forward<Args>(args)...)};
}
template <class... Args>
[[noreturn]] void fail_at_byte(std::size_t offset, fmt::format_string<Args...> format, Args&&... args) {
  throw ParseError{fmt::format(": byte {}", offset), fmt::format(format, std::forward<Args>(args)...)};
}

/// A word of the input in quotes, shortened and with everything unprintable escaped.
std::string quote(std::string_view word);

/// The words of one line, separated by blanks.
class Words {
 public:
  explicit Words(std::string_view line = {}) : rest_(line) {}
  /// The next word, empty at the end of the line.
  std::string_view next();
  /// The next word without consuming it.
  [[nodiscard]] std::string_view peek() const { return Words(*this).next(); }

 private:
  std::string_view rest_;
};

/// The lines of a text, with LF or CRLF at their ends, numbered from 1.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// Moves to the next line. @return false at the end of the text
  bool next();
  /// Moves to the next line that holds a word, `#` starting a comment. @return false at the end of the text
  bool next_with_words();
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  /// The text behind the current line.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
};

/// A line without its comment.
std::string_view without_comment(std::string_view line);

/// The whole word as a number, correctly rounded. Fails on words that are no number, NaN, or infinite.
/// @param what what the number is, for the message
double to_number(std::string_view word, std::size_t line, std::string_view what);

/// The whole word as an integer. Fails on words that are no integer or do not fit.
std::int64_t to_integer(std::string_view word, std::size_t line, std::string_view what);

}  // namespace snip::scan

// Lines, words and numbers of text files; see the header.
#include "snip/mesh_file/scan.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace snip::scan {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// std::from_chars takes no plus sign, files do.
std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

std::string quote(std::string_view word) {
  constexpr std::size_t longest = 24;
  std::string text = "'";
  for (const char c : word.substr(0, longest)) {
    if (c >= 0x20 && c < 0x7f)
      text += c;
    else
      text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return text + (word.size() > longest ? "...'" : "'");
}

std::string_view Words::next() {
  std::size_t begin = 0;
  while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !is_blank(rest_[end])) ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

Lines::Lines(std::string_view text) : rest_(text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

bool Lines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  return true;
}

bool Lines::next_with_words() {
  while (next())
    if (!Words(without_comment(line_)).next().empty()) {
      line_ = without_comment(line_);
      return true;
    }
  return false;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

double to_number(std::string_view word, std::size_t line, std::string_view what) {
  const std::string_view digits = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (word.empty()) fail_at_line(line, "{} is missing", what);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail_at_line(line, "{} is not a number: {}", what, quote(word));
  if (error == std::errc::result_out_of_range) {
    // Too small is zero, which is what it would round to; too large is infinite.
    if (word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos) return 0;
    fail_at_line(line, "{} is too large: {}", what, quote(word));
  }
  if (!std::isfinite(value)) fail_at_line(line, "{} is not finite: {}", what, quote(word));
  return value;
}

std::int64_t to_integer(std::string_view word, std::size_t line, std::string_view what) {
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (word.empty()) fail_at_line(line, "{} is missing", what);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail_at_line(line, "{} is not an integer: {}", what, quote(word));
  if (error != std::errc{}) fail_at_line(line, "{} is too large: {}", what, quote(word));
  return value;
}

}  // namespace snip::scan

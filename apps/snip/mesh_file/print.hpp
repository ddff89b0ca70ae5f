/// @file
/// What all writers share: numbers as text, the same in every locale.
#pragma once
#include <charconv>
#include <cstdint>
#include <string>

namespace snip::print {

/// Appends a blank and the number with 17 significant digits, enough to read the same double back.
inline void number(std::string& out, double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17);
  out += ' ';
  out.append(text, result.ptr);
}

inline void integer(std::string& out, std::uint64_t value) {
  char text[24];
  const auto result = std::to_chars(text, text + sizeof text, value);
  out.append(text, result.ptr);
}

}  // namespace snip::print

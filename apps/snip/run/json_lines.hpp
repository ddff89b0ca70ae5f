/// @file
/// Which line of a JSON text each value stands on, so that an error in a scene can be found.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

namespace snip {

/// Lines, counted from 1, by JSON pointer (RFC 6901; "" is the whole text). A member of an object stands
/// where its key stands.
struct JsonLines {
  std::unordered_map<std::string, std::size_t> line_of;
  std::string
      repeated_key;  ///< pointer of the first key that an object has twice, or empty; line_of has the second
};

/// One pass over the text; ends early where values are nested more than 100 deep. @pre the text is valid JSON
JsonLines json_lines(std::string_view text);

/// The pointer of member `key` of the object at `pointer`.
std::string json_member(const std::string& pointer, std::string_view key);

}  // namespace snip

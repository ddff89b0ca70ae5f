// Lines of JSON values, see json_lines.hpp. The parser proper knows the lines of syntax errors only, so this
// walks over the text once more; as the text is known to be valid, structure characters are all that matters.
#include "snip/run/json_lines.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace snip {
namespace {

/// The position after the string that starts at `at`.
std::size_t string_end(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return at + 1;
}

struct Level {
  bool is_array;
  std::string pointer;
  std::size_t index = 0;     // arrays: of the next item
  bool expects_key = false;  // objects
};

}  // namespace

std::string json_member(const std::string& pointer, std::string_view key) {
  std::string result = pointer + '/';
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

JsonLines json_lines(std::string_view text) {
  JsonLines result;
  std::vector<Level> levels;
  std::string here;  // pointer of the next value
  std::size_t line = 1;
  // Deeper levels are in no scene, and pointers to them would take quadratic space.
  constexpr std::size_t deepest = 100;
  const auto enter_value = [&] {
    if (!levels.empty() && levels.back().is_array)
      here = json_member(levels.back().pointer, std::to_string(levels.back().index++));
    if (levels.empty() || levels.back().is_array) result.line_of.emplace(here, line);
  };
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (c == '{' || c == '[') {
      enter_value();
      if (levels.size() == deepest) return result;
      levels.push_back({c == '[', here, 0, c == '{'});
    } else if (c == '}' || c == ']') {
      levels.pop_back();
    } else if (c == ',') {
      levels.back().expects_key = !levels.back().is_array;
    } else if (c == '"') {
      const std::size_t end = string_end(text, at);
      if (!levels.empty() && levels.back().expects_key) {
        const auto key = nlohmann::json::parse(text.substr(at, end - at)).get<std::string>();
        here = json_member(levels.back().pointer, key);
        levels.back().expects_key = false;
        const auto [entry, is_new] = result.line_of.insert_or_assign(here, line);
        if (!is_new && result.repeated_key.empty()) {
          result.repeated_key = here;
          return result;
        }
      } else {
        enter_value();
      }
      at = end;
      continue;
    } else if (c == '-' || (c >= '0' && c <= '9') || c == 't' || c == 'f' || c == 'n') {
      enter_value();
      while (at < text.size() && std::string_view(",]} \t\r\n").find(text[at]) == std::string_view::npos)
        ++at;
      continue;
    }
    ++at;
  }
  return result;
}

}  // namespace snip

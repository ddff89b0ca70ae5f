// JSON values with their place, see json_reader.hpp.
#include "snip/run/json_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace snip {
namespace {

using nlohmann::json;

/// Number of letters to change, drop, add or swap with their neighbour.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

/// "; did you mean "x"?", or the words there are.
std::string advice(std::string_view word, const std::vector<std::string_view>& words) {
  const std::string_view near = nearest_word(word, words);
  return near.empty() ? fmt::format("; known here: {}", fmt::join(words, ", "))
                      : fmt::format("; did you mean \"{}\"?", near);
}

/// One line of at most 60 characters, for a message.
std::string quoted(const std::string& text) {
  std::string shown = json(text).dump(-1, ' ', true, json::error_handler_t::replace);
  if (shown.size() > 60) shown = shown.substr(0, 56) + "...\"";
  return shown;
}

/// What a message can show of a text that may hold anything.
std::string printable(std::string text) {
  if (text.size() > 200) text = text.substr(0, 200) + "...";
  for (char& c : text)
    if (c < 32 || c > 126) c = '?';
  return text;
}

std::string syntax_error(std::string_view text, const std::string& name, const json::parse_error& error) {
  const std::size_t end = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
  const std::string_view before = text.substr(0, end);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t column = end - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  // The parser's own message begins with its name and the place.
  const std::string message = error.what();
  const std::size_t start = message.find(": ", message.find("column "));
  return fmt::format("{}:{}:{}: not valid JSON: {}", name, line, column,
                     printable(start == std::string::npos ? message : message.substr(start + 2)));
}

/// A number that a double cannot hold; its message quotes the number.
std::string overflow_error(std::string_view text, const std::string& name, const json::out_of_range& error) {
  const std::string message = error.what();
  const std::size_t first = message.find('\''), last = message.rfind('\'');
  const std::string number = first < last ? message.substr(first + 1, last - first - 1) : "";
  const std::string_view before = text.substr(0, text.find(number));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return fmt::format("{}:{}: the number {} is too large", name, line, printable(number));
}

}  // namespace

std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& words) {
  std::string_view best;
  std::size_t least = word.size() > 64 ? 0 : std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string_view candidate : words)
    if (least > 0 && distance(word, candidate) < least) {
      least = distance(word, candidate);
      best = candidate;
    }
  return best;
}

std::string JsonValue::place() const {
  const auto line = file_->lines.line_of.find(pointer_);
  return fmt::format("{}:{}: {}", file_->name, line == file_->lines.line_of.end() ? 1 : line->second,
                     pointer_.empty() ? "the scene" : printable(pointer_));
}

void JsonValue::fail(const std::string& message) const { throw JsonError(place() + ": " + message); }

void JsonValue::wrong_type(const char* wanted) const {
  std::string given = json_->type_name();
  if (given == "number") given = "a number";
  if (given == "string") given = "the text " + quoted(json_->get<std::string>());
  if (given == "array") given = "a list";
  if (given == "object") given = "an object";
  if (given == "boolean") given = json_->get<bool>() ? "true" : "false";
  fail(fmt::format("has to be {}, not {}", wanted, given));
}

void JsonValue::allow_keys(const std::vector<std::string_view>& keys) const {
  if (!json_->is_object()) wrong_type("an object");
  for (const auto& item : json_->items())
    if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) unknown_key(item.key(), keys);
}

void JsonValue::unknown_key(const std::string& key, const std::vector<std::string_view>& keys) const {
  const JsonValue value((*json_)[key], json_member(pointer_, key), *file_);
  value.fail(fmt::format("unknown key {}{}", quoted(key), advice(key, keys)));
}

bool JsonValue::has(std::string_view key) const {
  if (!json_->is_object()) wrong_type("an object");
  return json_->contains(key);
}

JsonValue JsonValue::at(std::string_view key) const {
  if (!has(key)) fail(fmt::format("the key \"{}\" is missing", key));
  return {(*json_)[std::string(key)], json_member(pointer_, key), *file_};
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return at(key);
}

std::string_view JsonValue::one_of(const std::vector<std::string_view>& keys) const {
  std::vector<std::string_view> present;
  for (const std::string_view key : keys)
    if (has(key)) present.push_back(key);
  if (present.empty())
    for (const auto& item : json_->items())
      if (!nearest_word(item.key(), keys).empty()) unknown_key(item.key(), keys);
  if (present.empty()) fail(fmt::format("one of these keys is missing: {}", fmt::join(keys, ", ")));
  if (present.size() > 1)
    fail(fmt::format("only one of these keys can be given: {}", fmt::join(present, ", ")));
  return present.front();
}

double JsonValue::number() const {
  if (!json_->is_number()) wrong_type("a number");
  const double value = json_->get<double>();
  if (!(std::abs(value) < most_magnitude))
    fail(fmt::format("has to be smaller than {} in magnitude, is {}", most_magnitude, value));
  return value;
}

double JsonValue::positive() const {
  const double value = number();
  if (!(value > 0)) fail(fmt::format("has to be greater than 0, is {}", value));
  if (!(value > least_magnitude))
    fail(fmt::format("has to be greater than {}, is {}", least_magnitude, value));
  return value;
}

double JsonValue::not_negative() const {
  const double value = number();
  if (!(value >= 0)) fail(fmt::format("cannot be negative, is {}", value));
  return value;
}

std::size_t JsonValue::count(std::size_t least, std::size_t most) const {
  if (json_->is_number_float()) fail(fmt::format("has to be a whole number, is {}", json_->dump()));
  if (!json_->is_number_integer()) wrong_type("a whole number");
  const bool negative = !json_->is_number_unsigned() && json_->get<std::int64_t>() < 0;
  if (negative || json_->get<std::uint64_t>() < least || json_->get<std::uint64_t>() > most)
    fail(fmt::format("has to be from {} to {}, is {}", least, most, json_->dump()));
  return json_->get<std::size_t>();
}

bool JsonValue::boolean() const {
  if (!json_->is_boolean()) wrong_type("true or false");
  return json_->get<bool>();
}

std::string JsonValue::text() const {
  if (!json_->is_string()) wrong_type("a text");
  const auto value = json_->get<std::string>();
  if (value.find('\0') != std::string::npos) fail("cannot have the character 0 in it");
  return value;
}

std::size_t JsonValue::word(const std::vector<std::string_view>& words) const {
  const std::string given = text();
  const auto found = std::find(words.begin(), words.end(), given);
  if (found == words.end()) fail(fmt::format("unknown value {}{}", quoted(given), advice(given, words)));
  return static_cast<std::size_t>(found - words.begin());
}

Eigen::Vector3d JsonValue::vector() const {
  if (!json_->is_array()) wrong_type("a list of three numbers");
  if (json_->size() != 3) fail(fmt::format("has to be a list of three numbers, has {}", json_->size()));
  const std::vector<JsonValue> items = list();
  return {items[0].number(), items[1].number(), items[2].number()};
}

Eigen::Vector3d JsonValue::nonzero_vector() const {
  const Eigen::Vector3d value = vector();
  const double largest = value.cwiseAbs().maxCoeff();
  if (largest == 0) fail("cannot be zero");
  if (!(largest > least_magnitude))
    fail(fmt::format("has to be longer than {}, is {}", least_magnitude, largest));
  return value;
}

std::vector<JsonValue> JsonValue::list(std::size_t least, std::size_t most) const {
  if (!json_->is_array()) wrong_type("a list");
  if (json_->size() < least || json_->size() > most)
    fail(least == most           ? fmt::format("has to have {} items, has {}", least, json_->size())
         : json_->size() < least ? fmt::format("has to have at least {} items, has {}", least, json_->size())
                                 : fmt::format("can have at most {} items, has {}", most, json_->size()));
  std::vector<JsonValue> items;
  for (std::size_t i = 0; i < json_->size(); ++i)
    items.emplace_back((*json_)[i], json_member(pointer_, std::to_string(i)), *file_);
  return items;
}

Result<> read_json(std::string_view text, const std::string& name,
                   const std::function<void(const JsonValue&)>& use) {
  try {
    const json parsed = json::parse(text);
    const JsonFile file{name, json_lines(text)};
    const JsonValue outermost(parsed, "", file);
    if (const std::string& repeated = file.lines.repeated_key; !repeated.empty())
      JsonValue(parsed, repeated, file).fail("the key is given twice");
    use(outermost);
    return {};
  } catch (const json::parse_error& error) {
    return Error{syntax_error(text, name, error)};
  } catch (const json::out_of_range& error) {
    return Error{overflow_error(text, name, error)};
  } catch (const JsonError& error) {
    return Error{error.what()};
  }
}

}  // namespace snip

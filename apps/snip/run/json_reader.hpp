/// @file
/// A JSON value together with its place in the file: what is asked of it and not there, of another type or
/// out of range is an error that says where, and what would have been right.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cut/triangle_mesh.hpp"
#include "snip/result.hpp"
#include "snip/run/json_lines.hpp"

namespace snip {

/// Numbers are smaller than this in magnitude; it is what libcut takes as a coordinate, and products of
/// several such numbers are finite.
inline constexpr double most_magnitude = cut::largest_coordinate;
/// Numbers and lengths that have to be positive are greater than this.
inline constexpr double least_magnitude = 1e-50;

/// Thrown by JsonValue and caught by read_json.
struct JsonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What all values of a file have in common.
struct JsonFile {
  std::string name;  ///< for messages
  JsonLines lines;
};

class JsonValue {
 public:
  JsonValue(const nlohmann::json& json, std::string pointer, const JsonFile& file)
      : json_(&json), pointer_(std::move(pointer)), file_(&file) {}

  /// "file:line: pointer", to go in front of a message.
  [[nodiscard]] std::string place() const;
  [[noreturn]] void fail(const std::string& message) const;

  // Objects.
  /// Fails unless this is an object with no other keys than these; suggests the nearest.
  void allow_keys(const std::vector<std::string_view>& keys) const;
  [[nodiscard]] bool has(std::string_view key) const;
  /// Fails when the key is missing.
  [[nodiscard]] JsonValue at(std::string_view key) const;
  [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;
  /// Exactly one of these keys has to be there; returns which.
  [[nodiscard]] std::string_view one_of(const std::vector<std::string_view>& keys) const;

  // Values. Each fails unless the type and the range fit (most_magnitude).
  [[nodiscard]] double number() const;
  [[nodiscard]] double positive() const;
  [[nodiscard]] double not_negative() const;
  [[nodiscard]] std::size_t count(std::size_t least, std::size_t most) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;
  /// The index of the word among `words`.
  [[nodiscard]] std::size_t word(const std::vector<std::string_view>& words) const;
  [[nodiscard]] Eigen::Vector3d vector() const;
  [[nodiscard]] Eigen::Vector3d nonzero_vector() const;
  /// A list of at least `least` and at most `most` items.
  [[nodiscard]] std::vector<JsonValue> list(std::size_t least = 0,
                                            std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  [[nodiscard]] bool is_list() const { return json_->is_array(); }

 private:
  [[noreturn]] void wrong_type(const char* wanted) const;
  [[noreturn]] void unknown_key(const std::string& key, const std::vector<std::string_view>& keys) const;
  const nlohmann::json* json_;
  std::string pointer_;
  const JsonFile* file_;
};

/// Parses `text` and hands its outermost value to `use`. Errors of syntax, repeated keys, and what `use`
/// finds come back as one line that begins with "name:line: ".
Result<> read_json(std::string_view text, const std::string& name,
                   const std::function<void(const JsonValue&)>& use);

/// The word that `word` was probably meant to be: few letters differ. Empty when none is near.
std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace snip

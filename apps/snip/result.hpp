/// @file
/// Errors of the command line tool: one line for a person, carried as a value.
#pragma once
#include <concepts>
#include <string>
#include <utility>
#include <variant>

namespace snip {

/// What is wrong, where, and what to do about it, in one line without a full stop.
struct Error {
  std::string message;
};

/// A value, or the reason why there is none. `Result<>` is success without a value.
template <class T = std::monostate>
class [[nodiscard]] Result {
 public:
  Result()
    requires std::same_as<T, std::monostate>
  = default;
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: meant to convert
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: meant to convert
  explicit operator bool() const { return content_.index() == 0; }
  /// @pre the result holds a value
  T& operator*() { return *std::get_if<0>(&content_); }
  const T& operator*() const { return *std::get_if<0>(&content_); }
  T* operator->() { return std::get_if<0>(&content_); }
  const T* operator->() const { return std::get_if<0>(&content_); }
  /// @pre the result holds no value
  [[nodiscard]] const Error& error() const { return *std::get_if<1>(&content_); }

 private:
  std::variant<T, Error> content_;
};

}  // namespace snip

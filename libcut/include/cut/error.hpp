/// @file
/// Errors as values: what is wrong, where, and which element. The library throws nothing of its own.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

namespace cut {

/// What went wrong, in one line for a person, and the element that it is about.
struct Error {
  enum class Kind {
    empty_mesh,           ///< no triangle is left to work on
    index_out_of_range,   ///< a triangle names a point that does not exist
    not_finite,           ///< a coordinate is NaN, infinite or beyond `largest_coordinate`
    too_far,              ///< a cutter reaches so far that its rounding is no longer small against the cloth
    degenerate_triangle,  ///< a triangle has no area
    duplicate_triangle,   ///< two triangles have the same three corners
    non_manifold_edge,    ///< more than two triangles share an edge
    bad_merge_distances,  ///< δc ≥ δn ≥ δe > δf does not hold
    too_large,            ///< more elements than an index can count
    unstable,             ///< the simulation blew up
    not_converged,        ///< an implicit step of the simulation found no solution
    bad_parameter         ///< any other value outside its range
  };
  Kind kind;
  std::string message;
  std::size_t element = 0;  ///< index of the point or triangle that the message is about
};

/// A value or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: meant to convert
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: meant to convert
  [[nodiscard]] bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  /// @pre has_value()
  [[nodiscard]] T& value() & { return *std::get_if<0>(&content_); }
  [[nodiscard]] const T& value() const& { return *std::get_if<0>(&content_); }
  [[nodiscard]] T&& value() && { return std::move(*std::get_if<0>(&content_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return std::get_if<0>(&content_); }
  const T* operator->() const { return std::get_if<0>(&content_); }
  /// @pre !has_value()
  [[nodiscard]] const Error& error() const { return *std::get_if<1>(&content_); }

 private:
  std::variant<T, Error> content_;
};

}  // namespace cut

/// @file
/// The tree moves values between leaves and must not fail while it does. A value whose move may throw is
/// therefore kept behind a pointer. In: values. Out: something that moves without throwing.
#pragma once
#include <memory>
#include <type_traits>
#include <utility>

namespace spatial::detail {

template <class Value>
struct Holder {
  std::unique_ptr<Value> pointer;
};

template <class Value>
using Stored = std::conditional_t<std::is_nothrow_move_constructible_v<Value>, Value, Holder<Value>>;

template <class Value>
constexpr Value& unwrap(Value& value) {
  return value;
}
template <class Value>
constexpr const Value& unwrap(const Value& value) {
  return value;
}
template <class Value>
Value& unwrap(Holder<Value>& holder) {
  return *holder.pointer;
}
template <class Value>
const Value& unwrap(const Holder<Value>& holder) {
  return *holder.pointer;
}

/// A value made ready to be stored, with the container's allocator where the value uses one.
template <class Value, class Allocator, class... From>
Stored<Value> wrap(const Allocator& allocator, From&&... from) {
  if constexpr (std::is_nothrow_move_constructible_v<Value>) {
    return std::make_obj_using_allocator<Value>(allocator, std::forward<From>(from)...);
  } else {
    return {std::make_unique<Value>(std::forward<From>(from)...)};
  }
}

}  // namespace spatial::detail

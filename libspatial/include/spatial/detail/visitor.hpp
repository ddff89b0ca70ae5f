/// @file
/// The ways in which a user takes results: as an output iterator, or as a function of the value, with or
/// without its handle and distance, that returns nothing or whether to go on. In: a result. Out: whether to
/// go on.
#pragma once
#include <cstddef>
#include <type_traits>
#include <utility>

#include "../handle.hpp"
#include "../tree_statistics.hpp"

namespace spatial::detail {

template <class F, class... Arguments>
bool call(F& f, Arguments&&... arguments) {
  if constexpr (std::is_void_v<std::invoke_result_t<F&, Arguments...>>) {
    f(std::forward<Arguments>(arguments)...);
    return true;
  } else {
    return static_cast<bool>(f(std::forward<Arguments>(arguments)...));
  }
}

template <class Value, class Sink, class MakeHandle, class... Distance>
bool give(Sink& sink, const Value& value, const MakeHandle& handle, Distance... distance) {
  if constexpr (std::is_invocable_v<Sink&, const Value&>) {
    return call(sink, value);
  } else if constexpr (std::is_invocable_v<Sink&, const Value&, Handle>) {
    return call(sink, value, handle());
  } else if constexpr (std::is_invocable_v<Sink&, const Value&, Handle, Distance...>) {
    return call(sink, value, handle(), distance...);
  } else {
    *sink = value;
    ++sink;
    return true;
  }
}

template <class A, class B, class Visitor, class HandleA, class HandleB>
bool give_pair(Visitor& visitor, const A& a, const HandleA& handle_a, const B& b, const HandleB& handle_b) {
  if constexpr (std::is_invocable_v<Visitor&, const A&, const B&>) {
    return call(visitor, a, b);
  } else {
    return call(visitor, a, handle_a(), b, handle_b());
  }
}

/// An output iterator for handles that nobody wants.
struct NoHandles {
  using difference_type = std::ptrdiff_t;
  struct Nowhere {
    const Nowhere& operator=(Handle) const { return *this; }
  };
  Nowhere operator*() const { return {}; }
  NoHandles& operator++() { return *this; }
  NoHandles operator++(int) { return *this; }
};

/// Counts what a search looks at.
struct Counts {
  QueryStatistics result;
  void node() { ++result.nodes; }
  void leaf(std::size_t elements) {
    ++result.leaves;
    result.elements += elements;
  }
};

}  // namespace spatial::detail

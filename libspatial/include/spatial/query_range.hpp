/// @file
/// The results of a query as a range, found one by one while it is iterated. In: a cursor. Out: an input
/// range of values.
#pragma once
#include <cstddef>
#include <iterator>
#include <utility>

#include "box.hpp"
#include "detail/holder.hpp"
#include "handle.hpp"

namespace spatial {

/// An input range: it can be passed through once. Every change of the tree invalidates it.
template <class Value, class Core, class Cursor>
class QueryRange {
 public:
  QueryRange(const Core& core, Cursor cursor) : core_(&core), cursor_(std::move(cursor)) {}

  class Iterator {
   public:
    using iterator_concept = std::input_iterator_tag;
    using value_type = Value;
    using difference_type = std::ptrdiff_t;
    using reference = const Value&;

    Iterator() = default;
    explicit Iterator(QueryRange& range) : range_(&range) { ++*this; }
    reference operator*() const {
      return detail::unwrap(range_->cursor_.leaf().values()[range_->cursor_.position()]);
    }
    const Value* operator->() const { return &**this; }
    Iterator& operator++() {
      if (!range_->cursor_.next()) range_ = nullptr;
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& i, std::default_sentinel_t) { return i.range_ == nullptr; }

    [[nodiscard]] Handle handle() const {
      const auto id = range_->cursor_.leaf().id(range_->cursor_.position());
      return {id, range_->core_->generation(id)};
    }
    [[nodiscard]] auto box() const { return range_->cursor_.leaf().box(range_->cursor_.position()); }
    /// Of ordered queries.
    [[nodiscard]] auto distance() const
      requires requires(const Cursor& c) { c.distance(); }
    {
      return range_->cursor_.distance();
    }

   private:
    QueryRange* range_ = nullptr;
  };

  [[nodiscard]] Iterator begin() { return Iterator(*this); }
  [[nodiscard]] std::default_sentinel_t end() const { return {}; }

 private:
  const Core* core_;
  Cursor cursor_;
};

/// Goes through all elements of a tree, in no particular order. Every change of the tree invalidates it.
template <class Value, class Core>
class TreeIterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = Value;
  using difference_type = std::ptrdiff_t;
  using reference = const Value&;
  using pointer = const Value*;

  TreeIterator() = default;
  TreeIterator(const Core& core, std::uint32_t leaf) : core_(&core), leaf_(leaf) { skip_empty(); }
  reference operator*() const { return detail::unwrap(core_->leaf(leaf_).values()[position_]); }
  pointer operator->() const { return &**this; }
  TreeIterator& operator++() {
    ++position_;
    skip_empty();
    return *this;
  }
  TreeIterator operator++(int) {
    TreeIterator old = *this;
    ++*this;
    return old;
  }
  friend bool operator==(const TreeIterator& a, const TreeIterator& b) {
    return a.leaf_ == b.leaf_ && a.position_ == b.position_;
  }

  [[nodiscard]] Handle handle() const {
    const auto id = core_->leaf(leaf_).id(position_);
    return {id, core_->generation(id)};
  }
  [[nodiscard]] auto box() const { return core_->leaf(leaf_).box(position_); }

 private:
  void skip_empty() {
    while (leaf_ < core_->leaves().size() && position_ >= core_->leaf(leaf_).count) {
      ++leaf_;
      position_ = 0;
    }
  }

  const Core* core_ = nullptr;
  std::uint32_t leaf_ = 0;
  std::uint32_t position_ = 0;
};

}  // namespace spatial

/// @file
/// A stack that lives on the call stack while it is small. Queries walk the tree with it instead of
/// recursion, so that no depth of a tree can overflow the call stack.
#pragma once
#include <cstddef>
#include <vector>

namespace spatial::detail {

template <class T, std::size_t Inline>
class SmallStack {
 public:
  void push(const T& item) {
    if (size_ < Inline) {
      items_[size_++] = item;
    } else {
      more_.push_back(item);
    }
  }
  /// Adds an item that is still to be filled.
  T& push() {
    if (size_ < Inline) return items_[size_++];
    return more_.emplace_back();
  }
  T pop() {
    if (size_ == Inline && !more_.empty()) {
      T item = more_.back();
      more_.pop_back();
      return item;
    }
    return items_[--size_];
  }
  void drop() {
    if (size_ == Inline && !more_.empty()) {
      more_.pop_back();
    } else {
      --size_;
    }
  }
  [[nodiscard]] T& operator[](std::size_t i) { return i < Inline ? items_[i] : more_[i - Inline]; }
  [[nodiscard]] T& top() { return (*this)[size() - 1]; }
  [[nodiscard]] std::size_t size() const { return size_ + more_.size(); }
  [[nodiscard]] bool empty() const { return size_ == 0; }

 private:
  std::size_t size_ = 0;
  T items_[Inline];
  std::vector<T> more_;
};

}  // namespace spatial::detail

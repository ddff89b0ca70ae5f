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
  T pop() {
    if (size_ == Inline && !more_.empty()) {
      T item = more_.back();
      more_.pop_back();
      return item;
    }
    return items_[--size_];
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }

 private:
  std::size_t size_ = 0;
  T items_[Inline];
  std::vector<T> more_;
};

}  // namespace spatial::detail

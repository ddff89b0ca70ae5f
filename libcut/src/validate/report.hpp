/// @file
/// Where the rules put what they find. In: violations, one at a time. Out: the list that `validate` returns.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "cut/validate.hpp"

namespace cut::validation {

class Report {
 public:
  explicit Report(std::size_t limit) : limit_(limit) {}

  void add(const char* rule, std::string message) {
    if (!full()) violations_.push_back({rule, std::move(message)});
  }
  [[nodiscard]] bool full() const { return violations_.size() >= limit_; }
  [[nodiscard]] std::size_t size() const { return violations_.size(); }
  [[nodiscard]] std::vector<Violation> take() { return std::move(violations_); }

 private:
  std::size_t limit_;
  std::vector<Violation> violations_;
};

/// "triangle 7": the way messages name an element.
inline std::string name(const char* kind, std::size_t index) {
  return std::string(kind) + ' ' + std::to_string(index);
}

}  // namespace cut::validation

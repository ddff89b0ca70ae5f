// A sequence of bytes that is read as a sequence of decisions. In: bytes of a fuzzer or a property test. Out:
// numbers; zeros once the bytes are used up.
#pragma once
#include <cstddef>
#include <cstdint>

namespace operations {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return at_ >= size_; }
  unsigned next() { return at_ < size_ ? data_[at_++] : 0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

}  // namespace operations

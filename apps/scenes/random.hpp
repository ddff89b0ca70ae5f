/// @file
/// Random numbers that are the same on every machine: SplitMix64, integers only up to the last step.
#pragma once
#include <cstdint>

namespace scenes {

/// Standard distributions differ between standard libraries, so scenes draw from this instead.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// 64 evenly distributed bits.
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// In [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// In [0, count). @pre count > 0. The bias of the remainder is below count / 2^64.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }

 private:
  std::uint64_t state_;
};

}  // namespace scenes

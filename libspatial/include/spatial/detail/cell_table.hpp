/// @file
/// A map from grid cells to a number, flat and open-addressed. In: integer cell coordinates. Out: the number
/// stored.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace spatial::detail {

template <std::size_t D>
class CellTable {
 public:
  using Key = std::array<std::int32_t, D>;
  static constexpr std::uint32_t none = 0xffffffffu;

  /// The number of a cell, or `none`.
  [[nodiscard]] std::uint32_t find(const Key& key) const {
    if (entries_.empty()) return none;
    for (std::size_t i = start(key);; i = (i + 1) & (entries_.size() - 1)) {
      const Entry& entry = entries_[i];
      if (entry.number == unused) return none;
      if (entry.key == key) return entry.number;
    }
  }

  /// Makes room for one more cell, so that the next entry() cannot fail.
  void reserve_one() {
    if (2 * (used_ + 1) > entries_.size()) grow();
  }
  /// The number of a cell, to be changed; a new cell has `none`. @pre reserve_one(), for a new cell
  std::uint32_t& entry(const Key& key) {
    Entry& found = place(key);
    if (found.number == unused) {
      found = {key, none};
      ++used_;
    }
    return found.number;
  }

  void clear() {
    entries_.clear();
    used_ = 0;
  }

 private:
  struct Entry {
    Key key{};
    std::uint32_t number = unused;
  };
  static constexpr std::uint32_t unused = 0xfffffffeu;

  [[nodiscard]] std::size_t start(const Key& key) const {
    const auto first = static_cast<std::uint32_t>(key[0]);
    std::uint64_t h = first >> 2;
    for (std::size_t a = 1; a < D; ++a) {
      h = (h * 0x9e3779b97f4a7c15u) ^ static_cast<std::uint32_t>(key[a]);
      h ^= h >> 29;
    }
    return static_cast<std::size_t>((h * 0x9e3779b97f4a7c15u) >> shift_ << 2 | (first & 3u));
  }
  Entry& place(const Key& key) {
    std::size_t i = start(key);
    while (entries_[i].number != unused && entries_[i].key != key) i = (i + 1) & (entries_.size() - 1);
    return entries_[i];
  }
  void grow() {
    const std::size_t size = entries_.empty() ? 16 : entries_.size() * 2;
    std::vector<Entry> old(size, Entry{});
    old.swap(entries_);
    shift_ = 64;
    for (std::size_t s = size / 4; s > 1; s /= 2) --shift_;
    for (const Entry& entry : old) {
      if (entry.number != unused) place(entry.key) = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t used_ = 0;
  unsigned shift_ = 63;
};

}  // namespace spatial::detail

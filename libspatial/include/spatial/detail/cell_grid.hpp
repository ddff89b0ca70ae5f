/// @file
/// The grid of the point cluster dictionary (§5.2): a flat, open-addressed table from a cell to the centres
/// in it, which lie side by side, one row per coordinate. In: integer cell coordinates, points with numbers.
/// Out: the numbers of the points that may be near.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../box.hpp"
#include "lanes.hpp"

namespace spatial::detail {

template <class T, std::size_t D>
class CellGrid {
 public:
  using Key = std::array<std::int32_t, D>;

  /// A place that prepare() found, until the next change.
  using Place = std::size_t;

  CellGrid() { free_.fill(none); }

  /// Makes room for one more point in a cell, so that add() cannot fail.
  Place prepare(const Key& key) {
    // A quarter full at most: what is looked for is nearly always the first thing found.
    if (4 * (used_ + 1) > entries_.size()) grow();
    const std::size_t at = find(key, start(hash(key)));
    Entry& entry = entries_[at];
    if (entry.count == unused) {
      entry = {key, 0, 0, 0};
      ++used_;
    }
    if (entry.count == capacity(entry)) enlarge(entry);
    return at;
  }
  void add(Place place, const Point<T, D>& point, std::uint32_t number) {
    Entry& entry = entries_[place];
    const std::size_t stride = capacity(entry);
    T* rows = coordinates(entry);
    for (std::size_t a = 0; a < D; ++a) rows[a * stride + entry.count] = point[a];
    numbers_[entry.first + entry.count] = number;
    ++entry.count;
  }
  /// @pre it is there
  void remove(const Key& key, std::uint32_t number) {
    Entry& entry = entries_[find(key, start(hash(key)))];
    const std::size_t stride = capacity(entry);
    std::uint32_t* numbers = numbers_.data() + entry.first;
    const std::uint32_t last = entry.count - 1;
    std::uint32_t at = 0;
    while (numbers[at] != number) ++at;
    numbers[at] = numbers[last];
    T* rows = coordinates(entry);
    for (std::size_t a = 0; a < D; ++a) rows[a * stride + at] = rows[a * stride + last];
    entry.count = last;
  }
  [[nodiscard]] std::size_t bytes() const {
    return entries_.capacity() * sizeof(Entry) + coordinates_.capacity() * sizeof(T) +
           numbers_.capacity() * sizeof(std::uint32_t);
  }
  void clear() {
    entries_.clear();
    coordinates_.clear();
    numbers_.clear();
    free_.fill(none);
    used_ = 0;
  }

  /// Calls `visit(number, point)` for all points whose squared distance from `point` may be up to `bound` in
  /// the cell `home`, and in those beside it: `other` on an axis, if the sum of `gap`² is at most `reach`.
  /// @param bound allows for the rounding of a sum of squares in T
  template <class Visit>
  void visit_near(const Point<T, D>& point, T bound, const Key& home, const Key& other,
                  const double (&gap)[D], double reach, Visit&& visit) const {
    if (entries_.empty()) return;
    constexpr std::size_t cells = std::size_t{1} << D;
    // Which cells are near, and how full they are, cannot be predicted: they are listed without branches, and
    // memory is asked for before it is needed.
    std::uint64_t hashes[cells];
    double distance[cells];
    std::uint32_t near[cells];
    hashes[0] = hash(home);
    distance[0] = 0;
    near[0] = 0;
    std::size_t count = 1;
    for (std::size_t a = 0; a < D; ++a) {
      const std::uint64_t step = factor(a) * static_cast<std::uint64_t>(std::int64_t{other[a]} - home[a]);
      const std::size_t bit = std::size_t{1} << a;
      for (std::size_t c = 0; c < bit; ++c) {
        hashes[bit + c] = hashes[c] + step;
        distance[bit + c] = distance[c] + gap[a] * gap[a];
        near[count] = static_cast<std::uint32_t>(bit + c);
        count += static_cast<std::size_t>(distance[bit + c] <= reach);
      }
    }
    for (std::size_t i = 0; i < count; ++i) prefetch(&entries_[start(hashes[near[i]])]);
    const Entry* found[cells];
    std::size_t found_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      Key key;
      for (std::size_t a = 0; a < D; ++a) key[a] = ((near[i] >> a) & 1u) != 0 ? other[a] : home[a];
      const Entry& entry = entries_[find(key, start(hashes[near[i]]))];
      found[found_count] = &entry;
      found_count += static_cast<std::size_t>(entry.count != unused);
      prefetch(coordinates_.data() + std::size_t{entry.first} * D);
    }
    for (std::size_t i = 0; i < found_count; ++i) visit_cell(*found[i], point, bound, visit);
  }

 private:
  struct Entry {
    Key key{};
    std::uint32_t first = 0;
    std::uint32_t count = unused;
    std::uint32_t order = 0;  // there is room for 2^(order - 1), or nothing
  };
  static constexpr std::uint32_t unused = 0xffffffffu;
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t overread = 16;  // two packs

  static std::size_t capacity(const Entry& entry) { return (std::size_t{1} << entry.order) >> 1; }
  [[nodiscard]] T* coordinates(const Entry& entry) {
    return coordinates_.data() + std::size_t{entry.first} * D;
  }

  template <class Visit>
  void visit_cell(const Entry& entry, const Point<T, D>& point, T bound, Visit& visit) const {
    const std::size_t stride = capacity(entry);
    const T* rows = coordinates_.data() + std::size_t{entry.first} * D;
    const std::uint32_t* numbers = numbers_.data() + entry.first;
    for (std::uint32_t begin = 0; begin < entry.count; begin += mask_bits) {
      const std::size_t count = entry.count - begin < mask_bits ? entry.count - begin : mask_bits;
      std::uint32_t hits = in_reach<T, D>(rows + begin, stride, count, point, bound);
      for (; hits != 0; hits &= hits - 1) {
        const std::size_t i = begin + static_cast<std::size_t>(std::countr_zero(hits));
        Point<T, D> centre;
        for (std::size_t a = 0; a < D; ++a) centre[a] = rows[a * stride + i];
        visit(numbers[i], centre);
      }
    }
  }

  static constexpr std::uint64_t factor(std::size_t axis) {
    return (0x9e3779b97f4a7c15u * (2 * axis + 1)) ^ (0xc2b2ae3d27d4eb4fu * axis * 2);
  }
  /// Linear in the key, so that a neighbour's is one addition away. start() mixes it.
  static std::uint64_t hash(const Key& key) {
    std::uint64_t h = 0;
    for (std::size_t a = 0; a < D; ++a) h += factor(a) * static_cast<std::uint64_t>(std::int64_t{key[a]});
    return h;
  }
  [[nodiscard]] std::size_t start(std::uint64_t h) const {
    return static_cast<std::size_t>(((h ^ (h >> 32)) * 0x9e3779b97f4a7c15u) >> shift_);
  }
  [[nodiscard]] std::size_t find(const Key& key, std::size_t i) const {
    while (entries_[i].count != unused && differ(entries_[i].key, key)) i = (i + 1) & (entries_.size() - 1);
    return i;
  }
  // std::array's == calls memcmp.
  static bool differ(const Key& a, const Key& b) {
    std::int32_t bits = 0;
    for (std::size_t i = 0; i < D; ++i) bits |= a[i] ^ b[i];
    return bits != 0;
  }

  /// Makes room for cells, where emptied ones do not make enough.
  void grow() {
    std::size_t cells = 0;
    for (const Entry& entry : entries_)
      cells += static_cast<std::size_t>(!is_unused(entry) && entry.count > 0);
    const std::size_t size = entries_.empty()              ? 16
                             : 8 * cells < entries_.size() ? entries_.size()
                                                           : 2 * entries_.size();
    std::vector<Entry> old(size, Entry{});
    old.swap(entries_);
    shift_ = 64 - static_cast<unsigned>(std::countr_zero(size));
    used_ = cells;
    for (const Entry& entry : old) {
      if (is_unused(entry)) continue;
      if (entry.count > 0) {
        entries_[find(entry.key, start(hash(entry.key)))] = entry;
      } else {
        free_block(entry);
      }
    }
  }
  static bool is_unused(const Entry& entry) { return entry.count == unused; }
  void free_block(const Entry& entry) {
    if (entry.order == 0) return;
    numbers_[entry.first] = free_[entry.order];
    free_[entry.order] = entry.first;
  }

  /// Moves a cell's points to a block of twice the capacity; the old one is used again.
  void enlarge(Entry& entry) {
    const std::size_t old_stride = capacity(entry);
    const std::uint32_t order = entry.order + 1;
    const std::size_t stride = std::size_t{1} << (order - 1);
    std::uint32_t first = free_[order];
    if (first != none) {
      free_[order] = numbers_[first];
    } else {
      first = static_cast<std::uint32_t>(numbers_.size());
      coordinates_.resize((first + stride) * D + overread);
      numbers_.resize(first + stride);
    }
    const T* from = coordinates(entry);
    T* to = coordinates_.data() + std::size_t{first} * D;
    for (std::size_t i = 0; i < entry.count; ++i) {
      for (std::size_t a = 0; a < D; ++a) to[a * stride + i] = from[a * old_stride + i];
      numbers_[first + i] = numbers_[entry.first + i];
    }
    free_block(entry);
    entry.first = first;
    entry.order = order;
  }

  std::vector<Entry> entries_;
  std::vector<T> coordinates_;
  std::vector<std::uint32_t> numbers_;
  std::array<std::uint32_t, 33> free_;  // blocks of each order; the first number is the next one
  std::size_t used_ = 0;
  unsigned shift_ = 63;
};

}  // namespace spatial::detail

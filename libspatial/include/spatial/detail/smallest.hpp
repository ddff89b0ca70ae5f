/// @file
/// Keeps the k smallest of the keys that it is given, and what they stand for. In: keys, in any order. Out: a
/// bound that tells early which keys are not needed, and in the end the k smallest in order. Keys are
/// compared without branches wherever these would be taken at random.
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "lanes.hpp"
#include "levels.hpp"

namespace spatial::detail {

/// An element that was found.
template <class S>
struct Keyed {
  S key;
  std::uint32_t leaf, position;
};

/// Of a few the greatest one is known, and gives way to what is smaller. Many are collected, and thinned out
/// when there are a quarter too many for the first time, then twice as many; that costs constant time for
/// each.
template <class S>
class Smallest {
 public:
  /// @pre limit > 0
  Smallest(std::size_t limit, std::size_t available) : limit_(limit), is_few_(limit <= few) {
    for (S& key : few_keys_) key = -1;
    if (is_few_) return;
    const std::size_t most = limit > available / 2 ? available : 2 * limit;
    room_ = most > limit ? most : limit + 1;
    thin_at_ = std::min(room_, limit + limit / slack);
    keys_ = std::make_unique_for_overwrite<S[]>(room_ + level_bits);
    places_ = std::make_unique_for_overwrite<Place[]>(room_ + level_bits);
  }
  /// True if something with this key is still needed. What is infinitely far is, while less than `limit` were
  /// given.
  [[nodiscard]] bool wants(S key) const { return full_ ? key < worst_ : key <= worst_; }
  /// Nothing with a greater key is needed.
  [[nodiscard]] S worst() const { return worst_; }
  /// True once there are enough.
  [[nodiscard]] bool full() const { return full_; }
  /// How many are needed until there are enough; 0 also while the first ones wait to be thinned out.
  [[nodiscard]] std::size_t missing() const { return limit_ - std::min(limit_, count_); }

  /// Adds elements of one leaf; element i is at first + positions[i]. @pre count <= level_bits, 0 <= keys[i]
  /// <= worst()
  void add(std::uint32_t leaf, std::uint32_t first, const S* keys, const std::uint8_t* positions,
           std::size_t count) {
    if (!is_few_) {
      for (std::size_t i = 0; i < count; ++i) {
        keys_[count_ + i] = keys[i];
        places_[count_ + i] = {leaf, first + positions[i]};
      }
      count_ += count;
      if (count_ >= thin_at_) thin();
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!wants(keys[i])) continue;
      const std::size_t at = full_ ? worst_at_ : count_++;
      few_keys_[at] = keys[i];
      few_places_[at] = {leaf, first + positions[i]};
      if (count_ == limit_) find_worst();
    }
  }
  /// Calls `visit(item)` for each, nearest first, until it returns false.
  template <class Visit>
  void visit_in_order(Visit&& visit) {
    if (is_few_) {
      std::uint8_t order[few];
      sort_few(order);
      for (std::size_t i = 0; i < count_; ++i) {
        const Place& place = few_places_[order[i]];
        if (!visit(Keyed<S>{few_keys_[order[i]], place.leaf, place.position})) return;
      }
      return;
    }
    if (count_ > limit_) thin();
    const auto sorted = sort_many();
    for (std::size_t i = 0; i < std::min(limit_, count_); ++i) {
      if (!visit(sorted[i])) return;
    }
  }

 private:
  static constexpr std::size_t few = 16;
  static constexpr std::size_t slack = 4;  // thinning leaves up to a quarter too many
  struct Place {
    std::uint32_t leaf, position;
  };

  // --- a few ---

  void find_worst() {
    full_ = true;
#ifdef SPATIAL_WIDE
    if constexpr (Pack<S>::width != 0) {
      using P = Pack<S>;
      using V = typename P::V;
      V greatest = pack(0);
      for (std::size_t i = P::width; i < few; i += P::width) {
        greatest = pack(i) > greatest ? pack(i) : greatest;
      }
      worst_ = greatest[0];
      for (std::size_t i = 1; i < P::width; ++i) worst_ = greatest[i] > worst_ ? greatest[i] : worst_;
      std::uint32_t equal = 0;
      for (std::size_t i = 0; i < few; i += P::width) equal |= P::bits(pack(i) == V{} + worst_) << i;
      worst_at_ = static_cast<std::size_t>(std::countr_zero(equal));
      return;
    }
#endif
    worst_at_ = 0;
    for (std::size_t i = 1; i < few; ++i) worst_at_ = few_keys_[i] > few_keys_[worst_at_] ? i : worst_at_;
    worst_ = few_keys_[worst_at_];
  }
  // By the number of keys before each. Equal ones take the places behind the first of them.
  void sort_few(std::uint8_t* order) const {
    std::uint32_t ranks[few] = {};
    find_ranks(ranks);
    std::uint32_t taken = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      std::uint32_t rank = ranks[i];
      while (((taken >> rank) & 1u) != 0) ++rank;
      taken |= 1u << rank;
      order[rank] = static_cast<std::uint8_t>(i);
    }
  }
  void find_ranks(std::uint32_t (&ranks)[few]) const {
#ifdef SPATIAL_WIDE
    if constexpr (Pack<S>::width != 0) {
      using P = Pack<S>;
      using V = typename P::V;
      typename P::M before[few / P::width] = {};
      for (std::size_t j = 0; j < count_; ++j) {
        const V key = V{} + few_keys_[j];
        for (std::size_t i = 0; i < few / P::width; ++i) before[i] -= key < pack(i * P::width);
      }
      for (std::size_t i = 0; i < few; ++i) {
        ranks[i] = static_cast<std::uint32_t>(before[i / P::width][i % P::width]);
      }
      return;
    }
#endif
    for (std::size_t j = 0; j < count_; ++j) {
      for (std::size_t i = 0; i < few; ++i) ranks[i] += few_keys_[j] < few_keys_[i] ? 1 : 0;
    }
  }
#ifdef SPATIAL_WIDE
  [[nodiscard]] auto pack(std::size_t i) const {
    typename Pack<S>::V keys;
    std::memcpy(&keys, few_keys_ + i, sizeof(keys));
    return keys;
  }
#endif

  // --- many ---

  [[nodiscard]] std::size_t number_up_to(S bound) const {
    std::size_t result = 0;
    std::size_t i = 0;
#ifdef SPATIAL_WIDE
    if constexpr (Pack<S>::width != 0) {
      using P = Pack<S>;
      typename P::M counts{};
      for (; i + P::width <= count_; i += P::width) {
        typename P::V keys;
        std::memcpy(&keys, keys_.get() + i, sizeof(keys));
        counts -= keys <= bound;
      }
      for (std::size_t lane = 0; lane < P::width; ++lane) result += static_cast<std::size_t>(counts[lane]);
    }
#endif
    for (; i < count_; ++i) result += keys_[i] <= bound ? 1 : 0;
    return result;
  }
  /// Leaves the `limit` smallest, and perhaps a few more.
  void thin() {
    S inner = 0;
    S outer = worst_;
    if (!full_) {
      outer = 0;
      for (std::size_t i = 0; i < count_; ++i) outer = keys_[i] > outer ? keys_[i] : outer;
    }
    // Squared distances are spread over their range, so that halving it soon comes close.
    constexpr int steps = 8;
    for (int i = 0; i < steps; ++i) {
      const S middle = inner + (outer - inner) / 2;
      const bool is_enough = number_up_to(middle) >= limit_;
      outer = is_enough ? middle : outer;
      inner = is_enough ? inner : middle;
    }
    full_ = true;
    thin_at_ = room_;
    worst_ = outer;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      keys_[kept] = keys_[i];
      places_[kept] = places_[i];
      kept += static_cast<std::size_t>(keys_[i] <= outer);
    }
    count_ = kept;
    if (count_ > limit_ + limit_ / slack) thin_exactly();
  }
  void thin_exactly() {
    const auto items = std::make_unique_for_overwrite<Keyed<S>[]>(count_);
    for (std::size_t i = 0; i < count_; ++i) items[i] = {keys_[i], places_[i].leaf, places_[i].position};
    std::nth_element(items.get(), items.get() + (limit_ - 1), items.get() + count_, is_nearer);
    count_ = limit_;
    worst_ = items[limit_ - 1].key;
    for (std::size_t i = 0; i < count_; ++i) {
      keys_[i] = items[i].key;
      places_[i] = {items[i].leaf, items[i].position};
    }
  }
  static bool is_nearer(const Keyed<S>& a, const Keyed<S>& b) { return a.key < b.key; }

  [[nodiscard]] std::unique_ptr<Keyed<S>[]> sort_many() const {
    auto sorted = std::make_unique_for_overwrite<Keyed<S>[]>(count_);
    S greatest = 0;
    for (std::size_t i = 0; i < count_; ++i) greatest = keys_[i] > greatest ? keys_[i] : greatest;
    // As many buckets as items nearly sort them.
    const S scale = static_cast<S>(count_) / greatest;
    if (!(scale > 0 && scale <= std::numeric_limits<S>::max())) {
      for (std::size_t i = 0; i < count_; ++i) sorted[i] = {keys_[i], places_[i].leaf, places_[i].position};
      std::sort(sorted.get(), sorted.get() + count_, is_nearer);
      return sorted;
    }
    // First: where each bucket begins, then where it ends. The greatest has a bucket of its own.
    const auto ends = std::make_unique<std::uint32_t[]>(count_ + 2);
    const auto bucket_of = [&](S key) {
      const auto bucket = static_cast<std::size_t>(static_cast<std::int64_t>(key * scale));
      return bucket < count_ ? bucket : count_;
    };
    for (std::size_t i = 0; i < count_; ++i) ++ends[bucket_of(keys_[i]) + 1];
    for (std::size_t b = 1; b < count_ + 2; ++b) ends[b] += ends[b - 1];
    for (std::size_t i = 0; i < count_; ++i) {
      sorted[ends[bucket_of(keys_[i])]++] = {keys_[i], places_[i].leaf, places_[i].position};
    }
    constexpr std::uint32_t big = 8;
    std::uint32_t begin = 0;
    for (std::size_t b = 0; b <= count_; begin = ends[b++]) {
      if (ends[b] - begin > big) std::sort(sorted.get() + begin, sorted.get() + ends[b], is_nearer);
    }
    for (std::size_t i = 1; i < count_; ++i) {
      const Keyed<S> item = sorted[i];
      std::size_t at = i;
      for (; at > 0 && item.key < sorted[at - 1].key; --at) sorted[at] = sorted[at - 1];
      sorted[at] = item;
    }
    return sorted;
  }

  std::size_t limit_;
  bool is_few_;
  bool full_ = false;
  S worst_ = std::numeric_limits<S>::infinity();
  std::size_t count_ = 0;
  std::size_t worst_at_ = 0;
  S few_keys_[few];  ///< those that are not there are -1
  Place few_places_[few];
  std::size_t room_ = 0;
  std::size_t thin_at_ = 0;
  std::unique_ptr<S[]> keys_;
  std::unique_ptr<Place[]> places_;
};

}  // namespace spatial::detail

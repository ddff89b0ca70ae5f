/// @file
/// Where each element is: a slot names it while it moves from leaf to leaf, and a generation tells a handle
/// whether its element is still there. In: indices. Out: a leaf and a position. After a bulk load the first
/// ids have no slot: their leaves tell where they are (leaf.hpp), until something is inserted or moved.
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace spatial::detail {

/// A free slot has no leaf, and `position` is the next free one.
struct Slot {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t leaf = none;
  std::uint32_t position = none;
  std::uint32_t generation = 0;
};

template <class Allocator>
class SlotTable {
 public:
  static constexpr std::uint32_t none = Slot::none;

  explicit SlotTable(const Allocator& allocator) : slots_(allocator) {}

  /// How many ids have no slot: those below this.
  [[nodiscard]] std::uint32_t implied() const { return implied_; }
  /// @pre id >= implied()
  [[nodiscard]] const Slot& operator[](std::size_t id) const { return slots_[id - implied_]; }
  [[nodiscard]] Slot& operator[](std::size_t id) { return slots_[id - implied_]; }
  [[nodiscard]] std::size_t size() const { return implied_ + slots_.size(); }
  [[nodiscard]] std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

  /// For a table without slots: `count` ids, the first of which get none. The others are on no list.
  void begin(std::uint32_t count, std::uint32_t implied) {
    std::vector<Slot, Allocator> few(count - implied, fresh(), slots_.get_allocator());
    slots_.swap(few);  // leaves no room for others
    implied_ = implied;
  }
  /// Makes the slots of all ids, as of elements that are gone and on no list. @return how many are new
  std::uint32_t make_all() {
    std::vector<Slot, Allocator> all(slots_.get_allocator());
    all.reserve(size());
    all.resize(implied_, Slot{none, none, first_generation_ + 1});
    all.insert(all.end(), slots_.begin(), slots_.end());
    slots_.swap(all);
    return std::exchange(implied_, 0);
  }
  /// A slot that stays on the free list until release_taken(), so that a failure in between loses nothing.
  /// @pre all ids have slots, here and below
  std::uint32_t take() {
    if (free_ == none) {
      slots_.push_back(fresh());
      free_ = static_cast<std::uint32_t>(slots_.size() - 1);
    }
    return free_;
  }
  void release_taken(std::uint32_t id) { free_ = slots_[id].position; }
  /// Handles of the slot are stale from now on.
  void free(std::uint32_t id) {
    Slot& slot = (*this)[id];
    slot = {none, free_, slot.generation + 1};
    free_ = id;
  }
  /// Adds slots at the end, which are on no list.
  void grow(std::size_t count) { slots_.resize(slots_.size() + count, fresh()); }
  /// Puts those slots of [first, end) that have no leaf onto the free list.
  void free_unused(std::size_t first, std::size_t end) {
    for (std::size_t id = end; id-- > first;) {
      Slot& slot = (*this)[id];
      if (slot.leaf != none) continue;
      slot.position = free_;
      free_ = static_cast<std::uint32_t>(id);
    }
  }
  /// Forgets all. What comes later has generations that no handle of before has.
  void clear() noexcept {
    for (const Slot& slot : slots_) {
      if (slot.generation > first_generation_) first_generation_ = slot.generation;
    }
    ++first_generation_;
    slots_.clear();
    free_ = none;
    implied_ = 0;
  }
  void assign(const SlotTable& other) {
    slots_.assign(other.slots_.begin(), other.slots_.end());
    free_ = other.free_;
    implied_ = other.implied_;
    first_generation_ = other.first_generation_;
  }
  void swap(SlotTable& other) noexcept {
    slots_.swap(other.slots_);
    std::swap(free_, other.free_);
    std::swap(implied_, other.implied_);
    std::swap(first_generation_, other.first_generation_);
  }
  void take_over(SlotTable& other) noexcept {
    slots_ = std::move(other.slots_);
    other.slots_.clear();
    free_ = std::exchange(other.free_, none);
    implied_ = std::exchange(other.implied_, 0);
    first_generation_ = other.first_generation_;
  }

  [[nodiscard]] std::uint32_t generation(std::uint32_t id) const {
    return id < implied_ ? first_generation_ : (*this)[id].generation;
  }
  [[nodiscard]] Slot fresh() const { return {none, none, first_generation_}; }

 private:
  std::vector<Slot, Allocator> slots_;
  std::uint32_t free_ = none;
  std::uint32_t implied_ = 0;
  std::uint32_t first_generation_ = 0;  // of elements without a slot and of new slots
};

}  // namespace spatial::detail

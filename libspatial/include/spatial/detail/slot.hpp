/// @file
/// Where each element is: a slot names it while it moves from leaf to leaf, and a generation tells a handle
/// whether its element is still there. In: indices. Out: a leaf and a position.
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

  [[nodiscard]] const Slot& operator[](std::size_t id) const { return slots_[id]; }
  [[nodiscard]] Slot& operator[](std::size_t id) { return slots_[id]; }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }
  [[nodiscard]] bool is_alive(std::uint32_t id, std::uint32_t generation) const {
    return id < slots_.size() && slots_[id].leaf != none && slots_[id].generation == generation;
  }

  /// A slot that stays on the free list until release_taken(), so that a failure in between loses nothing.
  std::uint32_t take() {
    if (free_ == none) {
      slots_.push_back({});
      free_ = static_cast<std::uint32_t>(slots_.size() - 1);
    }
    return free_;
  }
  void release_taken(std::uint32_t id) { free_ = slots_[id].position; }
  /// Handles of the slot are stale from now on.
  void free(std::uint32_t id) {
    slots_[id] = {none, free_, slots_[id].generation + 1};
    free_ = id;
  }
  /// Adds slots at the end, which are on no list.
  void grow(std::size_t count) { slots_.resize(slots_.size() + count); }
  /// Puts those slots from `first` on that have no leaf onto the free list.
  void free_unused(std::size_t first) {
    for (std::size_t id = slots_.size(); id-- > first;) {
      if (slots_[id].leaf != none) continue;
      slots_[id].position = free_;
      free_ = static_cast<std::uint32_t>(id);
    }
  }
  /// Frees all. The slots stay, so that handles of before are known as stale.
  void free_all() noexcept {
    for (Slot& slot : slots_) {
      if (slot.leaf != none) ++slot.generation;
      slot.leaf = none;
    }
    free_ = none;
    free_unused(0);
  }
  void assign(const SlotTable& other) {
    slots_.assign(other.slots_.begin(), other.slots_.end());
    free_ = other.free_;
  }
  void swap(SlotTable& other) noexcept {
    slots_.swap(other.slots_);
    std::swap(free_, other.free_);
  }
  void take_over(SlotTable& other) noexcept {
    slots_ = std::move(other.slots_);
    other.slots_.clear();
    free_ = std::exchange(other.free_, none);
  }

 private:
  std::vector<Slot, Allocator> slots_;
  std::uint32_t free_ = none;
};

}  // namespace spatial::detail

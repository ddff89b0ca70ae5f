/// @file
/// The elements of one leaf (§5.1), packed: one row per lower and per upper coordinate, then the slot
/// indices, then the values, in one block of memory. A query tests a row with wide instructions and touches
/// the values of hits only. A leaf of points has each coordinate once: its upper rows are its lower rows.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "../box.hpp"

namespace spatial::detail {

/// Where a leaf's elements are. `count` of them are alive.
template <class Value, class T, std::size_t D>
struct Leaf {
  static constexpr std::uint32_t no_parent = 0xffffffffu;

  std::byte* data = nullptr;
  std::uint32_t count = 0;
  std::uint32_t capacity = 0;
  std::uint32_t parent = no_parent;  ///< node; the next free leaf while this one is free
  std::uint32_t loose = 0;           ///< erasures since the tight box was last computed from all elements
  std::uint8_t side = 0;             ///< which child of the parent
  bool indivisible = false;          ///< no split can separate what is here, unless the tight box grows
  std::uint8_t rows = 2 * D;         ///< D if all boxes here are points, and were when the block was made

  // Wide reads may run past a row's end: into the next row, or into this much after the last one.
  static constexpr std::size_t overread = 64;
  static constexpr std::size_t alignment = alignof(Value) > 16 ? alignof(Value) : 16;

  static constexpr std::size_t ids_offset(std::size_t cap, std::size_t row_count) {
    constexpr std::size_t step = alignof(std::uint32_t);  // rows of small integers may end between two
    return (row_count * cap * sizeof(T) + step - 1) / step * step;
  }
  static constexpr std::size_t values_offset(std::size_t cap, std::size_t row_count) {
    const std::size_t end = ids_offset(cap, row_count) + cap * sizeof(std::uint32_t);
    return (end + alignof(Value) - 1) / alignof(Value) * alignof(Value);
  }
  static constexpr std::size_t bytes(std::size_t cap, std::size_t row_count) {
    const std::size_t used = values_offset(cap, row_count) + cap * sizeof(Value);
    const std::size_t readable = ids_offset(cap, row_count) + overread;
    return ((used > readable ? used : readable) + alignment - 1) / alignment * alignment;
  }

  /// True if only boxes with min == max have room here.
  [[nodiscard]] bool is_flat() const { return rows == D; }
  [[nodiscard]] T* min_row(std::size_t axis) const { return reinterpret_cast<T*>(data) + axis * capacity; }
  [[nodiscard]] T* max_row(std::size_t axis) const { return min_row(rows - D + axis); }
  [[nodiscard]] std::uint32_t* ids() const {
    return reinterpret_cast<std::uint32_t*>(data + ids_offset(capacity, rows));
  }
  [[nodiscard]] Value* values() const {
    return reinterpret_cast<Value*>(data + values_offset(capacity, rows));
  }

  [[nodiscard]] Box<T, D> box(std::size_t at) const {
    Box<T, D> result;
    for (std::size_t a = 0; a < D; ++a) {
      result.min[a] = min_row(a)[at];
      result.max[a] = max_row(a)[at];
    }
    return result;
  }
  void set_box(std::size_t at, const Box<T, D>& box) {
    for (std::size_t a = 0; a < D; ++a) {
      min_row(a)[at] = box.min[a];
      max_row(a)[at] = box.max[a];
    }
  }
  [[nodiscard]] Box<T, D> bounds() const {
    Box<T, D> result;
    for (std::size_t a = 0; a < D; ++a) {
      const T* low = min_row(a);
      const T* high = max_row(a);
      T least = low[0];
      T greatest = high[0];
      for (std::size_t i = 1; i < count; ++i) {
        least = low[i] < least ? low[i] : least;
        greatest = high[i] > greatest ? high[i] : greatest;
      }
      result.min[a] = least;
      result.max[a] = greatest;
    }
    return result;
  }
};

/// Allocates and frees the blocks of leaves through the user's allocator.
template <class Value, class T, std::size_t D, class Allocator>
struct LeafMemory {
  using L = Leaf<Value, T, D>;
  struct alignas(L::alignment) Unit {
    std::byte bytes[L::alignment];
  };
  using UnitAllocator = typename std::allocator_traits<Allocator>::template rebind_alloc<Unit>;
  using Traits = std::allocator_traits<UnitAllocator>;

  static std::byte* allocate(const Allocator& allocator, std::size_t capacity, std::size_t rows) {
    UnitAllocator units(allocator);
    return reinterpret_cast<std::byte*>(
        std::to_address(Traits::allocate(units, L::bytes(capacity, rows) / L::alignment)));
  }
  static void free(const Allocator& allocator, const L& leaf) {
    if (leaf.data == nullptr) return;
    UnitAllocator units(allocator);
    Traits::deallocate(units, reinterpret_cast<Unit*>(leaf.data),
                       L::bytes(leaf.capacity, leaf.rows) / L::alignment);
  }
};

}  // namespace spatial::detail

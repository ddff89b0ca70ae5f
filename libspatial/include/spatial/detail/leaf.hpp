/// @file
/// The elements of one leaf (§5.1), packed in one block of memory: a frame and the levels of all boxes
/// (levels.hpp), which a query looks at first; then the boxes, the values, and the ids. A leaf of points has
/// each coordinate once; one that was loaded at once has no ids but consecutive ones, and a bit for each that
/// tells whether its element is still there.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "../box.hpp"
#include "cell.hpp"
#include "levels.hpp"

namespace spatial::detail {

/// Where a leaf's elements are. `count` of them are alive.
template <class Value, class T, std::size_t D>
struct Leaf {
  static constexpr std::uint32_t no_parent = 0xffffffffu;
  using FrameType = Frame<T, D>;

  std::byte* data = nullptr;
  std::uint32_t count = 0;
  std::uint32_t capacity = 0;
  std::uint32_t parent = no_parent;  ///< node; the next free leaf while this one is free
  std::uint32_t loose = 0;           ///< erasures since the tight box was last computed from all elements
  std::uint32_t beside = 0;          ///< boxes written since the frame was made that it does not hold
  std::uint32_t first = 0;           ///< without ids: the first element's id, also after the leaf is gone
  std::uint8_t side = 0;             ///< which child of the parent
  std::uint8_t frame_age = 0;        ///< splits since the frame was made
  bool indivisible = false;          ///< no split can separate what is here, unless the tight box grows
  std::uint8_t rows = 2 * D;         ///< D if all boxes here are points, and were when the block was made
  bool has_ids = true;

  static constexpr std::size_t alignment = alignof(Value) > 16 ? alignof(Value) : 16;
  static_assert(alignof(T) <= level_block);

  static constexpr std::size_t up_to(std::size_t offset, std::size_t step) {
    return (offset + step - 1) / step * step;
  }
  static constexpr std::size_t levels_offset() { return up_to(sizeof(FrameType), level_block); }
  static constexpr std::size_t values_offset(std::size_t cap, std::size_t row_count) {
    return up_to(levels_offset() + cap * row_count, alignof(Value));
  }
  static constexpr std::size_t boxes_offset(std::size_t cap, std::size_t row_count) {
    return up_to(values_offset(cap, row_count) + cap * sizeof(Value), alignof(T));
  }
  static constexpr std::size_t ids_offset(std::size_t cap, std::size_t row_count) {
    return up_to(boxes_offset(cap, row_count) + row_count * cap * sizeof(T), alignof(std::uint32_t));
  }
  /// Words of bits, in place of the ids.
  static constexpr std::uint32_t alive_words = 3;
  static constexpr std::uint32_t most_without_ids = 32 * alive_words;
  static constexpr std::size_t bytes(std::size_t cap, std::size_t row_count, bool with_ids) {
    const std::size_t end =
        ids_offset(cap, row_count) + (with_ids ? cap : alive_words) * sizeof(std::uint32_t);
    const std::size_t readable = levels_offset() + cap * row_count + level_block;
    return up_to(end > readable ? end : readable, alignment);
  }

  /// True if only boxes with min == max have room here.
  [[nodiscard]] bool is_flat() const { return rows == D; }
  [[nodiscard]] FrameType& frame() const { return *reinterpret_cast<FrameType*>(data); }
  [[nodiscard]] Level* levels(std::size_t begin) const {  ///< @pre begin is a multiple of level_block
    return reinterpret_cast<Level*>(data) + levels_offset() + begin * rows;
  }
  /// The levels of one element, level_stride() apart.
  [[nodiscard]] Level* level_column(std::size_t at) const {
    return levels(at / level_block * level_block) + at % level_block;
  }
  /// From one row of levels to the next, in the block of an element. The last block is as wide as it needs to
  /// be.
  static constexpr std::size_t level_stride(std::size_t at, std::size_t cap) {
    const std::size_t room = cap - at / level_block * level_block;
    return room < level_block ? room : level_block;
  }
  /// @pre has_ids; else the bits
  [[nodiscard]] std::uint32_t* ids() const {
    return reinterpret_cast<std::uint32_t*>(data + ids_offset(capacity, rows));
  }
  [[nodiscard]] std::uint32_t id(std::uint32_t at) const {
    if (has_ids) return ids()[at];
    const std::uint32_t* alive = ids();
    std::uint32_t word = 0;
    for (; at >= count_bits(alive[word]); ++word) at -= count_bits(alive[word]);
    std::uint32_t bits = alive[word];
    for (; at > 0; --at) bits &= bits - 1;
    return first + 32 * word + static_cast<std::uint32_t>(std::countr_zero(bits));
  }
  /// Where the element with this id is; `capacity` if it is not here. @pre !has_ids, id >= first
  [[nodiscard]] std::uint32_t position_of(std::uint32_t id) const {
    const std::uint32_t offset = id - first;
    if (data == nullptr || offset >= capacity) return capacity;
    const std::uint32_t* alive = ids();
    const std::uint32_t bit = 1u << (offset % 32);
    if ((alive[offset / 32] & bit) == 0) return capacity;
    std::uint32_t position = count_bits(alive[offset / 32] & (bit - 1));
    for (std::uint32_t word = 0; word < offset / 32; ++word) position += count_bits(alive[word]);
    return position;
  }
  /// All elements are there. @pre !has_ids
  void set_all_alive() {
    for (std::uint32_t word = 0; word < alive_words; ++word) {
      const std::uint32_t left = count > 32 * word ? count - 32 * word : 0;
      ids()[word] = left >= 32 ? 0xffffffffu : (1u << left) - 1;
    }
  }
  /// @pre !has_ids
  void set_gone(std::uint32_t id) { ids()[(id - first) / 32] &= ~(1u << (id - first) % 32); }
  static constexpr std::uint32_t count_bits(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::popcount(bits));
  }
  [[nodiscard]] Value* values() const {
    return reinterpret_cast<Value*>(data + values_offset(capacity, rows));
  }
  /// The lower coordinates of an element; its upper ones begin `rows - D` later.
  [[nodiscard]] T* coordinates(std::size_t at) const {
    return reinterpret_cast<T*>(data + boxes_offset(capacity, rows)) + at * rows;
  }

  /// The boxes alone, for loops.
  struct Boxes {
    const T* first;
    std::size_t rows;
    [[nodiscard]] const T* coordinates(std::size_t at) const { return first + at * rows; }
    [[nodiscard]] Side side(std::size_t at, const Split<T, D>& split) const {
      const T* low = coordinates(at) + split.axis;
      return side_of(*low, low[rows - D], split.plane);
    }
    [[nodiscard]] Box<T, D> operator[](std::size_t at) const {
      Box<T, D> result;
      const T* from = coordinates(at);
      const T* high = from + rows - D;
      for (std::size_t a = 0; a < D; ++a) {
        result.min[a] = from[a];
        result.max[a] = high[a];
      }
      return result;
    }
  };
  [[nodiscard]] Boxes boxes() const { return {coordinates(0), rows}; }
  [[nodiscard]] Box<T, D> box(std::size_t at) const { return boxes()[at]; }
  void set_frame(const FrameType& made) {
    ::new (static_cast<void*>(data)) FrameType(made);
    beside = 0;
    frame_age = 0;
  }
  void inherit_frame(const Leaf& from) {
    ::new (static_cast<void*>(data)) FrameType(from.frame());
    beside = from.beside;
    frame_age = static_cast<std::uint8_t>(from.frame_age + 1);
  }
  /// @pre the leaf has a frame; a flat leaf gets points
  void set_box(std::size_t at, const Box<T, D>& box) {
    T* to = coordinates(at);
    T* high = to + rows - D;
    for (std::size_t a = 0; a < D; ++a) {
      to[a] = box.min[a];
      high[a] = box.max[a];
    }
    set_levels(at, box);
  }
  void set_levels(std::size_t at, const Box<T, D>& box) {
    const LevelBounds<D> own = frame().bounds(box.min, box.max);
    const std::size_t stride = level_stride(at, capacity);
    Level* to = level_column(at);
    Level* high = to + (rows - D) * stride;
    bool is_beside = false;
    for (std::size_t a = 0; a < D; ++a) {
      to[a * stride] = own.low[a];
      high[a * stride] = own.high[a];
      is_beside |= own.low[a] == -128 || own.high[a] == 127;
    }
    beside += static_cast<std::uint32_t>(is_beside);
  }
  /// Element `to` gets the box of another one, and its levels.
  void copy_box(std::size_t from, std::size_t to) { Arrays(*this).copy_box(Arrays(*this), from, to); }
  /// The parts of the block, found once for loops.
  struct Arrays {
    Level* levels;
    T* coordinates;
    Value* values;
    std::uint32_t* ids;
    std::size_t rows;
    std::size_t capacity;
    explicit Arrays(const Leaf& leaf)
        : levels(leaf.levels(0)),
          coordinates(leaf.coordinates(0)),
          values(leaf.values()),
          ids(leaf.ids()),
          rows(leaf.rows),
          capacity(leaf.capacity) {}
    /// The levels are copied where there are as many rows, and mean something if the frame is the same.
    /// @pre there are as many rows, or those of the source are flat
    void copy_box(const Arrays& source, std::size_t from, std::size_t to) const {
      if (source.rows == rows) {
        rows == D ? copy_rows<D>(source, from, to) : copy_rows<2 * D>(source, from, to);
      } else {
        std::memcpy(coordinates + to * rows, source.coordinates + from * D, D * sizeof(T));
        std::memcpy(coordinates + to * rows + D, source.coordinates + from * D, D * sizeof(T));
      }
    }

   private:
    template <std::size_t N>
    void copy_rows(const Arrays& source, std::size_t from, std::size_t to) const {
      std::memcpy(coordinates + to * N, source.coordinates + from * N, N * sizeof(T));
      const Level* old = source.levels + from / level_block * level_block * N + from % level_block;
      Level* fresh = levels + to / level_block * level_block * N + to % level_block;
      const std::size_t old_stride = level_stride(from, source.capacity);
      const std::size_t stride = level_stride(to, capacity);
      for (std::size_t r = 0; r < N; ++r) fresh[r * stride] = old[r * old_stride];
    }
  };
  /// All boxes, levels and ids of another leaf; its frame, unless only this one has room for boxes.
  /// @pre there is room, and none here; this one has ids, or both have none
  void copy_all(const Leaf& from) {
    if (from.count == 0) return;
    inherit_frame(from);
    frame_age = from.frame_age;
    if (has_ids == from.has_ids) {
      std::memcpy(ids(), from.ids(), (has_ids ? from.count : alive_words) * sizeof(std::uint32_t));
    } else {
      for (std::uint32_t i = 0; i < from.count; ++i) ids()[i] = from.id(i);
    }
    if (rows == from.rows) {
      for (std::size_t at = 0; at < from.count; at += level_block) {
        const std::size_t old_stride = level_stride(at, from.capacity);
        const std::size_t stride = level_stride(at, capacity);
        for (std::size_t r = 0; r < rows; ++r) {
          std::memcpy(levels(at) + r * stride, from.levels(at) + r * old_stride,
                      old_stride < stride ? old_stride : stride);
        }
      }
      std::memcpy(coordinates(0), from.coordinates(0), from.count * rows * sizeof(T));
    } else {
      for (std::size_t i = 0; i < from.count; ++i) set_box(i, from.box(i));
    }
  }
  /// A frame that many boxes are beside lets too much through.
  [[nodiscard]] bool has_old_frame() const { return beside > count / 2 + 4; }
  void make_new_frame(const Box<T, D>& tight) {
    set_frame(FrameType::around(tight));
    const Boxes all = boxes();
    for (std::size_t i = 0; i < count; ++i) set_levels(i, all[i]);
    beside = 0;
  }

  /// The elements of [begin, begin + n) with min <= high and max >= low on every axis: with low, high =
  /// q.min, q.max those that touch q; with q.max, q.min those that cover it. @pre n <= level_bits
  template <class X>
  [[nodiscard]] Sieved reaching(std::uint32_t begin, std::uint32_t n, const X& low, const X& high) const {
    return reaching(begin, n, frame().bounds(low, high));
  }
  [[nodiscard]] Sieved reaching(std::uint32_t begin, std::uint32_t n, const LevelBounds<D>& q) const {
    return is_flat() ? sieve<D>(levels(begin), D, 0, 0, n, capacity - begin, q.high, q.low)
                     : sieve<D>(levels(begin), 2 * D, 0, D, n, capacity - begin, q.high, q.low);
  }
  /// Those with low <= min and max <= high.
  template <class X>
  [[nodiscard]] Sieved covered(std::uint32_t begin, std::uint32_t n, const X& low, const X& high) const {
    const LevelBounds<D> q = frame().bounds(low, high);
    return is_flat() ? sieve<D>(levels(begin), D, 0, 0, n, capacity - begin, q.high, q.low)
                     : sieve<D>(levels(begin), 2 * D, D, 0, n, capacity - begin, q.high, q.low);
  }
  /// The levels of one element.
  [[nodiscard]] LevelBounds<D> own_levels(std::size_t at) const {
    const std::size_t stride = level_stride(at, capacity);
    const Level* from = level_column(at);
    const Level* high = from + (rows - D) * stride;
    LevelBounds<D> result;
    for (std::size_t a = 0; a < D; ++a) {
      result.low[a] = from[a * stride];
      result.high[a] = high[a * stride];
    }
    return result;
  }

  [[nodiscard]] Box<T, D> bounds() const {
    const Boxes all = boxes();
    Box<T, D> result = all[0];
    for (std::size_t i = 1; i < count; ++i) extend(result, all[i]);
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

  static std::byte* allocate(const Allocator& allocator, std::size_t capacity, std::size_t rows,
                             bool with_ids) {
    UnitAllocator units(allocator);
    return reinterpret_cast<std::byte*>(
        std::to_address(Traits::allocate(units, L::bytes(capacity, rows, with_ids) / L::alignment)));
  }
  static void free(const Allocator& allocator, const L& leaf) {
    if (leaf.data == nullptr) return;
    UnitAllocator units(allocator);
    Traits::deallocate(units, reinterpret_cast<Unit*>(leaf.data),
                       L::bytes(leaf.capacity, leaf.rows, leaf.has_ids) / L::alignment);
  }
};

}  // namespace spatial::detail

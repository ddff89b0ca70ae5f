/// @file
/// An overview of a tree (§5.1) that was loaded at once: several levels of its nodes become one node here,
/// whose children have one byte for each coordinate (levels.hpp). So a query compares 16 of them at once,
/// gets to the leaves in few steps, and knows early where in memory they are. In: a tree. Out: for two bounds
/// per axis, the children that may lie between.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "../box.hpp"
#include "levels.hpp"
#include "node.hpp"

namespace spatial::detail {

/// A child of a node of an overview.
struct OverviewChild {
  std::uint32_t bits;   ///< of a ChildRef: a leaf of the tree, or a node of the overview by its place
  std::uint32_t block;  ///< where the leaf's block is, see Overview::block()
};

/// One node of an overview.
template <class T, std::size_t D>
struct OverviewNode {
  const Frame<T, D>* frame;
  Level* levels;
  OverviewChild* children;
  std::uint32_t count;

  /// The children with min <= high and max >= low on every axis, and perhaps more.
  template <class X>
  [[nodiscard]] std::uint64_t reaching(const X& low, const X& high) const {
    const LevelBounds<D> q = frame->bounds(low, high);
    return sieve<D>(levels, 2 * D, 0, D, count, count, q.high, q.low).maybe;
  }
  /// Those with low <= min and max <= high, and perhaps fewer.
  template <class X>
  [[nodiscard]] std::uint64_t covered(const X& low, const X& high) const {
    const LevelBounds<D> q = frame->bounds(low, high);
    return sieve<D>(levels, 2 * D, D, 0, count, count, q.high, q.low).sure;
  }
  /// Where the levels of a child are, and how far apart.
  [[nodiscard]] Level* level_column(std::uint32_t child, std::size_t& stride) const {
    const std::size_t block = child / level_block * level_block;
    stride = std::min<std::size_t>(count - block, level_block);
    return levels + block * 2 * D + child % level_block;
  }
  /// Whether a child may touch a box with these levels.
  [[nodiscard]] bool reaches(std::uint32_t child, const LevelBounds<D>& box) const {
    std::size_t stride = 0;
    const Level* const own = level_column(child, stride);
    bool result = true;
    for (std::size_t a = 0; a < D; ++a) {
      result &= own[a * stride] <= box.high[a] && box.low[a] <= own[(D + a) * stride];
    }
    return result;
  }
  /// Whether a box may lie in that of a child, as far as levels tell.
  [[nodiscard]] bool holds(std::uint32_t child, const Box<T, D>& box) const {
    std::size_t stride = 0;
    const Level* const own = level_column(child, stride);
    const LevelBounds<D> inner = frame->bounds(box.min, box.max);
    bool result = true;
    for (std::size_t a = 0; a < D; ++a) {
      result &= own[a * stride] <= inner.low[a] && inner.high[a] <= own[(D + a) * stride];
    }
    return result;
  }
};

/// It stays right while elements are only erased: boxes shrink and leaves become empty.
template <class T, std::size_t D, class Allocator>
class Overview {
 public:
  using NodeType = OverviewNode<T, D>;
  static constexpr std::uint32_t most_children = level_bits;

  explicit Overview(const Allocator& allocator) : units_(UnitAllocator(allocator)) {}

  [[nodiscard]] bool empty() const { return units_.empty(); }
  /// The root is at 0. @pre !empty()
  [[nodiscard]] NodeType node(std::uint32_t place) const {
    auto* at = const_cast<std::byte*>(units_[place].bytes);
    std::uint32_t count = 0;
    std::memcpy(&count, at + sizeof(Frame<T, D>), sizeof(count));
    return {reinterpret_cast<const Frame<T, D>*>(at), reinterpret_cast<Level*>(at + levels_offset),
            reinterpret_cast<OverviewChild*>(at + children_offset(count)), count};
  }
  /// Where the block of a leaf most likely is: good for nothing but a prefetch.
  [[nodiscard]] const std::byte* block(const OverviewChild& child) const {
    return blocks_ + std::size_t{child.block} * block_step;
  }
  [[nodiscard]] std::size_t bytes() const { return units_.capacity() * sizeof(Unit); }

  void clear() noexcept {
    if (units_.empty()) return;
    Units none(units_.get_allocator());
    units_.swap(none);
  }
  void swap(Overview& other) noexcept {
    units_.swap(other.units_);
    std::swap(blocks_, other.blocks_);
  }
  void take_over(Overview& other) noexcept {
    units_ = std::move(other.units_);
    other.units_.clear();
    blocks_ = other.blocks_;
  }
  /// That of a tree with other leaves at the same places.
  template <class Leaves>
  void assign(const Overview& other, const Leaves& leaves) {
    units_.assign(other.units_.begin(), other.units_.end());
    locate(leaves);
  }

  /// How many leaves with elements it leads to, each once and in boxes that hold it. O(n). @pre !empty()
  template <class Leaves>
  [[nodiscard]] std::size_t leaves_reached(const Leaves& leaves) const {
    std::vector<bool> seen(leaves.size(), false);
    std::vector<std::uint32_t> places{0};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const NodeType here = node(places[i]);
      for (std::uint32_t c = 0; c < here.count; ++c) {
        if (!ChildRef{here.children[c].bits}.is_leaf()) places.push_back(here.children[c].bits);
      }
    }
    std::size_t result = 0;
    std::vector<Box<T, D>> boxes(units_.size(), empty_box<T, D>());
    for (std::size_t i = places.size(); i-- > 0;) {
      const NodeType here = node(places[i]);
      for (std::uint32_t c = 0; c < here.count; ++c) {
        const ChildRef ref{here.children[c].bits};
        Box<T, D> box = ref.is_leaf() ? empty_box<T, D>() : boxes[ref.index()];
        if (ref.is_leaf() && leaves[ref.index()].count > 0) {
          box = leaves[ref.index()].bounds();
          result += here.holds(c, box) && !seen[ref.index()] ? 1 : 0;
          seen[ref.index()] = true;
        }
        if (is_valid(box) && here.holds(c, box)) extend(boxes[places[i]], box);
      }
    }
    return result;
  }

  /// Makes the overview of a tree, or none where it would not pay. @pre parents come before their children in
  /// `nodes`
  template <class Nodes, class Leaves>
  void build(const Nodes& nodes, const Leaves& leaves, ChildRef root) {
    clear();
    if (!root.is_node() || nodes.size() < least_nodes) return;
    std::vector<std::uint32_t> below(nodes.size(), 0);  // leaves
    for (std::size_t i = nodes.size(); i-- > 0;) {
      for (const ChildRef child : nodes[i].child) {
        if (!child.empty()) below[i] += child.is_leaf() ? 1 : below[child.index()];
      }
    }
    std::vector<Task> tasks{{root.index(), nowhere, 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      add_node(nodes, below, task, tasks);
    }
    units_.shrink_to_fit();
    locate(leaves);
  }

 private:
  struct alignas(64) Unit {
    std::byte bytes[64];
  };
  using UnitAllocator = typename std::allocator_traits<Allocator>::template rebind_alloc<Unit>;
  using Units = std::vector<Unit, UnitAllocator>;
  static constexpr std::size_t least_nodes = 8;
  static constexpr std::uint32_t nowhere = 0xffffffffu;
  static constexpr std::size_t block_step = 16;  // less than which no two blocks are apart
  // A node: its frame, the number of children, their levels as a leaf has them, the children.
  static constexpr std::size_t levels_offset =
      (sizeof(Frame<T, D>) + sizeof(std::uint32_t) + level_block - 1) / level_block * level_block;
  static constexpr std::size_t children_offset(std::size_t count) {
    return (levels_offset + count * 2 * D + alignof(OverviewChild) - 1) / alignof(OverviewChild) *
           alignof(OverviewChild);
  }
  static constexpr std::size_t units_for(std::size_t count) {
    const std::size_t end = children_offset(count) + count * sizeof(OverviewChild);
    const std::size_t readable = levels_offset + count * 2 * D + level_block;
    return (std::max(end, readable) + sizeof(Unit) - 1) / sizeof(Unit);
  }

  struct Task {
    std::uint32_t node, parent, child;  // a node of the tree; whose child it is in the overview
  };
  struct Child {
    ChildRef ref;
    std::uint32_t leaves;
    Box<T, D> box;
  };
  struct Children {
    std::uint32_t count = 0;
    Child items[most_children];

    template <class Nodes>
    void add_those_of(std::uint32_t index, const Nodes& nodes, const std::vector<std::uint32_t>& below) {
      for (std::size_t s = 0; s < 3; ++s) {
        const ChildRef ref = nodes[index].child[s];
        if (ref.empty()) continue;
        items[count++] = {ref, ref.is_leaf() ? 1 : below[ref.index()], nodes[index].child_box(s)};
      }
    }
    std::uint32_t take(std::uint32_t at) {
      const std::uint32_t index = items[at].ref.index();
      items[at] = items[--count];
      return index;
    }
    [[nodiscard]] bool has_room() const { return count + 2 <= most_children; }
  };

  /// Puts children of children in the place of children until there are enough.
  template <class Nodes>
  static Children children_of(std::uint32_t index, const Nodes& nodes,
                              const std::vector<std::uint32_t>& below) {
    Children result;
    result.add_those_of(index, nodes, below);
    // Nodes above leaves are filled first, since most are there.
    std::uint32_t enough = 1;
    for (std::uint64_t next = most_children; next < below[index]; next *= most_children / 2) {
      enough = static_cast<std::uint32_t>(next);
    }
    while (result.has_room()) {
      const auto most = std::max_element(result.items, result.items + result.count,
                                         [](const Child& a, const Child& b) { return a.leaves < b.leaves; });
      if (most->leaves <= enough) break;
      result.add_those_of(result.take(static_cast<std::uint32_t>(most - result.items)), nodes, below);
    }
    constexpr std::uint32_t few = 4;  // are not worth a node
    for (std::uint32_t i = 0; i < result.count && result.has_room();) {
      if (result.items[i].leaves > 1 && result.items[i].leaves <= few) {
        result.add_those_of(result.take(i), nodes, below);
      } else {
        ++i;
      }
    }
    // Where several may hold the nearest, the first one is looked at first: small ones tell most.
    std::sort(result.items, result.items + result.count,
              [](const Child& a, const Child& b) { return longest_side(a.box) < longest_side(b.box); });
    return result;
  }
  static DistanceOf<T> longest_side(const Box<T, D>& box) {
    DistanceOf<T> result = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const auto side = static_cast<DistanceOf<T>>(box.max[a]) - static_cast<DistanceOf<T>>(box.min[a]);
      result = side > result ? side : result;
    }
    return result;
  }

  template <class Nodes>
  void add_node(const Nodes& nodes, const std::vector<std::uint32_t>& below, const Task& task,
                std::vector<Task>& tasks) {
    const Children children = children_of(task.node, nodes, below);
    const std::uint32_t count = children.count;
    const auto place = static_cast<std::uint32_t>(units_.size());
    if (task.parent != nowhere) node(task.parent).children[task.child].bits = place;
    units_.resize(units_.size() + units_for(count));
    std::byte* const at = units_[place].bytes;
    ::new (static_cast<void*>(at)) Frame<T, D>(Frame<T, D>::around(nodes[task.node].bounds()));
    std::memcpy(at + sizeof(Frame<T, D>), &count, sizeof(count));
    const NodeType here = node(place);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Child& child = children.items[i];
      std::size_t stride = 0;
      Level* const levels = here.level_column(i, stride);
      const LevelBounds<D> own = here.frame->bounds(child.box.min, child.box.max);
      for (std::size_t a = 0; a < D; ++a) {
        levels[a * stride] = own.low[a];
        levels[(D + a) * stride] = own.high[a];
      }
      ::new (static_cast<void*>(here.children + i)) OverviewChild{child.ref.bits, 0};
      if (child.ref.is_node()) tasks.push_back({child.ref.index(), place, i});
    }
  }

  static std::uintptr_t address(const std::byte* block) { return reinterpret_cast<std::uintptr_t>(block); }

  /// Notes where the blocks of leaves are. A block that is too far from the others is not found.
  template <class Leaves>
  void locate(const Leaves& leaves) {
    blocks_ = nullptr;
    for (const auto& leaf : leaves) {
      if (leaf.data != nullptr && (blocks_ == nullptr || address(leaf.data) < address(blocks_)))
        blocks_ = leaf.data;
    }
    for (std::uint32_t place = 0; place < units_.size();) {
      const NodeType here = node(place);
      for (OverviewChild* child = here.children; child != here.children + here.count; ++child) {
        const ChildRef ref{child->bits};
        if (!ref.is_leaf() || leaves[ref.index()].data == nullptr) continue;
        const std::uintptr_t steps = (address(leaves[ref.index()].data) - address(blocks_)) / block_step;
        child->block = steps <= nowhere ? static_cast<std::uint32_t>(steps) : 0;
      }
      place += static_cast<std::uint32_t>(units_for(here.count));
    }
  }

  Units units_;
  const std::byte* blocks_ = nullptr;  ///< the block with the lowest address
};

}  // namespace spatial::detail

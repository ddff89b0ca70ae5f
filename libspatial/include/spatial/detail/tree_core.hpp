/// @file
/// The bounding box ternary tree itself (§5.1): flat arrays of nodes, leaves and slots, and the operations
/// that change them. In: boxes and values. Out: slots, which name the elements; the queries read the arrays
/// from their own files.
///
/// Beyond the paper, none of which changes the shape of the tree:
/// - each child has a tight box, by which queries prune;
/// - volumes that would have a single lower or higher child are left out (Node::compressed), and come back
/// when something
///   falls beside them;
/// - the root's volume doubles when something lies outside.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "build.hpp"
#include "cell.hpp"
#include "leaf.hpp"
#include "node.hpp"

namespace spatial::detail {

/// Where an element is. A free slot has no leaf, and `position` is the next free one.
struct Slot {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t leaf = none;
  std::uint32_t position = none;
  std::uint32_t generation = 0;
};

template <class Value, class T, std::size_t D, class Allocator>
class TreeCore {
 public:
  using Scalar = T;
  static constexpr std::size_t dimension = D;
  using BoxType = Box<T, D>;
  using NodeType = Node<T, D>;
  using LeafType = Leaf<Value, T, D>;
  using Memory = LeafMemory<Value, T, D, Allocator>;
  template <class X>
  using Rebound = typename std::allocator_traits<Allocator>::template rebind_alloc<X>;
  using AllocatorType = Allocator;
  using Nodes = std::vector<NodeType, Rebound<NodeType>>;
  using Leaves = std::vector<LeafType, Rebound<LeafType>>;
  static constexpr std::uint32_t none = 0xffffffffu;
  /// The soft limit of a leaf (§5.1). Measured with 48, 64, 96 and 128: levels make tests cheap, and fewer
  /// leaves make fewer nodes; beyond this the nearest search loses.
  static constexpr std::uint32_t leaf_limit = 96;
  static constexpr std::uint32_t least_capacity = level_block;  ///< of a leaf that is inserted into

  explicit TreeCore(const Allocator& allocator)
      : allocator_(allocator), nodes_(allocator), leaves_(allocator), slots_(allocator) {}
  TreeCore(const TreeCore&) = delete;
  TreeCore& operator=(const TreeCore&) = delete;
  ~TreeCore() { clear(); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Allocator& allocator() const { return allocator_; }
  [[nodiscard]] ChildRef root() const { return root_; }
  /// The tight box of everything; the empty box if there is nothing.
  [[nodiscard]] const BoxType& root_box() const { return root_box_; }
  [[nodiscard]] const NodeType& node(std::uint32_t index) const { return nodes_[index]; }
  [[nodiscard]] const LeafType& leaf(std::uint32_t index) const { return leaves_[index]; }
  [[nodiscard]] const Slot& slot(std::uint32_t index) const { return slots_[index]; }
  [[nodiscard]] std::size_t node_capacity() const { return nodes_.size(); }
  [[nodiscard]] std::size_t leaf_capacity() const { return leaves_.size(); }
  [[nodiscard]] std::size_t slot_capacity() const { return slots_.size(); }
  [[nodiscard]] bool is_alive(std::uint32_t slot_index, std::uint32_t generation) const {
    return slot_index < slots_.size() && slots_[slot_index].leaf != none &&
           slots_[slot_index].generation == generation;
  }
  [[nodiscard]] Value& value(std::uint32_t slot_index) const {
    const Slot& where = slots_[slot_index];
    return leaves_[where.leaf].values()[where.position];
  }
  [[nodiscard]] BoxType box(std::uint32_t slot_index) const {
    const Slot& where = slots_[slot_index];
    return leaves_[where.leaf].box(where.position);
  }

  /// Adds an element and returns its slot. @pre is_valid(box)
  std::uint32_t insert(const BoxType& box, Value&& value) {
    const std::uint32_t id = take_slot();
    const Slot place = make_room(box, id);
    ::new (static_cast<void*>(leaves_[place.leaf].values() + place.position)) Value(std::move(value));
    release_taken_slot(id);
    slots_[id].leaf = place.leaf;
    slots_[id].position = place.position;
    ++size_;
    return id;
  }

  /// Removes an element and returns its value. @pre the slot is alive
  Value erase(std::uint32_t id) {
    const Slot where = slots_[id];
    Value value(std::move(leaves_[where.leaf].values()[where.position]));
    remove_at(where);
    slots_[id] = {none, free_slot_, where.generation + 1};
    free_slot_ = id;
    --size_;
    return value;
  }

  /// Gives an element another box. @pre the slot is alive, is_valid(box)
  void move(std::uint32_t id, const BoxType& box) {
    const Slot where = slots_[id];
    LeafType& home = leaves_[where.leaf];
    const bool same_place =
        home.parent == LeafType::no_parent ||
        (nodes_[home.parent].cell.holds(box) && nodes_[home.parent].side_of(box) == home.side);
    // A leaf over the soft limit may have become divisible when its tight box grows; making room finds out.
    if (same_place && (home.count <= leaf_limit || encloses(link_box(home.parent, home.side), box))) {
      if (home.is_flat() && !is_point(box)) enlarge_leaf(where.leaf, home.capacity, 2 * D);
      if (home.has_old_frame()) home.make_new_frame(link_box(home.parent, home.side));
      const BoxType old = home.box(where.position);
      home.set_box(where.position, box);
      const BoxType tight = link_box(home.parent, home.side);
      extend_up(home.parent, home.side, box);
      if (!is_inside(tight, old)) shrink_leaf(where.leaf);
      return;
    }
    // First the new place, since only that can fail.
    const Slot place = make_room(box, id);
    const Slot old = slots_[id];  // making room may have moved it
    ::new (static_cast<void*>(leaves_[place.leaf].values() + place.position))
        Value(std::move(leaves_[old.leaf].values()[old.position]));
    slots_[id].leaf = place.leaf;
    slots_[id].position = place.position;
    remove_at(old);
  }

  /// Adds many elements: entries[i] is {box, slot_capacity() + i} and belongs to values[i]. Those whose box
  /// is not valid have been left out of `entries`, but not of `values`. The whole tree is built anew.
  template <class Values>
  void insert_all(std::vector<BuildEntry<T, D>>& entries, Values& values) {
    const std::size_t first_new = slots_.size();
    const std::size_t added = entries.size();
    entries.reserve(added + size_);
    for (std::uint32_t id = 0; id < first_new; ++id) {
      if (slots_[id].leaf != none) entries.push_back({box(id), id});
    }
    Build<TreeCore> fresh(allocator_);
    fresh.run(entries);
    slots_.resize(first_new + values.size());
    // From here on nothing fails.
    for (std::uint32_t l = 0; l < fresh.leaves.size(); ++l) {
      LeafType& home = fresh.leaves[l];
      for (std::uint32_t i = 0; i < home.count; ++i) {
        const std::uint32_t id = home.ids()[i];
        Value& from = id < first_new ? value(id) : values[id - first_new];
        ::new (static_cast<void*>(home.values() + i)) Value(std::move(from));
        if (id >= first_new) {
          slots_[id].leaf = l;
          slots_[id].position = i;
        }
      }
    }
    // Old slots are redirected only after all old values have been read through them.
    for (std::uint32_t l = 0; l < fresh.leaves.size() && first_new > 0; ++l) {
      const LeafType& home = fresh.leaves[l];
      for (std::uint32_t i = 0; i < home.count; ++i) {
        slots_[home.ids()[i]].leaf = l;
        slots_[home.ids()[i]].position = i;
      }
    }
    for (LeafType& each : leaves_) release_leaf_memory(each);
    leaves_.clear();
    nodes_.swap(fresh.nodes);
    leaves_.swap(fresh.leaves);
    root_ = fresh.root;
    root_box_ = fresh.root_box;
    free_node_ = free_leaf_ = none;
    any_loose_ = false;
    for (std::size_t id = slots_.size(); id-- > first_new;) {
      if (slots_[id].leaf != none) continue;
      slots_[id].position = free_slot_;
      free_slot_ = static_cast<std::uint32_t>(id);
    }
    size_ += added;
  }

  /// Takes over the shape, the slots and the boxes of another tree, and makes each value by `make(Value&)`.
  /// @pre this tree is empty and new
  template <class Other, class Make>
  void assign_from(Other& other, Make&& make) {
    nodes_.assign(other.nodes_.begin(), other.nodes_.end());
    slots_.assign(other.slots_.begin(), other.slots_.end());
    leaves_.resize(other.leaves_.size());
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const LeafType& from = other.leaves_[l];
      LeafType& to = leaves_[l];
      to.parent = from.parent;
      if (from.data == nullptr) continue;
      to.side = from.side;
      to.loose = from.loose;
      to.indivisible = from.indivisible;
      to.rows = from.rows;
      to.data = Memory::allocate(allocator_, from.capacity, from.rows);
      to.capacity = from.capacity;
      to.copy_all(from);
      for (std::uint32_t i = 0; i < from.count; ++i, ++to.count) {
        ::new (static_cast<void*>(to.values() + i)) Value(make(from.values()[i]));
      }
    }
    free_node_ = other.free_node_;
    free_leaf_ = other.free_leaf_;
    free_slot_ = other.free_slot_;
    root_ = other.root_;
    root_box_ = other.root_box_;
    size_ = other.size_;
    any_loose_ = other.any_loose_;
  }

  void clear() noexcept {
    for (LeafType& each : leaves_) release_leaf_memory(each);
    nodes_.clear();
    leaves_.clear();
    free_node_ = free_leaf_ = none;
    free_slot_ = none;
    // The slots stay, so that handles of before are known as stale.
    for (std::size_t i = slots_.size(); i-- > 0;) {
      if (slots_[i].leaf != none) ++slots_[i].generation;
      slots_[i].leaf = none;
      slots_[i].position = free_slot_;
      free_slot_ = static_cast<std::uint32_t>(i);
    }
    root_ = {};
    root_box_ = empty_box<T, D>();
    size_ = 0;
    any_loose_ = false;
  }

  void swap(TreeCore& other) noexcept {
    using std::swap;
    if constexpr (std::allocator_traits<Allocator>::propagate_on_container_swap::value) {
      swap(allocator_, other.allocator_);
    }
    nodes_.swap(other.nodes_);
    leaves_.swap(other.leaves_);
    slots_.swap(other.slots_);
    swap(free_node_, other.free_node_);
    swap(free_leaf_, other.free_leaf_);
    swap(free_slot_, other.free_slot_);
    swap(root_, other.root_);
    swap(root_box_, other.root_box_);
    swap(size_, other.size_);
    swap(any_loose_, other.any_loose_);
  }

  /// Takes over everything of another tree. @pre the allocators are equal, or propagate on move assignment
  void replace_by(TreeCore& other) noexcept {
    clear();
    if constexpr (std::allocator_traits<Allocator>::propagate_on_container_move_assignment::value) {
      allocator_ = other.allocator_;
    }
    nodes_ = std::move(other.nodes_);
    leaves_ = std::move(other.leaves_);
    slots_ = std::move(other.slots_);
    free_node_ = other.free_node_;
    free_leaf_ = other.free_leaf_;
    free_slot_ = other.free_slot_;
    root_ = other.root_;
    root_box_ = other.root_box_;
    size_ = other.size_;
    any_loose_ = other.any_loose_;
    other.leaves_.clear();
    other.nodes_.clear();
    other.slots_.clear();
    other.free_slot_ = none;
    other.clear();
  }

  /// The exact bounds: root_box(), unless big leaves have put off the recomputation of theirs.
  [[nodiscard]] BoxType bounds() const {
    if (!any_loose_) return root_box_;
    BoxType result = empty_box<T, D>();
    std::vector<ChildRef> stack;
    if (!root_.empty()) stack.push_back(root_);
    while (!stack.empty()) {
      const ChildRef here = stack.back();
      stack.pop_back();
      if (here.is_leaf()) {
        extend(result, leaves_[here.index()].bounds());
        continue;
      }
      const NodeType& each = nodes_[here.index()];
      for (std::size_t s = 0; s < 3; ++s) {
        if (!each.child[s].empty() && !encloses(result, each.child_box(s))) stack.push_back(each.child[s]);
      }
    }
    return result;
  }

  /// Bytes of the tables, used and reserved, without the leaves' blocks.
  [[nodiscard]] std::size_t table_bytes() const {
    return nodes_.capacity() * sizeof(NodeType) + leaves_.capacity() * sizeof(LeafType) +
           slots_.capacity() * sizeof(Slot);
  }

  /// The volume of what hangs at this link. @pre the parent is a node
  [[nodiscard]] Cell<T, D> link_cell(std::uint32_t parent, std::uint32_t side) const {
    const NodeType& above = nodes_[parent];
    return above.cell.child(above.split(), static_cast<Side>(side));
  }

 private:
  ChildRef& link(std::uint32_t parent, std::uint32_t side) {
    return parent == none ? root_ : nodes_[parent].child[side];
  }
  [[nodiscard]] BoxType link_box(std::uint32_t parent, std::uint32_t side) const {
    return parent == none ? root_box_ : nodes_[parent].child_box(side);
  }
  void set_link_box(std::uint32_t parent, std::uint32_t side, const BoxType& box) {
    if (parent == none) {
      root_box_ = box;
    } else {
      nodes_[parent].set_child_box(side, box);
    }
  }

  // --- slots, nodes and leaves as numbered objects ---

  // The slot is on the free list until release_taken_slot, so that a failure in between loses nothing.
  std::uint32_t take_slot() {
    if (free_slot_ == none) {
      slots_.push_back({none, none, 0});
      free_slot_ = static_cast<std::uint32_t>(slots_.size() - 1);
    }
    return free_slot_;
  }
  void release_taken_slot(std::uint32_t id) { free_slot_ = slots_[id].position; }

  std::uint32_t new_node() {
    if (free_node_ == none) {
      nodes_.push_back({});
      return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    const std::uint32_t index = free_node_;
    free_node_ = nodes_[index].parent;
    nodes_[index] = NodeType{};
    return index;
  }
  void free_node(std::uint32_t index) {
    nodes_[index].parent = free_node_;
    free_node_ = index;
  }
  std::uint32_t new_leaf(std::uint32_t capacity, std::uint8_t rows) {
    if (free_leaf_ == none) {
      leaves_.push_back({});
      leaves_.back().parent = none;
      free_leaf_ = static_cast<std::uint32_t>(leaves_.size() - 1);
    }
    std::byte* data = Memory::allocate(allocator_, capacity, rows);
    const std::uint32_t index = free_leaf_;
    free_leaf_ = leaves_[index].parent;
    leaves_[index] = LeafType{};
    leaves_[index].data = data;
    leaves_[index].capacity = capacity;
    leaves_[index].rows = rows;
    return index;
  }
  void release_leaf_memory(LeafType& which) noexcept {
    for (std::uint32_t i = 0; i < which.count; ++i) which.values()[i].~Value();
    Memory::free(allocator_, which);
    which = LeafType{};
  }
  void free_leaf(std::uint32_t index) {
    release_leaf_memory(leaves_[index]);
    leaves_[index].parent = free_leaf_;
    free_leaf_ = index;
  }
  static std::uint32_t capacity_for(std::uint32_t count) {
    if (count > leaf_limit) return count + count / 2;
    std::uint32_t capacity = least_capacity;
    while (capacity < count) capacity *= 2;
    return capacity < leaf_limit ? capacity : leaf_limit;
  }

  // Moves the element from one leaf to the end of another, and tells its slot.
  void move_element(LeafType& from, std::uint32_t at, std::uint32_t to_index, bool same_frame) {
    LeafType& to = leaves_[to_index];
    const std::uint32_t end = to.count++;
    if (same_frame) {
      to.copy_box(from, at, end);
    } else {
      to.set_box(end, from.box(at));
    }
    const std::uint32_t id = from.ids()[at];
    to.ids()[end] = id;
    Value& value = from.values()[at];
    ::new (static_cast<void*>(to.values() + end)) Value(std::move(value));
    value.~Value();  // NOLINT(bugprone-use-after-move): what was moved from is destroyed
    slots_[id].leaf = to_index;
    slots_[id].position = end;
  }

  void enlarge_leaf(std::uint32_t index, std::uint32_t capacity, std::uint8_t rows) {
    LeafType bigger = leaves_[index];
    bigger.capacity = capacity;
    bigger.rows = rows;
    bigger.data = Memory::allocate(allocator_, capacity, rows);
    LeafType& old = leaves_[index];
    bigger.copy_all(old);
    Value* from = old.values();
    Value* to = bigger.values();
    for (std::uint32_t i = 0; i < old.count; ++i) {
      ::new (static_cast<void*>(to + i)) Value(std::move(from[i]));
      from[i].~Value();
    }
    Memory::free(allocator_, old);
    old = bigger;
  }

  // --- insertion ---

  // Finds or makes the place for a box and enters it there with its slot index. The value is still missing.
  Slot make_room(const BoxType& box, std::uint32_t id) {
    std::uint32_t parent = none;
    std::uint32_t side = 0;
    ChildRef here = root_;
    if (here.is_node() && !nodes_[here.index()].cell.holds(box)) return append_above(here.index(), box, id);
    for (;;) {
      if (!here.is_node()) {
        if (here.empty()) return append(attach_new_leaf(parent, side, box), box, id);
        const std::uint32_t index = here.index();
        const LeafType& there = leaves_[index];
        if (there.count < leaf_limit || (there.indivisible && encloses(link_box(parent, side), box)) ||
            !split_leaf(index, box)) {
          return append(index, box, id);
        }
        here = link(parent, side);
        continue;
      }
      const NodeType& node = nodes_[here.bits];
      if (node.compressed && !node.cell.holds(box)) return append_above(here.bits, box, id);
      parent = here.bits;
      // Branches: half of the guesses are wrong, but a right one starts on the next node at once.
      if (box.max[node.axis] <= node.plane) {
        side = lower;
        here = node.child[lower];
      } else if (box.min[node.axis] >= node.plane) {
        side = higher;
        here = node.child[higher];
      } else {
        side = centric;
        here = node.child[centric];
      }
    }
  }

  // The same for a box that is outside of the volume of a node.
  Slot append_above(std::uint32_t node, const BoxType& box, std::uint32_t id) {
    const std::uint32_t above = insert_node_above(node, box);
    return append(attach_new_leaf(above, nodes_[above].side_of(box), box), box, id);
  }

  Slot append(std::uint32_t index, const BoxType& box, std::uint32_t id) {
    LeafType& target = leaves_[index];
    const bool widen = target.is_flat() && !is_point(box);
    if (target.count == target.capacity || widen) {
      enlarge_leaf(index, target.count == target.capacity ? capacity_for(target.count + 1) : target.capacity,
                   widen ? 2 * D : target.rows);
    }
    if (target.has_old_frame()) target.make_new_frame(link_box(target.parent, target.side));
    const std::uint32_t end = target.count++;
    target.set_box(end, box);
    target.ids()[end] = id;
    extend_up(target.parent, target.side, box);
    return {index, end, 0};
  }

  std::uint32_t attach_new_leaf(std::uint32_t parent, std::uint32_t side, const BoxType& box) {
    const std::uint32_t index = new_leaf(least_capacity, is_point(box) ? D : 2 * D);
    BoxType room = box;  // likely to hold what will come
    if (parent != none) extend_by_cell(room, link_cell(parent, side));
    leaves_[index].set_frame(Frame<T, D>::around(room));
    attach_leaf(index, parent, side);
    return index;
  }
  static void extend_by_cell(BoxType& box, const Cell<T, D>& cell) {
    for (std::size_t a = 0; a < D; ++a) {
      if (!cell.is_divisible(a)) continue;
      box.min[a] = cell.box.min[a] < box.min[a] ? cell.box.min[a] : box.min[a];
      box.max[a] = cell.box.max[a] > box.max[a] ? cell.box.max[a] : box.max[a];
    }
  }
  void attach_leaf(std::uint32_t index, std::uint32_t parent, std::uint32_t side) {
    leaves_[index].parent = parent;
    leaves_[index].side = static_cast<std::uint8_t>(side);
    link(parent, side) = ChildRef::leaf(index);
  }
  void attach_node(std::uint32_t index, std::uint32_t parent, std::uint32_t side) {
    nodes_[index].parent = parent;
    nodes_[index].side = static_cast<std::uint8_t>(side);
    link(parent, side) = ChildRef::node(index);
  }

  void extend_up(std::uint32_t parent, std::uint32_t side, const BoxType& box) {
    for (;;) {
      BoxType tight = link_box(parent, side);
      if (encloses(tight, box)) return;
      extend(tight, box);
      set_link_box(parent, side, tight);
      if (parent == none) return;
      side = nodes_[parent].side;
      parent = nodes_[parent].parent;
    }
  }

  // Puts a node between `below` and its parent, so that `box`, which is outside of the volume of `below`, has
  // a place.
  std::uint32_t insert_node_above(std::uint32_t below, const BoxType& box) {
    const std::uint32_t parent = nodes_[below].parent;
    const std::uint32_t parent_side = nodes_[below].side;
    const std::uint32_t above = new_node();
    const Cell<T, D> inner = nodes_[below].cell;
    NodeType& fresh = nodes_[above];
    Side below_side = lower;
    Split<T, D> at;
    bool compressed = false;
    Cell<T, D> cell = inner;
    if (parent == none) {
      at = cell.grow_to_hold(box, below_side);
    } else {
      cell = link_cell(parent, parent_side);
      at = separate(cell, inner, box, below_side, compressed);
    }
    fresh.cell = cell;
    fresh.plane = at.plane;
    fresh.axis = static_cast<std::uint8_t>(at.axis);
    fresh.compressed = compressed;
    const BoxType tight = link_box(parent, parent_side);
    attach_node(above, parent, parent_side);
    for (std::size_t s = 0; s < NodeType::lanes; ++s) fresh.set_child_box(s, empty_box<T, D>());
    fresh.set_child_box(below_side, tight);
    attach_node(below, above, below_side);
    const Cell<T, D> full = cell.child(at, below_side);
    nodes_[below].compressed = !(full.box == inner.box && full.divisible == inner.divisible);
    return above;
  }

  // Halves `cell` until a plane lies between `inner`, which is one of its parts, and `box`.
  static Split<T, D> separate(Cell<T, D>& cell, const Cell<T, D>& inner, const BoxType& box, Side& inner_side,
                              bool& compressed) {
    for (;;) {
      const Split<T, D> at = cell.split();
      if (!at.exists()) break;
      inner_side = side_of(inner.box.min[at.axis], inner.box.max[at.axis], at.plane);
      if (inner_side == centric) break;
      if (side_of(box.min[at.axis], box.max[at.axis], at.plane) != inner_side) return at;
      cell = cell.child(at, inner_side);
      compressed = true;
    }
    // Where the root grew with rounding, the halves do not meet the old planes to the bit. Then a border will
    // do.
    for (std::size_t a = 0; a < D; ++a) {
      if (!cell.is_divisible(a)) continue;
      inner_side = higher;
      if (side_of(box.min[a], box.max[a], inner.box.min[a]) != higher) return {a, inner.box.min[a]};
      inner_side = lower;
      if (side_of(box.min[a], box.max[a], inner.box.max[a]) != lower) return {a, inner.box.max[a]};
    }
    return {0, inner.box.min[0]};  // not reached: the box is outside of the inner cell
  }

  // Distributes a leaf's elements among three new leaves (§5.1, figure 7), so that `incoming` finds a place
  // too. False if no plane can separate them.
  bool split_leaf(std::uint32_t index, const BoxType& incoming) {
    const std::uint32_t parent = leaves_[index].parent;
    const std::uint32_t side = leaves_[index].side;
    if (leaves_[index].loose > 0) tighten_leaf(index);
    BoxType tight = link_box(parent, side);
    extend(tight, incoming);
    Cell<T, D> cell = parent == none ? Cell<T, D>::cube_around(tight) : link_cell(parent, side);
    bool compressed = false;
    Split<T, D> at;
    for (;;) {
      at = cell.split();
      if (!at.exists()) {
        leaves_[index].indivisible = true;
        return false;
      }
      const Side all = side_of(tight.min[at.axis], tight.max[at.axis], at.plane);
      if (all == centric) break;
      cell = cell.child(at, all);
      compressed = true;
    }
    std::uint32_t counts[3] = {0, 0, 0};
    BoxType bounds[3] = {empty_box<T, D>(), empty_box<T, D>(), empty_box<T, D>()};
    const auto boxes = leaves_[index].boxes();
    for (std::uint32_t i = 0; i < leaves_[index].count; ++i) {
      const BoxType box = boxes[i];
      const Side to = side_of(box.min[at.axis], box.max[at.axis], at.plane);
      ++counts[to];
      extend(bounds[to], box);
    }
    // Half of a volume may do with half of the levels, once on each axis.
    const bool same_frame = leaves_[index].frame_age < D && !leaves_[index].has_old_frame();
    const std::uint32_t made = new_node();
    // The new leaves hang at the node before the old one is touched, so that a failing allocation loses
    // nothing.
    std::uint32_t leaves[3] = {none, none, none};
    Undo undo{this, made, leaves};
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (counts[s] == 0) continue;
      leaves[s] = new_leaf(capacity_for(counts[s]), leaves_[index].rows);
      if (!same_frame) leaves_[leaves[s]].set_frame(Frame<T, D>::around(bounds[s]));
      if (same_frame) leaves_[leaves[s]].inherit_frame(leaves_[index]);
    }
    undo.core = nullptr;
    NodeType& node = nodes_[made];
    node.cell = cell;
    node.plane = at.plane;
    node.axis = static_cast<std::uint8_t>(at.axis);
    node.compressed = compressed;
    for (std::size_t s = 0; s < NodeType::lanes; ++s) node.set_child_box(s, empty_box<T, D>());
    LeafType& old = leaves_[index];
    for (std::uint32_t i = 0; i < old.count; ++i) {
      const BoxType box = boxes[i];
      move_element(old, i, leaves[side_of(box.min[at.axis], box.max[at.axis], at.plane)], same_frame);
    }
    old.count = 0;
    free_leaf(index);
    attach_node(made, parent, side);
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (leaves[s] == none) continue;
      attach_leaf(leaves[s], made, s);
      node.set_child_box(s, bounds[s]);
    }
    // What is still over the limit was indivisible before `incoming` came, so this goes no deeper.
    for (std::uint32_t s = 0; s < 3; ++s) {
      if (counts[s] > leaf_limit) split_leaf(leaves[s], leaves_[leaves[s]].box(0));
    }
    return true;
  }

  // Takes back a node and leaves that were made for a split that failed.
  struct Undo {
    TreeCore* core;
    std::uint32_t node;
    const std::uint32_t* leaves;
    ~Undo() {
      if (core == nullptr) return;
      for (int s = 0; s < 3; ++s) {
        if (leaves[s] != none) core->free_leaf(leaves[s]);
      }
      core->free_node(node);
    }
  };

  // --- removal ---

  // True if `inner` touches no side of `outer`, so that taking it away leaves `outer` tight.
  static bool is_inside(const BoxType& outer, const BoxType& inner) {
    bool result = true;
    for (std::size_t a = 0; a < D; ++a) {
      result &= outer.min[a] < inner.min[a] && inner.max[a] < outer.max[a];
    }
    return result;
  }

  // Removes what is at `where`. Its value has been moved away but not destroyed. Slots of others are kept
  // right.
  void remove_at(const Slot& where) {
    LeafType& home = leaves_[where.leaf];
    const BoxType removed = home.box(where.position);
    const std::uint32_t last = home.count - 1;
    Value* values = home.values();
    if (where.position != last) {
      home.copy_box(home, last, where.position);
      const std::uint32_t moved = home.ids()[last];
      home.ids()[where.position] = moved;
      slots_[moved].position = where.position;
      values[where.position].~Value();
      ::new (static_cast<void*>(values + where.position)) Value(std::move(values[last]));
    }
    values[last].~Value();
    home.count = last;
    const std::uint32_t parent = home.parent;
    if (last == 0) {
      const std::uint32_t side = home.side;
      link(parent, side) = {};
      set_link_box(parent, side, empty_box<T, D>());
      free_leaf(where.leaf);
      if (parent != none) {
        tighten_up(nodes_[parent].parent, nodes_[parent].side);
        simplify(parent);
      }
      return;
    }
    const BoxType tight = link_box(parent, home.side);
    if (!is_inside(tight, removed)) shrink_leaf(where.leaf);
    if (parent != none && last <= leaf_limit / 4) simplify(parent);
  }

  // Makes the tight box of a leaf exact. A big leaf is looked through only after many erasures, so that
  // emptying it costs no more than filling it; until then its box is too large, which costs a query time but
  // no result.
  void shrink_leaf(std::uint32_t index) {
    LeafType& home = leaves_[index];
    if (home.count > 4 * leaf_limit && ++home.loose < home.count / 4) {
      any_loose_ = true;
      return;
    }
    tighten_leaf(index);
  }
  void tighten_leaf(std::uint32_t index) {
    LeafType& home = leaves_[index];
    home.loose = 0;
    set_link_box(home.parent, home.side, home.bounds());
    if (home.parent != none) tighten_up(nodes_[home.parent].parent, nodes_[home.parent].side);
  }

  // Recomputes the box at this link from the node's children, and so on upwards.
  void tighten_up(std::uint32_t parent, std::uint32_t side) {
    for (;;) {
      const ChildRef here = link(parent, side);
      const BoxType tight = nodes_[here.index()].bounds();
      if (tight == link_box(parent, side)) return;
      set_link_box(parent, side, tight);
      if (parent == none) return;
      side = nodes_[parent].side;
      parent = nodes_[parent].parent;
    }
  }

  // Removes nodes that are not needed any more: without children, with one child, or with few elements in
  // leaves.
  void simplify(std::uint32_t index) {
    while (index != none) {
      NodeType& node = nodes_[index];
      const std::uint32_t parent = node.parent;
      const std::uint32_t side = node.side;
      int children = 0;
      std::uint32_t only = 0;
      std::uint32_t total = 0;
      bool leaves_only = true;
      for (std::uint32_t s = 0; s < 3; ++s) {
        if (node.child[s].empty()) continue;
        ++children;
        only = s;
        if (node.child[s].is_leaf()) {
          total += leaves_[node.child[s].index()].count;
        } else {
          leaves_only = false;
        }
      }
      if (children == 0) {
        link(parent, side) = {};
        set_link_box(parent, side, empty_box<T, D>());
        free_node(index);
        if (parent != none) tighten_up(nodes_[parent].parent, nodes_[parent].side);
      } else if (children == 1 && (only != centric || (node.child[only].is_leaf() && total <= leaf_limit))) {
        const ChildRef child = node.child[only];
        if (child.is_leaf()) {
          attach_leaf(child.index(), parent, side);
        } else {
          attach_node(child.index(), parent, side);
          nodes_[child.index()].compressed = true;
        }
        free_node(index);
      } else if (leaves_only && total <= leaf_limit / 2 && merge_into_first(index)) {
        free_node(index);
      } else {
        return;
      }
      index = parent;
    }
  }

  // Moves everything below a node of leaves into the first leaf that has the capacity. No allocation: erasing
  // must not fail.
  bool merge_into_first(std::uint32_t index) {
    NodeType& node = nodes_[index];
    std::uint32_t total = 0;
    std::uint32_t target = none;
    bool flat = true;
    for (const ChildRef child : node.child) {
      if (child.empty()) continue;
      total += leaves_[child.index()].count;
      flat &= leaves_[child.index()].is_flat();
    }
    for (const ChildRef child : node.child) {
      if (child.empty()) continue;
      const LeafType& leaf = leaves_[child.index()];
      if (leaf.capacity >= total && leaf.is_flat() == flat) target = child.index();
    }
    if (target == none) return false;
    for (const ChildRef child : node.child) {
      if (child.empty() || child.index() == target) continue;
      LeafType& from = leaves_[child.index()];
      for (std::uint32_t i = 0; i < from.count; ++i) move_element(from, i, target, false);
      from.count = 0;
      free_leaf(child.index());
    }
    leaves_[target].indivisible = false;
    leaves_[target].loose = 0;
    leaves_[target].make_new_frame(leaves_[target].bounds());
    attach_leaf(target, node.parent, node.side);
    return true;
  }

  [[no_unique_address]] Allocator allocator_;
  Nodes nodes_;
  Leaves leaves_;
  std::vector<Slot, Rebound<Slot>> slots_;
  std::uint32_t free_node_ = none;
  std::uint32_t free_leaf_ = none;
  std::uint32_t free_slot_ = none;
  ChildRef root_;
  BoxType root_box_ = empty_box<T, D>();
  std::size_t size_ = 0;
  bool any_loose_ = false;
};

}  // namespace spatial::detail

/// @file
/// What a tree (§5.1) is made of: flat arrays of nodes, leaves and slots, the root, and lists of what is free
/// in each array. In: indices. Out: nodes, leaves and slots; the rules of the tree are in the files of the
/// operations.
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
#include "overview.hpp"
#include "slot.hpp"

namespace spatial::detail {

template <class Value, class T, std::size_t D, class Allocator>
class TreeStorage {
 public:
  using Scalar = T;
  using ValueType = Value;
  static constexpr std::size_t dimension = D;
  using BoxType = Box<T, D>;
  using NodeType = Node<T, D>;
  using FrameType = Frame<T, D>;
  using LeafType = Leaf<Value, T, D>;
  using Arrays = typename LeafType::Arrays;
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
  static_assert(leaf_limit <= LeafType::most_without_ids);
  static constexpr std::uint32_t least_capacity = level_block;  ///< of a leaf that is inserted into

  explicit TreeStorage(const Allocator& a) : allocator_(a), nodes_(a), leaves_(a), slots_(a), overview_(a) {}
  TreeStorage(const TreeStorage&) = delete;
  TreeStorage& operator=(const TreeStorage&) = delete;
  ~TreeStorage() { clear(); }

  [[nodiscard]] std::size_t size() const { return state_.size; }
  [[nodiscard]] const Allocator& allocator() const { return allocator_; }
  [[nodiscard]] ChildRef root() const { return state_.root; }
  /// The tight box of everything; the empty box if there is nothing.
  [[nodiscard]] const BoxType& root_box() const { return state_.root_box; }
  [[nodiscard]] const NodeType& node(std::uint32_t index) const { return nodes_[index]; }
  [[nodiscard]] NodeType& node(std::uint32_t index) { return nodes_[index]; }
  [[nodiscard]] const LeafType& leaf(std::uint32_t index) const { return leaves_[index]; }
  [[nodiscard]] LeafType& leaf(std::uint32_t index) { return leaves_[index]; }
  /// @pre has_slots()
  [[nodiscard]] Slot& slot(std::uint32_t index) { return slots_[index]; }
  [[nodiscard]] bool has_slots() const { return slots_.implied() == 0; }
  [[nodiscard]] const Leaves& leaves() const { return leaves_; }
  [[nodiscard]] std::size_t slot_capacity() const { return slots_.size(); }
  [[nodiscard]] bool is_alive(std::uint32_t id, std::uint32_t generation) const {
    if (id >= slots_.size()) return false;
    const Slot where = place(id);
    return where.leaf != none && where.generation == generation;
  }
  /// Where an element is; no leaf if it is gone. O(1), after a bulk load O(log n). @pre id < slot_capacity()
  [[nodiscard]] Slot place(std::uint32_t id) const {
    if (id >= slots_.implied()) return slots_[id];
    const auto after = std::upper_bound(leaves_.begin(), leaves_.end(), id,
                                        [](std::uint32_t i, const LeafType& leaf) { return i < leaf.first; });
    if (after == leaves_.begin()) return {};
    const LeafType& home = *(after - 1);
    const std::uint32_t position = home.position_of(id);
    if (position == home.capacity) return {};
    return {static_cast<std::uint32_t>(after - leaves_.begin() - 1), position, slots_.generation(id)};
  }
  [[nodiscard]] std::uint32_t generation(std::uint32_t id) const { return slots_.generation(id); }
  [[nodiscard]] Value& value(std::uint32_t id) const {
    const Slot where = place(id);
    return leaves_[where.leaf].values()[where.position];
  }
  [[nodiscard]] BoxType box(std::uint32_t id) const {
    const Slot where = place(id);
    return leaves_[where.leaf].box(where.position);
  }
  /// Whether the box of a big leaf may be too large (shrink_leaf).
  [[nodiscard]] bool is_loose() const { return state_.any_loose; }
  void set_loose() { state_.any_loose = true; }

  /// Empty if there is none: in small trees, and after an insertion or a move.
  [[nodiscard]] const Overview<T, D, Allocator>& overview() const { return overview_; }
  void drop_overview() noexcept { overview_.clear(); }

  // --- links: what hangs at the side of a node, or at `none` the root ---

  ChildRef& link(std::uint32_t parent, std::uint32_t side) {
    return parent == none ? state_.root : nodes_[parent].child[side];
  }
  [[nodiscard]] BoxType link_box(std::uint32_t parent, std::uint32_t side) const {
    return parent == none ? state_.root_box : nodes_[parent].child_box(side);
  }
  void set_link_box(std::uint32_t parent, std::uint32_t side, const BoxType& box) {
    if (parent == none) {
      state_.root_box = box;
    } else {
      nodes_[parent].set_child_box(side, box);
    }
  }

  /// The volume of what hangs at this link. @pre the parent is a node
  [[nodiscard]] Cell<T, D> link_cell(std::uint32_t parent, std::uint32_t side) const {
    const NodeType& above = nodes_[parent];
    return above.cell.child(above.split(), static_cast<Side>(side));
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

  // --- slots, nodes and leaves as numbered objects ---

  /// After a bulk load: what changes more than by erasing needs a slot for each element. O(n), once.
  void make_slots() {
    if (has_slots()) return;
    const std::uint32_t generation = slots_.generation(0);
    const std::uint32_t fresh = slots_.make_all();
    for (std::uint32_t l = 0; l < leaves_.size(); ++l) {
      const LeafType& home = leaves_[l];
      for (std::uint32_t i = 0; i < home.count && !home.has_ids; ++i) slots_[home.id(i)] = {l, i, generation};
    }
    slots_.free_unused(0, fresh);
  }
  std::uint32_t take_slot() {
    make_slots();
    return slots_.take();
  }
  void release_taken_slot(std::uint32_t id) {
    slots_.release_taken(id);
    ++state_.size;
  }
  /// An id without a slot is free because its leaf says so.
  void free_slot(std::uint32_t id) {
    if (id >= slots_.implied()) slots_.free(id);
    --state_.size;
  }

  std::uint32_t new_node() {
    if (state_.free_node == none) {
      nodes_.push_back({});
      return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    const std::uint32_t index = state_.free_node;
    state_.free_node = nodes_[index].parent;
    nodes_[index] = NodeType{};
    return index;
  }
  void free_node(std::uint32_t index) {
    nodes_[index].parent = state_.free_node;
    state_.free_node = index;
  }
  std::uint32_t new_leaf(std::uint32_t capacity, std::uint8_t rows) {
    if (state_.free_leaf == none) {
      leaves_.push_back({});
      leaves_.back().parent = none;
      state_.free_leaf = static_cast<std::uint32_t>(leaves_.size() - 1);
    }
    std::byte* data = Memory::allocate(allocator_, capacity, rows, true);
    const std::uint32_t index = state_.free_leaf;
    state_.free_leaf = leaves_[index].parent;
    leaves_[index] = LeafType{};
    leaves_[index].data = data;
    leaves_[index].capacity = capacity;
    leaves_[index].rows = rows;
    return index;
  }
  void free_leaf(std::uint32_t index) {
    const std::uint32_t first = leaves_[index].first;
    release_leaf_memory(leaves_[index]);
    leaves_[index].first = first;
    leaves_[index].parent = state_.free_leaf;
    state_.free_leaf = index;
  }
  static std::uint32_t capacity_for(std::uint32_t count) {
    if (count > leaf_limit) return count + count / 2;
    std::uint32_t capacity = least_capacity;
    while (capacity < count) capacity *= 2;
    return capacity < leaf_limit ? capacity : leaf_limit;
  }

  /// Moves an element to the end of another leaf, and tells its slot. The levels are right only if the frames
  /// are the same.
  void move_element(const Arrays& from, std::uint32_t at, LeafType& to, const Arrays& target,
                    std::uint32_t to_index) {
    const std::uint32_t end = to.count++;
    target.copy_box(from, at, end);
    const std::uint32_t id = from.ids[at];
    target.ids[end] = id;
    ::new (static_cast<void*>(target.values + end)) Value(std::move(from.values[at]));
    from.values[at].~Value();  // NOLINT(bugprone-use-after-move): what was moved from is destroyed
    slots_[id].leaf = to_index;
    slots_[id].position = end;
  }

  /// Gives a leaf a new block, with ids. @pre capacity >= count, has_slots()
  void enlarge_leaf(std::uint32_t index, std::uint32_t capacity, std::uint8_t rows) {
    LeafType bigger = leaves_[index];
    bigger.capacity = capacity;
    bigger.rows = rows;
    bigger.has_ids = true;
    bigger.data = Memory::allocate(allocator_, capacity, rows, true);
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

  // --- the whole ---

  /// Adds many elements: entries[i] is {box, slot_capacity() + i} and belongs to values[i]. Those whose box
  /// is not valid have been left out of `entries`, but not of `values`. The whole tree is built anew.
  /// @param slots false: nobody will ask for ids as they are in `entries`; so as few slots are made as
  /// possible, which is none if the tree never had any
  template <class Values>
  void insert_all(std::vector<BuildEntry<T, D>>& entries, Values& values, bool slots) {
    make_slots();
    const auto first_new = static_cast<std::uint32_t>(slots_.size());
    const std::size_t added = entries.size();
    slots |= first_new > 0;
    entries.reserve(added + state_.size);
    for (std::uint32_t id = 0; id < first_new; ++id) {
      if (slots_[id].leaf != none) entries.push_back({box(id), id});
    }
    Build<TreeStorage> fresh(allocator_, slots);
    fresh.run(entries);
    Overview<T, D, Allocator> overview(allocator_);
    overview.build(fresh.nodes, fresh.leaves, fresh.root);
    if (slots) {
      slots_.grow(values.size());
    } else {
      slots_.begin(static_cast<std::uint32_t>(added), fresh.without_ids);
    }
    // From here on nothing fails. Entries lie in the order of the leaves now.
    const BuildEntry<T, D>* entry = entries.data();
    std::uint32_t next_id = slots_.implied();
    for (std::uint32_t l = 0; l < fresh.leaves.size(); ++l) {
      LeafType& home = fresh.leaves[l];
      for (std::uint32_t i = 0; i < home.count; ++i, ++entry) {
        const bool is_old = entry->id < first_new;
        Value& from = is_old ? value(entry->id) : values[entry->id - first_new];
        ::new (static_cast<void*>(home.values() + i)) Value(std::move(from));
        if (!home.has_ids) continue;
        const std::uint32_t id = slots ? entry->id : next_id++;
        home.ids()[i] = id;
        if (!is_old) {
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
    overview_.swap(overview);
    if (slots) slots_.free_unused(first_new, slots_.size());
    state_ = {none, none, fresh.root, fresh.root_box, size() + added, false};
  }

  /// Takes over the shape, the slots and the boxes of another tree, and makes each value by `make(Value&)`.
  /// @pre this tree is empty and new
  template <class Other, class Make>
  void assign_from(Other& other, Make&& make) {
    nodes_.assign(other.nodes_.begin(), other.nodes_.end());
    slots_.assign(other.slots_);
    leaves_.resize(other.leaves_.size());
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      const LeafType& from = other.leaves_[l];
      LeafType& to = leaves_[l];
      to.parent = from.parent;
      to.first = from.first;
      if (from.data == nullptr) continue;
      to.side = from.side;
      to.loose = from.loose;
      to.indivisible = from.indivisible;
      to.rows = from.rows;
      to.has_ids = from.has_ids;
      to.data = Memory::allocate(allocator_, from.capacity, from.rows, from.has_ids);
      to.capacity = from.capacity;
      to.copy_all(from);
      for (std::uint32_t i = 0; i < from.count; ++i, ++to.count) {
        ::new (static_cast<void*>(to.values() + i)) Value(make(from.values()[i]));
      }
    }
    overview_.assign(other.overview_, leaves_);
    state_ = other.state_;
  }

  void clear() noexcept {
    for (LeafType& each : leaves_) release_leaf_memory(each);
    nodes_.clear();
    leaves_.clear();
    slots_.clear();
    overview_.clear();
    state_ = {};
  }

  void swap(TreeStorage& other) noexcept {
    using std::swap;
    if constexpr (std::allocator_traits<Allocator>::propagate_on_container_swap::value) {
      swap(allocator_, other.allocator_);
    }
    nodes_.swap(other.nodes_);
    leaves_.swap(other.leaves_);
    slots_.swap(other.slots_);
    overview_.swap(other.overview_);
    swap(state_, other.state_);
  }

  /// Takes over everything of another tree. @pre the allocators are equal, or propagate on move assignment
  void replace_by(TreeStorage& other) noexcept {
    clear();
    if constexpr (std::allocator_traits<Allocator>::propagate_on_container_move_assignment::value) {
      allocator_ = other.allocator_;
    }
    nodes_ = std::move(other.nodes_);
    leaves_ = std::move(other.leaves_);
    slots_.take_over(other.slots_);
    overview_.take_over(other.overview_);
    state_ = std::exchange(other.state_, {});
    other.leaves_.clear();
    other.nodes_.clear();
  }

  /// Bytes of the tables, used and reserved, without the leaves' blocks.
  [[nodiscard]] std::size_t table_bytes() const {
    return nodes_.capacity() * sizeof(NodeType) + leaves_.capacity() * sizeof(LeafType) + slots_.bytes() +
           overview_.bytes();
  }

 private:
  void release_leaf_memory(LeafType& which) noexcept {
    for (std::uint32_t i = 0; i < which.count; ++i) which.values()[i].~Value();
    Memory::free(allocator_, which);
    which = LeafType{};
  }

  [[no_unique_address]] Allocator allocator_;
  Nodes nodes_;
  Leaves leaves_;
  SlotTable<Rebound<Slot>> slots_;
  Overview<T, D, Allocator> overview_;
  struct State {
    std::uint32_t free_node = none;
    std::uint32_t free_leaf = none;
    ChildRef root;
    BoxType root_box = empty_box<T, D>();
    std::size_t size = 0;
    bool any_loose = false;
  };
  State state_;
};

template <class Tree>
using TreeBox = typename Tree::BoxType;
template <class Tree>
using TreeCell = Cell<typename Tree::Scalar, Tree::dimension>;
template <class Tree>
using TreeSplit = Split<typename Tree::Scalar, Tree::dimension>;
template <class Tree>
TreeBox<Tree> no_box() {
  return empty_box<typename Tree::Scalar, Tree::dimension>();
}

}  // namespace spatial::detail

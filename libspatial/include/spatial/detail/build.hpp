/// @file
/// Builds the tree of many boxes at once: the same tree as inserting them into the same root volume would
/// give (§5.1), made from the top. In: boxes with slot indices. Out: nodes, and leaves that hold boxes and
/// slot indices but no values.
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cell.hpp"
#include "leaf.hpp"
#include "node.hpp"

namespace spatial::detail {

template <class T, std::size_t D>
struct BuildEntry {
  Box<T, D> box;
  std::uint32_t id;
};

template <class Core>
class Build {
 public:
  using T = typename Core::Scalar;
  static constexpr std::size_t D = Core::dimension;
  using Entry = BuildEntry<T, D>;
  using NodeType = typename Core::NodeType;
  using LeafType = typename Core::LeafType;
  static constexpr std::uint32_t none = 0xffffffffu;

  typename Core::Nodes nodes;
  typename Core::Leaves leaves;  ///< count says how many boxes there are
  ChildRef root;
  Box<T, D> root_box = empty_box<T, D>();

  explicit Build(const typename Core::AllocatorType& allocator)
      : nodes(allocator), leaves(allocator), allocator_(allocator) {}
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;
  /// Frees the leaves unless they were taken over.
  ~Build() {
    for (LeafType& leaf : leaves) Core::Memory::free(allocator_, leaf.data, leaf.capacity);
  }

  /// @pre every box is valid
  void run(std::vector<Entry>& entries) {
    if (entries.empty()) return;
    std::vector<Entry> other(entries.size());
    Entry* const buffers[2] = {entries.data(), other.data()};
    std::vector<Task> tasks;
    root_box = bounds(entries.data(), entries.data() + entries.size());
    tasks.push_back({Cell<T, D>::cube_around(root_box), root_box, 0, entries.size(), none, 0, 0});
    while (!tasks.empty()) {
      Task task = tasks.back();
      tasks.pop_back();
      divide(task, buffers, tasks);
    }
  }

 private:
  struct Task {
    Cell<T, D> cell;
    Box<T, D> tight;
    std::size_t begin, end;
    std::uint32_t parent, side;
    unsigned buffer;
  };

  static Box<T, D> bounds(const Entry* begin, const Entry* end) {
    Box<T, D> box = begin->box;
    for (const Entry* e = begin + 1; e != end; ++e) extend(box, e->box);
    return box;
  }

  void attach(ChildRef child, const Task& task) {
    if (task.parent == none) {
      root = child;
    } else {
      nodes[task.parent].child[task.side] = child;
    }
  }

  void divide(const Task& task, Entry* const (&buffers)[2], std::vector<Task>& tasks) {
    const Entry* const from = buffers[task.buffer];
    const std::size_t count = task.end - task.begin;
    Cell<T, D> cell = task.cell;
    Split<T, D> at;
    bool compressed = false;
    if (count > Core::leaf_limit) {
      for (;;) {
        at = cell.split();
        if (!at.exists()) break;
        const Side all = side_of(task.tight.min[at.axis], task.tight.max[at.axis], at.plane);
        if (all == centric) break;
        cell = cell.child(at, all);
        compressed = true;
      }
    }
    if (!at.exists()) {
      make_leaf(task, from + task.begin, static_cast<std::uint32_t>(count));
      return;
    }
    std::size_t counts[3] = {0, 0, 0};
    for (std::size_t i = task.begin; i < task.end; ++i) ++counts[side_index(from[i].box, at)];
    std::size_t ends[3] = {task.begin, task.begin + counts[0], task.begin + counts[0] + counts[1]};
    Entry* const to = buffers[1 - task.buffer];
    for (std::size_t i = task.begin; i < task.end; ++i) to[ends[side_index(from[i].box, at)]++] = from[i];
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({});
    NodeType& node = nodes.back();
    node.cell = cell;
    node.plane = at.plane;
    node.axis = static_cast<std::uint32_t>(at.axis);
    node.parent = task.parent;
    node.side = static_cast<std::uint8_t>(task.side);
    node.compressed = compressed;
    attach(ChildRef::node(index), task);
    node.set_child_box(NodeType::lanes - 1, empty_box<T, D>());
    for (std::uint32_t s = 3; s-- > 0;) {
      node.set_child_box(s, empty_box<T, D>());
      if (counts[s] == 0) continue;
      const std::size_t begin = ends[s] - counts[s];
      const Box<T, D> tight = bounds(to + begin, to + ends[s]);
      node.set_child_box(s, tight);
      tasks.push_back(
          {cell.child(at, static_cast<Side>(s)), tight, begin, ends[s], index, s, 1 - task.buffer});
    }
  }

  // side_of without branches: which side a box falls on cannot be predicted.
  static unsigned side_index(const Box<T, D>& box, const Split<T, D>& at) {
    const bool is_lower = box.max[at.axis] <= at.plane;
    const bool is_higher = box.min[at.axis] >= at.plane;
    return is_lower ? lower : is_higher ? higher : centric;
  }

  void make_leaf(const Task& task, const Entry* entries, std::uint32_t count) {
    leaves.push_back({});
    LeafType& leaf = leaves.back();
    leaf.data = Core::Memory::allocate(allocator_, count);
    leaf.capacity = count;
    leaf.count = count;
    leaf.parent = task.parent;
    leaf.side = static_cast<std::uint8_t>(task.side);
    leaf.indivisible = count > Core::leaf_limit;
    for (std::uint32_t i = 0; i < count; ++i) {
      leaf.set_box(i, entries[i].box);
      leaf.ids()[i] = entries[i].id;
    }
    attach(ChildRef::leaf(static_cast<std::uint32_t>(leaves.size() - 1)), task);
  }

  typename Core::AllocatorType allocator_;
};

}  // namespace spatial::detail

/// @file
/// Builds the tree of many boxes at once: the same tree as inserting them into the same root volume would
/// give (§5.1), made from the top. In: boxes with slot indices. Out: nodes, and leaves that hold boxes and
/// slot indices but no values.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
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
  Box<T, D> root_box = empty_box<T, D>();  // tight, as all child boxes

  explicit Build(const typename Core::AllocatorType& allocator)
      : nodes(allocator), leaves(allocator), allocator_(allocator) {}
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;
  /// Frees the leaves unless they were taken over.
  ~Build() {
    for (LeafType& leaf : leaves) Core::Memory::free(allocator_, leaf);
  }

  /// @pre every box is valid
  void run(std::vector<Entry>& entries) {
    if (entries.empty()) return;
    const auto other = std::make_unique_for_overwrite<Entry[]>(entries.size());
    Entry* const buffers[2] = {entries.data(), other.get()};
    std::vector<Task> tasks;
    const Box<T, D> all = bounds(entries.data(), entries.data() + entries.size());
    all_points_ = std::all_of(entries.begin(), entries.end(), [](const Entry& e) { return is_point(e.box); });
    tasks.push_back({Cell<T, D>::cube_around(all), 0, entries.size(), none, 0, 0});
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      divide(task, buffers, tasks);
    }
    tighten(all);
    nodes.shrink_to_fit();
    leaves.shrink_to_fit();
  }

 private:
  struct Task {
    Cell<T, D> cell;
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
    unsigned buffer = task.buffer;
    const std::size_t count = task.end - task.begin;
    const auto leaf_here = [&] {
      make_leaf(task, buffers[buffer] + task.begin, static_cast<std::uint32_t>(count));
    };
    if (count <= Core::leaf_limit) return leaf_here();
    Cell<T, D> cell = task.cell;
    Split<T, D> at = cell.split();
    bool compressed = false;
    std::size_t ends[2];
    while (at.exists()) {
      partition(buffers[buffer], buffers[1 - buffer], task.begin, task.end, at, ends);
      buffer = 1 - buffer;
      const bool all_lower = ends[0] == task.end;
      const bool all_higher = ends[1] == task.begin;
      if (!all_lower && !all_higher) break;
      // All on one side: this volume is left out, and those below it that the tight box does not cross.
      cell = cell.child(at, all_lower ? lower : higher);
      compressed = true;
      const Box<T, D> tight = bounds(buffers[buffer] + task.begin, buffers[buffer] + task.end);
      for (at = cell.split(); at.exists(); at = cell.split()) {
        const Side side = side_of(tight.min[at.axis], tight.max[at.axis], at.plane);
        if (side == centric) break;
        cell = cell.child(at, side);
      }
    }
    if (!at.exists()) return leaf_here();
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({});
    NodeType& node = nodes.back();
    node.cell = cell;
    node.plane = at.plane;
    node.axis = static_cast<std::uint8_t>(at.axis);
    node.parent = task.parent;
    node.side = static_cast<std::uint8_t>(task.side);
    node.compressed = compressed;
    attach(ChildRef::node(index), task);
    for (std::size_t s = 0; s < NodeType::lanes; ++s) node.set_child_box(s, empty_box<T, D>());
    const std::size_t begins[3] = {task.begin, ends[1], ends[0]};
    const std::size_t all_ends[3] = {ends[0], task.end, ends[1]};
    for (std::uint32_t s = 3; s-- > 0;) {
      if (begins[s] == all_ends[s]) continue;
      tasks.push_back({cell.child(at, static_cast<Side>(s)), begins[s], all_ends[s], index, s, buffer});
    }
  }

  // Distributes from[begin, end) over to[begin, end): lower, centric, higher. `ends` are where the first two
  // end. Without branches, since where an entry belongs cannot be predicted.
  void partition(const Entry* from, Entry* to, std::size_t begin, std::size_t end, const Split<T, D>& at,
                 std::size_t (&ends)[2]) {
    std::size_t counts[3] = {0, 0, 0};
    if (sides_.size() < end - begin) sides_.resize(end - begin);
    std::uint8_t* sides = sides_.data();
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Side side = side_of(from[i].box.min[at.axis], from[i].box.max[at.axis], at.plane);
      sides[i - begin] = static_cast<std::uint8_t>(side);
      low += static_cast<std::size_t>(side == lower);
      high += static_cast<std::size_t>(side == higher);
    }
    counts[lower] = begin;
    counts[centric] = begin + low;
    counts[higher] = end - high;
    ends[0] = begin + low;
    ends[1] = end - high;
    for (std::size_t i = begin; i < end; ++i) to[counts[sides[i - begin]]++] = from[i];
  }

  // Tight boxes, from the nodes above leaves upwards: parents come before their children in `nodes`.
  void tighten(const Box<T, D>& all) {
    root_box = all;
    for (std::size_t i = nodes.size(); i-- > 0;) {
      const NodeType& node = nodes[i];
      if (node.parent != none) nodes[node.parent].set_child_box(node.side, node.bounds());
    }
  }

  void make_leaf(const Task& task, const Entry* entries, std::uint32_t count) {
    leaves.push_back({});
    LeafType& leaf = leaves.back();
    leaf.rows = static_cast<std::uint8_t>(all_points_ ? D : 2 * D);
    leaf.data = Core::Memory::allocate(allocator_, count, leaf.rows);
    leaf.capacity = count;
    leaf.count = count;
    leaf.parent = task.parent;
    leaf.side = static_cast<std::uint8_t>(task.side);
    leaf.indivisible = count > Core::leaf_limit;
    const Box<T, D> tight = bounds(entries, entries + count);
    leaf.set_frame(Frame<T, D>::around(tight));
    for (std::uint32_t i = 0; i < count; ++i) {
      leaf.set_box(i, entries[i].box);
      leaf.ids()[i] = entries[i].id;
    }
    leaf.beside = 0;
    if (task.parent != none) nodes[task.parent].set_child_box(task.side, tight);
    attach(ChildRef::leaf(static_cast<std::uint32_t>(leaves.size() - 1)), task);
  }

  typename Core::AllocatorType allocator_;
  std::vector<std::uint8_t> sides_;
  bool all_points_ = false;
};

}  // namespace spatial::detail

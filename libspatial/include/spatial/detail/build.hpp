/// @file
/// Builds the tree of many boxes at once: the same tree as inserting them into the same root volume would
/// give (§5.1), made from the top. In: boxes with numbers. Out: nodes, and leaves that hold boxes but no ids
/// and no values.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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
  Box<T, D> root_box = empty_box<T, D>();  ///< tight, as all child boxes
  std::uint32_t without_ids = 0;           ///< how many elements are in leaves without ids

  /// @param with_ids false: leaves get no ids where they can do without
  Build(const typename Core::AllocatorType& allocator, bool with_ids)
      : nodes(allocator), leaves(allocator), allocator_(allocator), with_ids_(with_ids) {}
  Build(const Build&) = delete;
  Build& operator=(const Build&) = delete;
  /// Frees the leaves unless they were taken over.
  ~Build() {
    for (LeafType& leaf : leaves) Core::Memory::free(allocator_, leaf);
  }

  /// Puts the entries into the order of the leaves. @pre every box is valid
  void run(std::vector<Entry>& entries) {
    if (entries.empty()) return;
    entries_ = entries.data();
    bins_.resize(entries.size());
    const Box<T, D> all = bounds(entries_, entries_ + entries.size());
    all_points_ = std::all_of(entries.begin(), entries.end(), [](const Entry& e) { return is_point(e.box); });
    tasks_.push_back({Cell<T, D>::cube_around(all), 0, entries.size(), none, 0, false});
    while (!tasks_.empty()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      if (task.end - task.begin <= Core::leaf_limit) {
        make_leaf(task);
      } else {
        divide(task);
      }
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
    bool compressed;
  };
  /// So many levels of volumes are divided at once. What is at position p of level l has its children at 3p,
  /// 3p + 1 and 3p + 2 of level l + 1.
  static constexpr std::size_t levels = 3;
  static constexpr std::size_t bins = 27;
  static constexpr std::size_t level_begin[levels + 1] = {0, 1, 4, 13};

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

  void divide(Task task) {
    if (task.compressed) {
      // All lay on one side: volumes are left out that the tight box does not cross.
      const Box<T, D> tight = bounds(entries_ + task.begin, entries_ + task.end);
      for (Split<T, D> at = task.cell.split(); at.exists(); at = task.cell.split()) {
        const Side side = side_of(tight.min[at.axis], tight.max[at.axis], at.plane);
        if (side == centric) break;
        task.cell = task.cell.child(at, side);
      }
    }
    Cell<T, D> cells[level_begin[levels]];
    Split<T, D> splits[level_begin[levels]];
    cells[0] = task.cell;
    for (std::size_t level = 0; level < levels; ++level) {
      for (std::size_t i = level_begin[level]; i < level_begin[level + 1]; ++i) {
        splits[i] = cells[i].split();
        if (level + 1 == levels) continue;
        const std::size_t child = level_begin[level + 1] + 3 * (i - level_begin[level]);
        for (std::uint32_t s = 0; s < 3; ++s) {
          cells[child + s] = splits[i].exists() ? cells[i].child(splits[i], static_cast<Side>(s)) : cells[i];
        }
      }
    }
    if (!splits[0].exists()) return make_leaf(task);
    std::size_t ends[bins];
    partition(task, splits, ends);
    add_nodes(task, cells, splits, ends, 0, 0);
  }

  /// Makes the node of the volume at a position of a level, and tasks of what is below. The tasks of higher
  /// sides are made first, so that the leaves come in the order of the entries.
  void add_nodes(const Task& task, const Cell<T, D>* cells, const Split<T, D>* splits,
                 const std::size_t (&ends)[bins], std::size_t level, std::size_t position) {
    const std::size_t i = level_begin[level] + position;
    if (level == levels || task.end - task.begin <= Core::leaf_limit || !splits[i].exists()) {
      // What no plane divides is found out by divide().
      tasks_.push_back(task);
      return;
    }
    const Split<T, D>& at = splits[i];
    std::size_t width = bins / 3;
    for (std::size_t l = 0; l < level; ++l) width /= 3;
    std::size_t begins[4] = {task.begin, 0, 0, task.end};
    for (std::size_t s = 0; s < 2; ++s) begins[s + 1] = ends[(3 * position + s + 1) * width - 1];
    Task child = task;
    const bool all_lower = begins[1] == task.end;
    const bool all_higher = begins[1] == task.begin && begins[2] == task.end;
    if (all_lower || all_higher) {  // this volume is left out
      const Side side = all_lower ? lower : higher;
      child.cell = cells[i].child(at, side);
      child.compressed = true;
      return add_nodes(child, cells, splits, ends, level + 1, 3 * position + side);
    }
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({});
    NodeType& node = nodes.back();
    node.cell = cells[i];
    node.plane = at.plane;
    node.axis = static_cast<std::uint8_t>(at.axis);
    node.parent = task.parent;
    node.side = static_cast<std::uint8_t>(task.side);
    node.compressed = task.compressed;
    attach(ChildRef::node(index), task);
    for (std::size_t s = 0; s < NodeType::lanes; ++s) node.set_child_box(s, empty_box<T, D>());
    for (std::uint32_t s = 3; s-- > 0;) {
      if (begins[s] == begins[s + 1]) continue;
      child = {cells[i].child(at, static_cast<Side>(s)), begins[s], begins[s + 1], index, s, false};
      add_nodes(child, cells, splits, ends, level + 1, 3 * position + s);
    }
  }

  /// Orders the entries of a task by bins: where they lie to the planes of all levels. `ends` are where the
  /// bins end. In place, since fresh memory costs more than the rest.
  void partition(const Task& task, const Split<T, D>* splits, std::size_t (&ends)[bins]) {
    // Where there is no plane, all is lower.
    constexpr T greatest = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                                                : std::numeric_limits<T>::max();
    std::size_t axes[level_begin[levels]];
    T planes[level_begin[levels]];
    for (std::size_t i = 0; i < level_begin[levels]; ++i) {
      axes[i] = splits[i].exists() ? splits[i].axis : 0;
      planes[i] = splits[i].exists() ? splits[i].plane : greatest;
    }
    std::size_t counts[bins] = {};
    for (std::size_t e = task.begin; e < task.end; ++e) {
      const Box<T, D>& box = entries_[e].box;
      std::size_t position = 0;
      for (const std::size_t first : {level_begin[0], level_begin[1], level_begin[2]}) {
        const std::size_t i = first + position;
        position = 3 * position + side_of(box.min[axes[i]], box.max[axes[i]], planes[i]);
      }
      bins_[e] = static_cast<std::uint8_t>(position);
      ++counts[position];
    }
    std::size_t next[bins];
    std::size_t end = task.begin;
    for (std::size_t b = 0; b < bins; ++b) {
      next[b] = end;
      ends[b] = end += counts[b];
    }
    for (std::size_t b = 0; b < bins; ++b) {
      for (std::size_t e = next[b]; e < ends[b]; e = ++next[b]) {
        std::size_t bin = bins_[e];
        if (bin == b) continue;
        Entry moving = entries_[e];
        do {
          const std::size_t to = next[bin]++;
          std::swap(moving, entries_[to]);
          const std::size_t then = bins_[to];
          bins_[to] = static_cast<std::uint8_t>(bin);
          bin = then;
        } while (bin != b);
        entries_[e] = moving;
      }
    }
  }

  // Tight boxes, from the nodes above leaves upwards: parents come before their children in `nodes`.
  void tighten(const Box<T, D>& all) {
    root_box = all;
    for (std::size_t i = nodes.size(); i-- > 0;) {
      const NodeType& node = nodes[i];
      if (node.parent != none) nodes[node.parent].set_child_box(node.side, node.bounds());
    }
  }

  void make_leaf(const Task& task) {
    const Entry* const entries = entries_ + task.begin;
    const auto count = static_cast<std::uint32_t>(task.end - task.begin);
    leaves.push_back({});
    LeafType& leaf = leaves.back();
    leaf.rows = static_cast<std::uint8_t>(all_points_ ? D : 2 * D);
    leaf.has_ids = with_ids_ || count > LeafType::most_without_ids;
    leaf.data = Core::Memory::allocate(allocator_, count, leaf.rows, leaf.has_ids);
    leaf.capacity = count;
    leaf.count = count;
    leaf.parent = task.parent;
    leaf.side = static_cast<std::uint8_t>(task.side);
    leaf.indivisible = count > Core::leaf_limit;
    leaf.first = without_ids;
    if (!leaf.has_ids) {
      leaf.set_all_alive();
      without_ids += count;
    }
    const Box<T, D> tight = bounds(entries, entries + count);
    leaf.set_frame(Frame<T, D>::around(tight));
    for (std::uint32_t i = 0; i < count; ++i) leaf.set_box(i, entries[i].box);
    leaf.beside = 0;
    if (task.parent != none) nodes[task.parent].set_child_box(task.side, tight);
    attach(ChildRef::leaf(static_cast<std::uint32_t>(leaves.size() - 1)), task);
  }

  typename Core::AllocatorType allocator_;
  bool with_ids_;
  bool all_points_ = false;
  Entry* entries_ = nullptr;
  std::vector<std::uint8_t> bins_;
  std::vector<Task> tasks_;
};

}  // namespace spatial::detail

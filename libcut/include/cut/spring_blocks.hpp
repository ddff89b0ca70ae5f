/// @file
/// The springs of a simulation as its step goes through them: springs in diagonals, nodes in blocks, and with
/// each block a copy of the other springs that pull at its nodes. A block reads positions and velocities of
/// all nodes and writes to its own only, so blocks can be done at the same time; and the order in which a
/// node's forces are added up does not depend on who does them. In: springs one by one, as they are set or
/// change. Out: flat arrays.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace cut {

/// Springs in flat arrays. Entries that are not in use join a node to itself with k = c = 0.
struct SpringArrays {
  std::vector<std::array<std::uint32_t, 2>> nodes;
  std::vector<double> rest_length;
  std::vector<double> stiffness;
  std::vector<double> damping;
};

/// Constants of four springs side by side. Aligned, since a processor takes longer for what lies across lines
/// of its cache.
struct alignas(32) FourSprings {
  std::array<double, 4> rest_length{}, stiffness{}, damping{};
};

/// Four springs of a list, by the slots of their nodes. Entries that are not in use join a slot to itself
/// with k = c = 0, so that they make no force and need no branch.
struct alignas(64) ListedSprings {
  std::array<std::array<std::uint32_t, 2>, 4> nodes{};
  FourSprings springs;
};

/// Springs from node i to node i + offset, for each i: a sheet whose nodes are numbered row by row is three
/// of these. Entries that are not in use have k = c = 0.
struct SpringDiagonal {
  std::uint32_t offset = 0;
  std::vector<FourSprings> springs;
  std::vector<std::uint8_t> used;  ///< per spring
};

/// Springs in lists find their nodes as vectors, by slot: a node that is not in columns has one slot, and one
/// in columns has one in each block whose lists name it, to which a step copies it. What a cut needs gets
/// slots in a row, so that a step finds it side by side.
struct SlottedNode {
  std::uint32_t node, slot;
};

/// Nodes in columns that the lists of a block name.
class HeldNodes {
 public:
  /// The slot of a node, which is held once more; a new one is `next_slot`. O(1) expected.
  std::uint32_t hold(std::uint32_t node, std::uint32_t next_slot);
  /// Who no longer needs the node says so. O(1) expected.
  void let_go(std::uint32_t node);

  /// Where nobody holds a node is one that somebody has held.
  [[nodiscard]] const std::vector<SlottedNode>& nodes() const { return nodes_; }

 private:
  std::vector<SlottedNode> nodes_;
  std::vector<std::uint32_t> holders_, free_;
  std::unordered_map<std::uint32_t, std::uint32_t> entries_;
};

struct SpringBlock {
  std::uint32_t first = 0, last = 0;  ///< its nodes: from `first`, a multiple of 4, to before `last`, ...
  std::vector<SlottedNode> copies;    ///< ... and what cuts have made of these
  /// Springs that are not in diagonals: with both ends in the block, ...
  std::vector<ListedSprings> inner;
  std::vector<ListedSprings> outer;  ///< ... and with nodes[0] in the block and nodes[1] in another
  std::vector<std::uint32_t> free_inner, free_outer;  ///< entries that are not in use
  HeldNodes held;
  /// Forces of lists on nodes in columns are summed up in columns of their own, four entries for four nodes
  /// that may need them: the first of these entries, per four nodes of the block; 0 for four that always are
  /// zero. Then once more for nodes of other blocks, of which nothing is wanted.
  std::vector<std::uint32_t> list_forces;
  std::uint32_t list_force_entries = 0;  ///< how many there are
  std::uint32_t nobody = 0;  ///< slot of the block that entries join to itself that are not in use
};

/// Where a spring is: in a diagonal, or in the list of one block or of each of two, or nowhere.
struct SpringPlace {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::array<std::uint32_t, 2> block{none, none};
  std::uint32_t diagonal = none;
  std::array<std::uint32_t, 2> entry{};

  bool operator==(const SpringPlace&) const = default;
};

inline constexpr std::size_t most_diagonals = 8;

/// By how much the numbers of two nodes differ that springs join, for differences so frequent that these
/// springs are best kept in diagonals; at most `most_diagonals`. @param nodes  how many there are
[[nodiscard]] std::vector<std::uint32_t> frequent_offsets(std::span<const SpringArrays* const> lists,
                                                          std::size_t nodes);

class SpringBlocks {
 public:
  /// Divides so many nodes, by index: nodes that springs join should have near indices.
  /// @param offsets  of the diagonals
  void reset(std::size_t nodes, std::vector<std::uint32_t> offsets);
  /// The next node, in the block of the one that it is a copy of. O(1).
  void add_copy(std::uint32_t source);
  /// Copies entry i of `springs` to where its nodes are now, and takes it from where it was. O(1).
  void set(const SpringArrays& springs, std::size_t i, SpringPlace& place);

  [[nodiscard]] const std::vector<SpringBlock>& blocks() const { return blocks_; }
  /// Each over all nodes that were there at `reset`.
  [[nodiscard]] const std::vector<SpringDiagonal>& diagonals() const { return diagonals_; }
  /// How many nodes springs in diagonals can join: all that were there at `reset`, or none.
  [[nodiscard]] std::size_t nodes_in_diagonals() const { return diagonals_.empty() ? 0 : uncut_nodes_; }
  /// No spring joins two blocks with others between them.
  [[nodiscard]] bool neighbours_only() const { return far_springs_ == 0; }
  [[nodiscard]] std::size_t node_count() const { return block_of_.size(); }
  /// Per slot: its node. Where there are diagonals, slot b is no node's but `nobody` of block b; otherwise
  /// slots are nodes.
  [[nodiscard]] const std::vector<std::uint32_t>& slots() const { return node_at_; }
  /// Of a node that is not in columns.
  [[nodiscard]] std::uint32_t slot(std::size_t node) const { return slot_of_[node - nodes_in_diagonals()]; }

 private:
  [[nodiscard]] SpringPlace place_for(std::array<std::uint32_t, 2> nodes, const SpringPlace& old) const;
  void leave(const SpringPlace& place);
  void enter(SpringPlace& place);
  void join(SpringBlock& block, std::array<std::uint32_t, 2>& entry, std::uint32_t a, std::uint32_t b);
  void let_go(SpringBlock& block, std::array<std::uint32_t, 2>& entry);

  std::vector<SpringDiagonal> diagonals_;
  std::vector<SpringBlock> blocks_;
  std::vector<std::uint32_t> block_of_;  ///< per node
  std::vector<std::uint32_t> slot_of_;   ///< per node that is not in columns
  std::vector<std::uint32_t> node_at_;   ///< per slot
  std::size_t uncut_nodes_ = 0;
  std::size_t far_springs_ = 0;  ///< springs in lists that join blocks with others between them
};

}  // namespace cut

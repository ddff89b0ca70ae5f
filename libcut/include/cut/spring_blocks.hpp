/// @file
/// The springs of a simulation as its step goes through them: nodes in blocks, and with each block a copy of
/// the springs that pull at its nodes. A block reads positions and velocities of all nodes and writes to its
/// own only, so blocks can be done at the same time; and the order in which a node's forces are added up does
/// not depend on who does them. In: springs one by one, as they are set or change. Out: flat arrays.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cut {

/// Springs in flat arrays. Entries that are not in use join a node to itself with k = c = 0, so that they
/// make no force and need no branch.
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

/// Springs from node first + i to node first + i + offset, for each i: a sheet whose nodes are numbered row
/// by row is three of these. Entries that are not in use have k = c = 0.
struct SpringDiagonal {
  std::uint32_t offset = 0;
  std::uint32_t first = 0;  ///< a multiple of 4, as is the number of entries
  std::vector<FourSprings> springs;
  std::vector<std::uint8_t> used;
};

struct SpringBlock {
  std::uint32_t first = 0, last = 0;      ///< its nodes: from `first`, a multiple of 4, to before `last`, ...
  std::vector<std::uint32_t> copies;      ///< ... and what cuts have made of these
  std::uint32_t uncut_nodes = 0;          ///< of all blocks: diagonals read no node from here on
  std::vector<SpringDiagonal> diagonals;  ///< of all springs with an end in the block, ...
  SpringArrays inner;                     ///< ... and the others: with both ends in the block, ...
  SpringArrays outer;                     ///< ... with nodes[0] in the block and nodes[1] in another
  std::vector<std::uint32_t> free_inner, free_outer;  ///< entries that are not in use
};

/// Where a spring is: in one block, or in each of two, or nowhere; and there in a diagonal, `inner` or
/// `outer`.
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
  [[nodiscard]] bool has_diagonals() const { return !offsets_.empty(); }
  /// There are no copies, and no springs but in diagonals.
  [[nodiscard]] bool all_in_diagonals() const { return has_diagonals() && !loose_; }
  [[nodiscard]] std::size_t node_count() const { return block_of_.size(); }

 private:
  [[nodiscard]] SpringPlace place_for(std::array<std::uint32_t, 2> nodes, const SpringPlace& old) const;
  void leave(const SpringPlace& place);
  void enter(SpringPlace& place);

  std::vector<std::uint32_t> offsets_;  ///< of the diagonals that every block has, in this order
  bool loose_ = false;                  ///< something is, or has been, not in diagonals
  std::vector<SpringBlock> blocks_;
  std::vector<std::uint32_t> block_of_;  ///< per node
};

}  // namespace cut

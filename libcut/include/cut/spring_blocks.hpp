/// @file
/// The springs of a simulation as its step goes through them: nodes in blocks, and with each block a copy of
/// the springs that pull at its nodes. A block reads positions and velocities of all nodes and writes to its
/// own only, so blocks can be done at the same time; and the order in which a node's forces are added up does
/// not depend on who does them. In: springs one by one, as they are set or change. Out: flat arrays.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
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

struct SpringBlock {
  std::uint32_t first = 0, last = 0;                  ///< its nodes: from `first` to before `last`, ...
  std::vector<std::uint32_t> copies;                  ///< ... and what cuts have made of these
  SpringArrays inner;                                 ///< both ends in the block
  SpringArrays outer;                                 ///< nodes[0] in the block, nodes[1] in another
  std::vector<std::uint32_t> free_inner, free_outer;  ///< entries that are not in use
};

/// Where a spring is: one entry of `inner`, or one of `outer` in each of two blocks, or nowhere.
struct SpringPlace {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::array<std::uint32_t, 2> block{none, none};
  std::array<std::uint32_t, 2> entry{};
};

class SpringBlocks {
 public:
  /// Divides so many nodes, by index: nodes that springs join should have near indices.
  void reset(std::size_t nodes);
  /// The next node, in the block of the one that it is a copy of. O(1).
  void add_copy(std::uint32_t source);
  /// Copies entry i of `springs` to where its nodes are now, and takes it from where it was. O(1).
  void set(const SpringArrays& springs, std::size_t i, SpringPlace& place);

  [[nodiscard]] const std::vector<SpringBlock>& blocks() const { return blocks_; }
  [[nodiscard]] std::size_t node_count() const { return block_of_.size(); }

 private:
  std::vector<SpringBlock> blocks_;
  std::vector<std::uint32_t> block_of_;  ///< per node
};

}  // namespace cut

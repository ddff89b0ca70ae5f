// The nodes of all blocks go through one or several steps. In and out: positions and velocities in the arrays
// of kernels.hpp. Springs in diagonals are gone through in columns; for the other ones a block copies the
// nodes that these join to their slots, a few of many.
#include <algorithm>

#include "cut/simulation.hpp"
#include "lattice/per_thread.hpp"
#include "simulation/diagonals.hpp"
#include "simulation/kernels.hpp"
#include "simulation/padded.hpp"
#include "simulation/trapezoids.hpp"

namespace cut {
namespace {

using Vectors = std::vector<PaddedVector>;

/// What the springs of a block's lists and what is given do to its nodes at slots [first, last) and to its
/// copies; the next velocities of these. To nodes in columns: the forces at their slots.
bool advance_in_vectors(const SpringBlock& block, std::size_t first, std::size_t last,
                        const VelocityUpdate* update, const Vectors& given, const NodeArrays& nodes) {
  const Kernels& kernels = best_kernels();
  if (given.empty()) {
    std::fill(nodes.forces + first, nodes.forces + last, PaddedVector{});
    for (const SlottedNode& copy : block.copies) nodes.forces[copy.slot] = {};
  } else {
    std::copy(given.data() + first, given.data() + last, nodes.forces + first);
    for (const SlottedNode& copy : block.copies) nodes.forces[copy.slot] = given[copy.node];
  }
  kernels.add_spring_forces(block.inner, nodes.positions, nodes.velocities, nodes.forces);
  kernels.add_forces_at_first_node(block.outer, nodes.positions, nodes.velocities, nodes.forces);
  return update == nullptr || kernels.advance_nodes(*update, nodes, first, last, block.copies);
}

/// Forces beside those of diagonals on the nodes of a block. What lists add has room only where they add
/// something: one cut is to cost what it touches, not a pass over the block.
class OtherForces {
 public:
  /// Those of all nodes.
  void give(const Vectors& given, NodeRange& range) {
    const std::size_t size = range.last - range.first;
    sums_ = ColumnSpace(space_, 1, size + 8).take();
    best_kernels().to_columns(given.data() + range.first, 0, size, sums_);
    while (4 * all_.size() < size + 8) all_.push_back(static_cast<std::uint32_t>(4 * all_.size()));
    range.given = &sums_;
    range.fours = all_.data();
  }
  /// None yet of what lists will add.
  void make_room(const SpringBlock& block, NodeRange& range) {
    sums_ = ColumnSpace(space_, 1, block.list_force_entries).take();
    for (double* column : sums_) std::fill_n(column, block.list_force_entries, 0.0);
    range.given = &sums_;
    range.fours = block.list_forces.data();
  }

 private:
  std::vector<CacheLine> space_;
  ColumnArrays sums_{};
  std::vector<std::uint32_t> all_;
};

bool advance_in_columns(const SpringBlock& block, std::span<const SpringDiagonal> diagonals,
                        const VelocityUpdate* update, const Vectors& given, const NodeArrays& nodes,
                        ForceWindow& window) {
  SNIP_PER_THREAD OtherForces others;
  const std::vector<SlottedNode>& held = block.held.nodes();
  NodeRange range{diagonals, block.first, block.last, nullptr, nullptr};
  bool sound = true;
  if (!given.empty())
    others.give(given, range);
  else if (!held.empty())
    others.make_room(block, range);
  if (!held.empty() || !block.copies.empty()) {
    best_kernels().gather(held, nodes);
    sound = advance_in_vectors(block, 0, 0, update, given, nodes);
    if (!held.empty()) best_kernels().scatter(held, nodes.forces, range);
  }
  return best_kernels().advance_range(range, update, nodes, window) && sound;
}

/// Of the thread that asks, by step where several go on in turn.
std::vector<ForceWindow>& own_windows() {
  SNIP_PER_THREAD std::vector<ForceWindow> windows;
  return windows;
}

/// Calls columns(first, last) for those of nodes [first, last) that are in columns, and vector(node, slot)
/// for each other one.
template <class InColumns, class InVectors>
void split(const SpringBlocks& blocks, std::size_t first, std::size_t last, const InColumns& columns,
           const InVectors& vector) {
  const std::size_t in_columns = blocks.nodes_in_diagonals();
  if (first < in_columns) columns(first, std::min(last, in_columns));
  for (std::size_t n = std::max(first, in_columns); n < last; ++n) vector(n, blocks.slot(n));
}

void take(const ColumnArrays& columns, const PaddedVector* vectors, const SpringBlocks& blocks,
          std::size_t first, std::size_t last, Vectors& to) {
  split(
      blocks, first, last,
      [&](std::size_t a, std::size_t b) { best_kernels().from_columns(columns, a, b, to.data()); },
      [&](std::size_t n, std::size_t slot) { to[n] = vectors[slot]; });
}

}  // namespace

/// @param moves  whether nodes will move on as their velocities are found
NodeArrays Simulation::node_arrays(bool moves) {
  NodeArrays nodes{};
  nodes.moves = moves;
  nodes.inverse_mass = inverse_mass_.data();
  nodes.in_columns = blocks_.nodes_in_diagonals();
  const std::size_t slots = blocks_.slots().size();
  vectors_.resize(4 * slots);
  inverse_mass_at_slots_.resize(slots);
  nodes.inverse_mass_at_slots = inverse_mass_at_slots_.data();
  nodes.positions = vectors_.data();
  nodes.velocities = nodes.positions + slots;
  nodes.forces = nodes.velocities + slots;
  nodes.next_positions = nodes.forces + slots;
  if (nodes.in_columns == 0) return nodes;
  for (const SpringBlock& block : blocks_.blocks())
    for (PaddedVector* vectors : {nodes.positions, nodes.velocities, nodes.forces, nodes.next_positions})
      vectors[block.nobody] = {};
  const std::size_t reach = reach_of(blocks_.diagonals());
  ColumnSpace space(columns_, 4, nodes.in_columns + reach);
  for (ColumnArrays* columns : {&nodes.position_columns, &nodes.next_position_columns,
                                &nodes.velocity_columns, &nodes.next_velocity_columns}) {
    *columns = space.take();
    for (double* column : *columns) std::fill_n(column + nodes.in_columns, reach, 0.0);
  }
  return nodes;
}

/// Copies positions and velocities to where steps go on from them.
void Simulation::load(const NodeArrays& nodes) const {
  for_each_run([&](std::size_t first, std::size_t last) {
    split(
        blocks_, first, last,
        [&](std::size_t a, std::size_t b) {
          best_kernels().to_columns(positions_.data(), a, b, nodes.position_columns);
          best_kernels().to_columns(velocities_.data(), a, b, nodes.velocity_columns);
        },
        [&](std::size_t n, std::size_t slot) {
          nodes.positions[slot] = positions_[n];
          nodes.velocities[slot] = velocities_[n];
          nodes.inverse_mass_at_slots[slot] = inverse_mass_[n];
        });
  });
}

/// Copies them back.
void Simulation::store(const NodeArrays& nodes) {
  for_each_run([&](std::size_t first, std::size_t last) {
    take(nodes.position_columns, nodes.positions, blocks_, first, last, positions_);
    take(nodes.velocity_columns, nodes.velocities, blocks_, first, last, velocities_);
  });
}

/// Copies the next velocities to `forces_`.
void Simulation::take_next_velocities(const NodeArrays& nodes) {
  for_each_run([&](std::size_t first, std::size_t last) {
    take(nodes.next_velocity_columns, nodes.forces, blocks_, first, last, forces_);
  });
}

/// How many steps blocks go through before the next ones do, if so many are wanted. As many as it takes until
/// memory is no longer waited for; where all nodes stay in a cache, several steps are of use only if there
/// are no other blocks.
std::size_t Simulation::steps_at_once() const {
  const std::size_t blocks = blocks_.blocks().size();
  if (blocks == 1) return 64;
  if (positions_.size() <= 32768 || !blocks_.neighbours_only()) return 1;
  return most_steps_in_trapezoids(blocks, 8);
}

/// Finds the next velocities, or without an update what acts on each node but gravity and air_drag, which go
/// with the mass; one block of nodes after the other or at the same time. When nodes move as well, goes
/// `steps` steps, from array to array. Returns whether all velocities are sound.
bool Simulation::go_through_blocks(const VelocityUpdate* update, const NodeArrays& nodes, std::size_t steps) {
  const Vectors& given = surroundings.normal_drag > 0 ? air_forces_ : external_forces_;
  const std::vector<SpringBlock>& blocks = blocks_.blocks();
  const std::vector<SpringDiagonal>& diagonals = blocks_.diagonals();
  std::array<NodeArrays, 2> arrays{nodes, nodes};  // of steps with even and with odd numbers
  arrays[1].step_on();
  std::fill(sound_.begin(), sound_.end(), 1);
  const std::size_t kept = blocks.size() == 1 ? 1 : steps;
  const auto begin = [&] {
    if (diagonals.empty()) return;
    std::vector<ForceWindow>& windows = own_windows();
    if (windows.size() < kept) windows.resize(kept);
    for (ForceWindow& window : windows) window.close();
  };
  const auto advance = [&](std::size_t step, std::size_t b) {
    const NodeArrays& now = arrays[step % 2];
    const bool sound =
        diagonals.empty()
            ? advance_in_vectors(blocks[b], blocks[b].first, blocks[b].last, update, given, now)
            : advance_in_columns(blocks[b], diagonals, update, given, now, own_windows()[step % kept]);
    if (!sound) sound_[b] = 0;
  };
  go_in_trapezoids(executor, blocks.size(), steps, begin, advance);
  return std::find(sound_.begin(), sound_.end(), 0) == sound_.end();
}

}  // namespace cut

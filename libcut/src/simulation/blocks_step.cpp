// The nodes of all blocks go through one or several steps. In and out: positions and velocities in the arrays
// of kernels.hpp. Springs in diagonals are gone through in columns; for the other ones a block puts the nodes
// that these join side by side, a few of many.
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

/// Of the nodes that have a place in a block, by the names that its lists have for them.
struct PlacedArrays {
  Vectors positions, velocities, forces;
  std::vector<CacheLine> sums;

  void gather(const SpringBlock& block, const NodeArrays& nodes) {
    const auto &uncut = block.placed[0].nodes(), &copies = block.placed[1].nodes();
    const std::size_t size = 2 * std::max(uncut.size(), copies.size());
    if (forces.size() < size)
      for (Vectors* vectors : {&positions, &velocities, &forces}) vectors->resize(size);
    best_kernels().gather(uncut, nodes.position_columns, positions.data());
    best_kernels().gather(uncut, nodes.velocity_columns, velocities.data());
    for (std::size_t i = 0; i < copies.size(); ++i) {
      positions[2 * i + 1] = nodes.positions[copies[i] - nodes.in_columns];
      velocities[2 * i + 1] = nodes.velocities[copies[i] - nodes.in_columns];
    }
    std::fill_n(forces.begin(), size, PaddedVector{});
  }
};

/// What acts on a node beside its springs.
PaddedVector at(const Vectors& given, std::size_t node) {
  return given.empty() ? PaddedVector{} : given[node];
}

bool advance_in_vectors(const SpringBlock& block, const VelocityUpdate* update, const Vectors& given,
                        const NodeArrays& nodes) {
  const Kernels& kernels = best_kernels();
  if (given.empty())
    std::fill(nodes.forces + block.first, nodes.forces + block.last, PaddedVector{});
  else
    std::copy(given.data() + block.first, given.data() + block.last, nodes.forces + block.first);
  for (const std::uint32_t copy : block.copies) nodes.forces[copy] = at(given, copy);
  kernels.add_spring_forces(block.inner, nodes.positions, nodes.velocities, nodes.forces);
  kernels.add_forces_at_first_node(block.outer, nodes.positions, nodes.velocities, nodes.forces);
  return update == nullptr || kernels.advance_nodes(*update, nodes, block.first, block.last, block.copies);
}

/// Adds to `sums` the forces of springs in lists on nodes of the block, the first of which comes first, and
/// moves on its copies.
bool advance_placed(const SpringBlock& block, const VelocityUpdate* update, const Vectors& given,
                    const NodeArrays& nodes, PlacedArrays& placed, const ColumnArrays& sums) {
  placed.gather(block, nodes);
  const Kernels& kernels = best_kernels();
  kernels.add_spring_forces(block.inner, placed.positions.data(), placed.velocities.data(),
                            placed.forces.data());
  kernels.add_forces_at_first_node(block.outer, placed.positions.data(), placed.velocities.data(),
                                   placed.forces.data());
  const std::vector<std::uint32_t>& uncut = block.placed[0].nodes();
  for (std::size_t i = 0; i < uncut.size(); ++i) {
    // What another block has goes to an entry that is not read.
    const std::uint32_t n = std::min(uncut[i] - block.first, block.last - block.first);
    const PaddedVector& force = placed.forces[2 * i];
    sums[0][n] += force.x;
    sums[1][n] += force.y;
    sums[2][n] += force.z;
  }
  for (std::size_t i = 0; i < block.copies.size(); ++i) {
    const std::size_t copy = block.copies[i];
    nodes.forces[copy] = at(given, nodes.in_columns + copy) + placed.forces[2 * block.copy_places[i] + 1];
  }
  return update == nullptr || kernels.advance_nodes(*update, nodes, 0, 0, block.copies);
}

bool advance_in_columns(const SpringBlock& block, std::span<const SpringDiagonal> diagonals,
                        const VelocityUpdate* update, const Vectors& given, const NodeArrays& nodes,
                        ForceWindow& window) {
  SNIP_PER_THREAD PlacedArrays placed;
  const bool lists = !block.placed[0].nodes().empty() || !block.placed[1].nodes().empty();
  NodeRange range{diagonals, block.first, block.last, nullptr};
  ColumnArrays sums{};
  bool sound = true;
  if (lists || !given.empty()) {
    const std::size_t size = range.last - range.first;
    sums = ColumnSpace(placed.sums, 1, size + 1).take();
    if (given.empty())
      for (double* column : sums) std::fill_n(column, size, 0.0);
    else
      best_kernels().to_columns(given.data() + range.first, 0, size, sums);
    if (lists) sound = advance_placed(block, update, given, nodes, placed, sums);
    range.given = &sums;
  }
  return best_kernels().advance_range(range, update, nodes, window) && sound;
}

/// Of the thread that asks, by step where several go on in turn.
std::vector<ForceWindow>& own_windows() {
  SNIP_PER_THREAD std::vector<ForceWindow> windows;
  return windows;
}

/// Calls columns(first, last) and vectors(first, last) for nodes [first, last).
template <class InColumns, class InVectors>
void split(const NodeArrays& nodes, std::size_t first, std::size_t last, const InColumns& columns,
           const InVectors& vectors) {
  if (first < nodes.in_columns) columns(first, std::min(last, nodes.in_columns));
  if (last > nodes.in_columns) vectors(std::max(first, nodes.in_columns), last);
}

void put(const Vectors& from, const NodeArrays& nodes, std::size_t first, std::size_t last,
         const ColumnArrays& columns, PaddedVector* vectors) {
  split(
      nodes, first, last,
      [&](std::size_t a, std::size_t b) { best_kernels().to_columns(from.data(), a, b, columns); },
      [&](std::size_t a, std::size_t b) {
        std::copy(from.data() + a, from.data() + b, vectors + (a - nodes.in_columns));
      });
}

void take(const ColumnArrays& columns, const PaddedVector* vectors, const NodeArrays& nodes,
          std::size_t first, std::size_t last, Vectors& to) {
  split(
      nodes, first, last,
      [&](std::size_t a, std::size_t b) { best_kernels().from_columns(columns, a, b, to.data()); },
      [&](std::size_t a, std::size_t b) {
        std::copy(vectors + (a - nodes.in_columns), vectors + (b - nodes.in_columns), to.data() + a);
      });
}

}  // namespace

/// @param moves  whether nodes will move on as their velocities are found
NodeArrays Simulation::node_arrays(bool moves) {
  NodeArrays nodes{};
  nodes.moves = moves;
  nodes.inverse_mass = inverse_mass_.data();
  nodes.in_columns = blocks_.nodes_in_diagonals();
  const std::size_t in_vectors = positions_.size() - nodes.in_columns;
  vectors_.resize(4 * in_vectors);
  nodes.positions = vectors_.data();
  nodes.velocities = nodes.positions + in_vectors;
  nodes.forces = nodes.velocities + in_vectors;
  nodes.next_positions = nodes.forces + in_vectors;
  if (nodes.in_columns == 0) return nodes;
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
    put(positions_, nodes, first, last, nodes.position_columns, nodes.positions);
    put(velocities_, nodes, first, last, nodes.velocity_columns, nodes.velocities);
  });
}

/// Copies them back.
void Simulation::store(const NodeArrays& nodes) {
  for_each_run([&](std::size_t first, std::size_t last) {
    take(nodes.position_columns, nodes.positions, nodes, first, last, positions_);
    take(nodes.velocity_columns, nodes.velocities, nodes, first, last, velocities_);
  });
}

/// Copies the next velocities to `forces_`.
void Simulation::take_next_velocities(const NodeArrays& nodes) {
  for_each_run([&](std::size_t first, std::size_t last) {
    take(nodes.next_velocity_columns, nodes.forces, nodes, first, last, forces_);
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
    std::vector<ForceWindow>& windows = own_windows();
    if (windows.size() < kept) windows.resize(kept);
    for (ForceWindow& window : windows) window.close();
  };
  const auto advance = [&](std::size_t step, std::size_t b) {
    const NodeArrays& now = arrays[step % 2];
    const bool sound = diagonals.empty() ? advance_in_vectors(blocks[b], update, given, now)
                                         : advance_in_columns(blocks[b], diagonals, update, given, now,
                                                              own_windows()[step % kept]);
    if (!sound) sound_[b] = 0;
  };
  go_in_trapezoids(executor, blocks.size(), steps, begin, advance);
  return std::find(sound_.begin(), sound_.end(), 0) == sound_.end();
}

}  // namespace cut

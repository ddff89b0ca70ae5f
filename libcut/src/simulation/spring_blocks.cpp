// Keeping the blocks up to date. What a cut changes moves single entries; nothing is sorted or built anew.
#include "cut/spring_blocks.hpp"

#include <algorithm>

namespace cut {
namespace {

/// From 1,500 to 8,000 nodes, so that forces stay in the cache of a core; an even number of blocks unless
/// there is one. Only the number of nodes decides, since results depend on it.
std::size_t block_count(std::size_t nodes) {
  if (nodes <= 1536) return 1;
  const auto pairs_of = [](std::size_t n, std::size_t size) { return 2 * ((n + 2 * size - 1) / (2 * size)); };
  return std::max(pairs_of(nodes, 8192), pairs_of(std::min<std::size_t>(nodes, 32768), 2048));
}

void write(SpringArrays& to, std::size_t entry, std::array<std::uint32_t, 2> nodes, double rest_length,
           double stiffness, double damping) {
  to.nodes[entry] = nodes;
  to.rest_length[entry] = rest_length;
  to.stiffness[entry] = stiffness;
  to.damping[entry] = damping;
}

/// A free entry; four new ones when there is none, since kernels take four springs at once.
std::uint32_t take_entry(SpringArrays& springs, std::vector<std::uint32_t>& free, std::uint32_t node) {
  if (free.empty()) {
    const std::size_t size = springs.nodes.size();
    springs.nodes.resize(size + 4, {node, node});
    springs.rest_length.resize(size + 4);
    springs.stiffness.resize(size + 4);
    springs.damping.resize(size + 4);
    for (std::size_t i = 4; i-- > 0;) free.push_back(static_cast<std::uint32_t>(size + i));
  }
  const std::uint32_t entry = free.back();
  free.pop_back();
  return entry;
}

}  // namespace

void SpringBlocks::reset(std::size_t nodes) {
  const std::size_t count = block_count(nodes), size = std::max<std::size_t>(1, (nodes + count - 1) / count);
  blocks_.assign(count, {});
  block_of_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) block_of_[n] = static_cast<std::uint32_t>(n / size);
  for (std::size_t b = 0; b < count; ++b) {
    blocks_[b].first = static_cast<std::uint32_t>(std::min(nodes, b * size));
    blocks_[b].last = static_cast<std::uint32_t>(std::min(nodes, (b + 1) * size));
  }
}

void SpringBlocks::add_copy(std::uint32_t source) {
  const std::uint32_t block = block_of_[source];
  blocks_[block].copies.push_back(static_cast<std::uint32_t>(block_of_.size()));
  block_of_.push_back(block);
}

void SpringBlocks::set(const SpringArrays& springs, std::size_t i, SpringPlace& place) {
  const auto [a, b] = springs.nodes[i];
  std::array<std::uint32_t, 2> wanted{SpringPlace::none, SpringPlace::none};
  if (a != b) {
    wanted = {block_of_[a], block_of_[b]};
    if (wanted[0] == wanted[1]) wanted[1] = SpringPlace::none;
  }
  const auto is_inner = [](const std::array<std::uint32_t, 2>& block) {
    return block[1] == SpringPlace::none;
  };
  if (place.block != wanted) {
    for (std::size_t end = 0; end < 2; ++end) {
      if (place.block[end] == SpringPlace::none) continue;
      SpringBlock& block = blocks_[place.block[end]];
      const bool inner = is_inner(place.block);
      write(inner ? block.inner : block.outer, place.entry[end], {block.first, block.first}, 0, 0, 0);
      (inner ? block.free_inner : block.free_outer).push_back(place.entry[end]);
    }
    for (std::size_t end = 0; end < 2; ++end) {
      if (wanted[end] == SpringPlace::none) continue;
      SpringBlock& block = blocks_[wanted[end]];
      place.entry[end] = is_inner(wanted) ? take_entry(block.inner, block.free_inner, block.first)
                                          : take_entry(block.outer, block.free_outer, block.first);
    }
    place.block = wanted;
  }
  for (std::size_t end = 0; end < 2; ++end) {
    if (wanted[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[wanted[end]];
    const std::array<std::uint32_t, 2> nodes{end == 0 ? a : b, end == 0 ? b : a};
    write(is_inner(wanted) ? block.inner : block.outer, place.entry[end], nodes, springs.rest_length[i],
          springs.stiffness[i], springs.damping[i]);
  }
}

}  // namespace cut

// Keeping the blocks up to date. What a cut changes moves single entries; nothing is sorted or built anew.
#include "cut/spring_blocks.hpp"

#include <algorithm>
#include <utility>

namespace cut {
namespace {

/// From 1,500 to 8,000 nodes, so that forces stay in the cache of a core; an even number of blocks unless
/// there is one. Only the number of nodes decides, since results depend on it.
std::size_t block_count(std::size_t nodes) {
  if (nodes <= 1536) return 1;
  const auto pairs_of = [](std::size_t n, std::size_t size) { return 2 * ((n + 2 * size - 1) / (2 * size)); };
  return std::max(pairs_of(nodes, 8192), pairs_of(std::min<std::size_t>(nodes, 32768), 2048));
}

/// Below, to go through columns costs more than it gains.
constexpr std::size_t smallest_in_diagonals = 64;

/// Nodes of each block, a multiple of 4; the last one has what is left.
std::size_t block_size(std::size_t nodes) {
  const std::size_t count = block_count(nodes);
  return std::max<std::size_t>(4, ((nodes + count - 1) / count + 3) / 4 * 4);
}

void write(SpringArrays& to, std::size_t entry, double rest_length, double stiffness, double damping) {
  to.rest_length[entry] = rest_length;
  to.stiffness[entry] = stiffness;
  to.damping[entry] = damping;
}

void write(SpringDiagonal& to, std::size_t entry, double rest_length, double stiffness, double damping) {
  FourSprings& four = to.springs[entry / 4];
  four.rest_length[entry % 4] = rest_length;
  four.stiffness[entry % 4] = stiffness;
  four.damping[entry % 4] = damping;
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

std::vector<std::uint32_t> frequent_offsets(std::span<const SpringArrays* const> lists, std::size_t nodes) {
  std::vector<std::uint32_t> all;
  for (const SpringArrays* springs : lists)
    for (const auto& [a, b] : springs->nodes)
      if (a != b) all.push_back(std::max(a, b) - std::min(a, b));
  std::sort(all.begin(), all.end());
  // An entry of a diagonal costs less than half of a spring anywhere, used or not. Far offsets would make a
  // block read much of its neighbours.
  std::vector<std::uint32_t> frequent;
  std::size_t taken = 0;
  for (auto i = all.begin(); i != all.end() && frequent.size() < most_diagonals;) {
    const auto begin = i;
    i = std::upper_bound(i, all.end(), *begin);
    const auto count = static_cast<std::size_t>(i - begin);
    if (5 * count < 2 * nodes || 2 * *begin > block_size(nodes)) continue;
    frequent.push_back(*begin);
    taken += count;
  }
  return taken < nodes || nodes < smallest_in_diagonals ? std::vector<std::uint32_t>{} : frequent;
}

void SpringBlocks::reset(std::size_t nodes, std::vector<std::uint32_t> offsets) {
  offsets_ = std::move(offsets);
  loose_ = false;
  const std::size_t size = block_size(nodes), count = std::max<std::size_t>(1, (nodes + size - 1) / size);
  blocks_.assign(count, {});
  block_of_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) block_of_[n] = static_cast<std::uint32_t>(n / size);
  for (std::size_t b = 0; b < count; ++b) {
    SpringBlock& block = blocks_[b];
    block.first = static_cast<std::uint32_t>(std::min(nodes, b * size));
    block.last = static_cast<std::uint32_t>(std::min(nodes, (b + 1) * size));
    block.uncut_nodes = static_cast<std::uint32_t>(nodes);
    for (const std::uint32_t offset : offsets_) {
      SpringDiagonal& d = block.diagonals.emplace_back();
      d.offset = offset;
      d.first = block.first < offset ? 0 : (block.first - offset) / 4 * 4;
      const std::size_t entries = (block.last - d.first + 3) / 4 * 4;
      d.springs.resize(entries / 4);
      d.used.resize(entries);
    }
  }
}

void SpringBlocks::add_copy(std::uint32_t source) {
  const std::uint32_t block = block_of_[source];
  blocks_[block].copies.push_back(static_cast<std::uint32_t>(block_of_.size()));
  block_of_.push_back(block);
  loose_ = true;
}

/// Where a spring between these nodes belongs that has been at `old`; entries of diagonals only.
SpringPlace SpringBlocks::place_for(std::array<std::uint32_t, 2> nodes, const SpringPlace& old) const {
  SpringPlace place;
  if (nodes[0] == nodes[1]) return place;
  const auto [low, high] = std::minmax(nodes[0], nodes[1]);
  const auto offset = std::find(offsets_.begin(), offsets_.end(), high - low);
  if (high < blocks_[0].uncut_nodes && offset != offsets_.end()) {
    place.diagonal = static_cast<std::uint32_t>(offset - offsets_.begin());
    place.block = {block_of_[low], block_of_[high]};
    for (std::size_t end = 0; end < 2; ++end)
      place.entry[end] = low - blocks_[place.block[end]].diagonals[place.diagonal].first;
  } else {
    place.block = {block_of_[nodes[0]], block_of_[nodes[1]]};
  }
  if (place.block[0] == place.block[1]) {
    place.block[1] = SpringPlace::none;
    place.entry[1] = 0;
  }
  if (place.diagonal != SpringPlace::none && place != old &&
      blocks_[place.block[0]].diagonals[place.diagonal].used[place.entry[0]] != 0) {
    // Two springs between the same nodes.
    place.diagonal = SpringPlace::none;
    place.entry = {};
    if (nodes[0] != low && place.block[1] != SpringPlace::none) std::swap(place.block[0], place.block[1]);
  }
  return place;
}

void SpringBlocks::leave(const SpringPlace& place) {
  const bool inner = place.block[1] == SpringPlace::none;
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    if (place.diagonal != SpringPlace::none) {
      write(block.diagonals[place.diagonal], place.entry[end], 0, 0, 0);
      block.diagonals[place.diagonal].used[place.entry[end]] = 0;
    } else {
      SpringArrays& list = inner ? block.inner : block.outer;
      list.nodes[place.entry[end]] = {block.first, block.first};
      write(list, place.entry[end], 0, 0, 0);
      (inner ? block.free_inner : block.free_outer).push_back(place.entry[end]);
    }
  }
}

void SpringBlocks::enter(SpringPlace& place) {
  const bool inner = place.block[1] == SpringPlace::none;
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    if (place.diagonal != SpringPlace::none) {
      block.diagonals[place.diagonal].used[place.entry[end]] = 1;
    } else {
      loose_ = true;
      place.entry[end] = inner ? take_entry(block.inner, block.free_inner, block.first)
                               : take_entry(block.outer, block.free_outer, block.first);
    }
  }
}

void SpringBlocks::set(const SpringArrays& springs, std::size_t i, SpringPlace& place) {
  const auto [a, b] = springs.nodes[i];
  SpringPlace wanted = place_for({a, b}, place);
  const bool loose = wanted.diagonal == SpringPlace::none;
  if (loose && place.diagonal == SpringPlace::none && wanted.block == place.block) wanted.entry = place.entry;
  if (wanted != place) {
    leave(place);
    enter(wanted);
    place = wanted;
  }
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    const auto copy_to = [&](auto& list) {
      write(list, place.entry[end], springs.rest_length[i], springs.stiffness[i], springs.damping[i]);
    };
    if (!loose) {
      copy_to(block.diagonals[place.diagonal]);
    } else {
      SpringArrays& list = place.block[1] == SpringPlace::none ? block.inner : block.outer;
      list.nodes[place.entry[end]] = {end == 0 ? a : b, end == 0 ? b : a};
      copy_to(list);
    }
  }
}

}  // namespace cut

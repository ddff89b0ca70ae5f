// Keeping the blocks up to date. What a cut changes moves single entries; nothing is sorted or built anew.
#include "cut/spring_blocks.hpp"

#include <algorithm>
#include <numeric>
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
std::size_t block_size(std::size_t nodes, std::span<const std::uint32_t> offsets) {
  const std::size_t count = block_count(nodes);
  const std::size_t size = std::max<std::size_t>(4, ((nodes + count - 1) / count + 3) / 4 * 4);
  if (offsets.empty() || nodes <= 32768) return size;
  // Several blocks stay in the cache while these go through some steps; few springs join two of them.
  return std::max<std::size_t>(2048, 4 * *std::max_element(offsets.begin(), offsets.end()));
}

FourSprings& four_at(std::vector<ListedSprings>& list, std::size_t entry) { return list[entry / 4].springs; }
FourSprings& four_at(SpringDiagonal& diagonal, std::size_t entry) { return diagonal.springs[entry / 4]; }

/// Writes the constants of a spring to a list or diagonal.
void write(auto& to, std::size_t entry, double rest_length, double stiffness, double damping) {
  FourSprings& four = four_at(to, entry);
  four.rest_length[entry % 4] = rest_length;
  four.stiffness[entry % 4] = stiffness;
  four.damping[entry % 4] = damping;
}

std::array<std::uint32_t, 2>& nodes_at(std::vector<ListedSprings>& list, std::size_t entry) {
  return list[entry / 4].nodes[entry % 4];
}

/// A free entry; four new ones when there is none, since kernels take four springs at once.
std::uint32_t take_entry(std::vector<ListedSprings>& list, std::vector<std::uint32_t>& free,
                         std::uint32_t nobody) {
  if (free.empty()) {
    const std::size_t size = 4 * list.size();
    list.emplace_back().nodes.fill({nobody, nobody});
    for (std::size_t i = 4; i-- > 0;) free.push_back(static_cast<std::uint32_t>(size + i));
  }
  const std::uint32_t entry = free.back();
  free.pop_back();
  return entry;
}

/// Whether a spring there joins two blocks that are not neighbours.
bool is_far(const SpringPlace& place) {
  const auto [low, high] = std::minmax(place.block[0], place.block[1]);
  return high != SpringPlace::none && high - low > 1;
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
    if (5 * count < 2 * nodes || 2 * *begin > block_size(nodes, {})) continue;
    frequent.push_back(*begin);
    taken += count;
  }
  return taken < nodes || nodes < smallest_in_diagonals ? std::vector<std::uint32_t>{} : frequent;
}

std::uint32_t HeldNodes::hold(std::uint32_t node, std::uint32_t next_slot) {
  const auto [found, is_new] = entries_.try_emplace(node, 0);
  if (is_new) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(nodes_.size()));
      nodes_.push_back({node, next_slot});
      holders_.push_back(0);
    }
    found->second = free_.back();
    free_.pop_back();
    nodes_[found->second].node = node;
  }
  ++holders_[found->second];
  return nodes_[found->second].slot;
}

void HeldNodes::let_go(std::uint32_t node) {
  const auto found = entries_.find(node);
  if (--holders_[found->second] > 0) return;
  free_.push_back(found->second);
  entries_.erase(found);
}

void SpringBlocks::reset(std::size_t nodes, std::vector<std::uint32_t> offsets) {
  const std::size_t size = block_size(nodes, offsets);
  const std::size_t count = std::max<std::size_t>(1, (nodes + size - 1) / size);
  blocks_.assign(count, {});
  block_of_.reserve(nodes + nodes / 8);
  block_of_.resize(nodes);
  uncut_nodes_ = nodes;
  for (std::size_t n = 0; n < nodes; ++n) block_of_[n] = static_cast<std::uint32_t>(n / size);
  for (std::size_t b = 0; b < count; ++b) {
    blocks_[b].first = static_cast<std::uint32_t>(std::min(nodes, b * size));
    blocks_[b].last = static_cast<std::uint32_t>(std::min(nodes, (b + 1) * size));
    if (!offsets.empty()) {
      blocks_[b].list_forces.resize((blocks_[b].last - blocks_[b].first + 3) / 4 + 1);
      blocks_[b].list_forces.back() = 4;
      blocks_[b].list_force_entries = 8;
    }
    blocks_[b].nobody = offsets.empty() ? blocks_[b].first : static_cast<std::uint32_t>(b);
  }
  slot_of_.clear();
  if (offsets.empty())
    for (std::vector<std::uint32_t>* slots : {&slot_of_, &node_at_}) slots->reserve(nodes + nodes / 8);
  node_at_.resize(offsets.empty() ? nodes : count);
  std::iota(node_at_.begin(), node_at_.end(), 0);
  if (offsets.empty()) slot_of_ = node_at_;
  diagonals_.assign(offsets.size(), {});
  for (std::size_t d = 0; d < offsets.size(); ++d) {
    diagonals_[d].offset = offsets[d];
    diagonals_[d].springs.resize((nodes + 3) / 4);
    diagonals_[d].used.resize(4 * diagonals_[d].springs.size());
  }
  far_springs_ = 0;
}

void SpringBlocks::add_copy(std::uint32_t source) {
  SpringBlock& block = blocks_[block_of_[source]];
  const auto copy = static_cast<std::uint32_t>(block_of_.size());
  const auto slot = static_cast<std::uint32_t>(node_at_.size());
  block.copies.push_back({copy, slot});
  slot_of_.push_back(slot);
  node_at_.push_back(copy);
  block_of_.push_back(block_of_[source]);
}

/// Where a spring between these nodes belongs that has been at `old`; the entry in a diagonal only.
SpringPlace SpringBlocks::place_for(std::array<std::uint32_t, 2> nodes, const SpringPlace& old) const {
  SpringPlace place;
  if (nodes[0] == nodes[1]) return place;
  const auto [low, high] = std::minmax(nodes[0], nodes[1]);
  for (std::uint32_t d = 0; d < diagonals_.size() && high < uncut_nodes_; ++d)
    if (diagonals_[d].offset == high - low) {
      place.diagonal = d;
      place.entry[0] = low;
      // Unless there are two springs between the same nodes.
      if (place == old || diagonals_[d].used[low] == 0) return place;
      place = {};
    }
  place.block = {block_of_[nodes[0]], block_of_[nodes[1]]};
  if (place.block[0] == place.block[1]) place.block[1] = SpringPlace::none;
  return place;
}

void SpringBlocks::leave(const SpringPlace& place) {
  if (is_far(place)) --far_springs_;
  if (place.diagonal != SpringPlace::none) {
    write(diagonals_[place.diagonal], place.entry[0], 0, 0, 0);
    diagonals_[place.diagonal].used[place.entry[0]] = 0;
  }
  const bool inner = place.block[1] == SpringPlace::none;
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    std::vector<ListedSprings>& list = inner ? block.inner : block.outer;
    let_go(block, nodes_at(list, place.entry[end]));
    write(list, place.entry[end], 0, 0, 0);
    (inner ? block.free_inner : block.free_outer).push_back(place.entry[end]);
  }
}

void SpringBlocks::enter(SpringPlace& place) {
  if (is_far(place)) ++far_springs_;
  if (place.diagonal != SpringPlace::none) diagonals_[place.diagonal].used[place.entry[0]] = 1;
  const bool inner = place.block[1] == SpringPlace::none;
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    place.entry[end] = inner ? take_entry(block.inner, block.free_inner, block.nobody)
                             : take_entry(block.outer, block.free_outer, block.nobody);
  }
}

/// Has an entry of a list join these nodes.
void SpringBlocks::join(SpringBlock& block, std::array<std::uint32_t, 2>& entry, std::uint32_t a,
                        std::uint32_t b) {
  const auto slot_of = [&](std::uint32_t node) {
    if (node >= nodes_in_diagonals()) return slot(node);
    const auto next = static_cast<std::uint32_t>(node_at_.size());
    const std::uint32_t slot = block.held.hold(node, next);
    if (slot == next) node_at_.push_back(node);
    node_at_[slot] = node;
    if (node >= block.first && node < block.last) {
      std::uint32_t& place = block.list_forces[(node - block.first) / 4];
      if (place == 0) place = std::exchange(block.list_force_entries, block.list_force_entries + 4);
    }
    return slot;
  };
  const std::array<std::uint32_t, 2> next{slot_of(a), slot_of(b)};
  let_go(block, entry);
  entry = next;
}

/// Has an entry of a list join nothing.
void SpringBlocks::let_go(SpringBlock& block, std::array<std::uint32_t, 2>& entry) {
  if (entry[0] != entry[1])
    for (const std::uint32_t slot : entry)
      if (node_at_[slot] < nodes_in_diagonals()) block.held.let_go(node_at_[slot]);
  entry = {block.nobody, block.nobody};
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
  const auto copy_to = [&](auto& list, std::uint32_t entry) {
    write(list, entry, springs.rest_length[i], springs.stiffness[i], springs.damping[i]);
  };
  if (!loose) copy_to(diagonals_[place.diagonal], place.entry[0]);
  for (std::size_t end = 0; end < 2; ++end) {
    if (place.block[end] == SpringPlace::none) continue;
    SpringBlock& block = blocks_[place.block[end]];
    std::vector<ListedSprings>& list = place.block[1] == SpringPlace::none ? block.inner : block.outer;
    join(block, nodes_at(list, place.entry[end]), end == 0 ? a : b, end == 0 ? b : a);
    copy_to(list, place.entry[end]);
  }
}

}  // namespace cut

#include "lattice/graph_index.hpp"

#include <algorithm>
#include <cstdlib>

namespace cut::lattice {
namespace {

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32) | b; }
std::uint64_t key(LatticePoint p) {
  return key(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y));
}
std::uint64_t ends(std::uint32_t from, std::uint32_t to) {
  return key(std::min(from, to), std::max(from, to));
}

template <class Map>
std::optional<std::uint32_t> find(const Map& map, std::uint64_t k) {
  const auto found = map.find(k);
  if (found == map.end()) return std::nullopt;
  return found->second;
}

}  // namespace

GraphIndex::NearSegment::NearSegment(LatticePoint a, LatticePoint b)
    : a_(a),
      bounds_{{std::min(a.x, b.x) - 1, std::min(a.y, b.y) - 1},
              {std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1}},
      dx_(std::int64_t{b.x} - a.x),
      dy_(std::int64_t{b.y} - a.y) {}

bool GraphIndex::NearSegment::operator()(const Box& box) const {
  if (!spatial::touch(box, bounds_)) return false;
  // The line misses the box when its middle lies further from it than its half diagonal reaches; all doubled.
  const std::int64_t x = std::int64_t{box.min[0]} + box.max[0] - 2 * std::int64_t{a_.x};
  const std::int64_t y = std::int64_t{box.min[1]} + box.max[1] - 2 * std::int64_t{a_.y};
  const std::int64_t width = std::int64_t{box.max[0]} - box.min[0] + 2;
  const std::int64_t height = std::int64_t{box.max[1]} - box.min[1] + 2;
  return std::abs(dx_ * y - dy_ * x) <= std::abs(dx_) * height + std::abs(dy_) * width;
}

void GraphIndex::add_node(std::uint32_t node, LatticePoint p) {
  nodes_.insert(Box{{p.x, p.y}, {p.x, p.y}}, node);
  node_at_.emplace(key(p), node);
}

std::optional<std::uint32_t> GraphIndex::node_at(LatticePoint p) const { return find(node_at_, key(p)); }

void GraphIndex::add_edge(std::uint32_t edge, std::uint32_t from, std::uint32_t to, LatticePoint a,
                          LatticePoint b) {
  handles_.resize(edge + std::size_t{1});
  handles_[edge] = edges_.insert(
      Box{{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}}, edge);
  edge_between_.emplace(ends(from, to), edge);
}

void GraphIndex::remove_edge(std::uint32_t edge, std::uint32_t from, std::uint32_t to) {
  edges_.erase(handles_[edge]);
  edge_between_.erase(ends(from, to));
}

std::optional<std::uint32_t> GraphIndex::edge_between(std::uint32_t from, std::uint32_t to) const {
  return find(edge_between_, ends(from, to));
}

}  // namespace cut::lattice

// Connected pieces of a triangle list; see the header, also for what sets them apart from `cut::pieces`.
#include "snip/pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace snip {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::size_t item) {
    auto i = static_cast<std::uint32_t>(item);
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The smaller item stands for both, so that results do not depend on the order of joins.
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// A side of a triangle: from its corner `corner` to the next one. Corners are numbered 3 * triangle + k.
struct Side {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t corner;
  auto operator<=>(const Side&) const = default;
};

std::uint32_t next_in_triangle(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::vector<Side> sorted_sides(std::span<const Triangle> triangles) {
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      sides.push_back({low, high, static_cast<std::uint32_t>(3 * t + k)});
    }
  std::ranges::sort(sides);
  return sides;
}

// Calls function(first, last) for the sides of each edge.
template <class Function>
void for_each_edge(const std::vector<Side>& sides, Function function) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low &&
           sides[last].high == sides[first].high)
      ++last;
    function(first, last);
    first = last;
  }
}

}  // namespace

Pieces find_pieces(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles) {
  UnionFind components(positions.size());
  for (const auto& [a, b, c] : triangles) {
    components.join(a, b);
    components.join(b, c);
  }

  // One entry for each component, found by the vertex that stands for it.
  Pieces result;
  std::vector<std::uint32_t> piece_of_root(positions.size(), no_index);
  result.piece_of_triangle.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    std::uint32_t& piece = piece_of_root[components.find(a)];
    if (piece == no_index) {
      piece = static_cast<std::uint32_t>(result.pieces.size());
      result.pieces.emplace_back();
    }
    result.piece_of_triangle.push_back(piece);
    Piece& p = result.pieces[piece];
    p.area += (positions[b] - positions[a]).cross(positions[c] - positions[a]).stableNorm() / 2;
    ++p.triangles;
    ++p.euler_characteristic;
  }
  std::vector<unsigned char> vertex_seen(positions.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t])
      if (std::exchange(vertex_seen[v], 1) == 0)
        ++result.pieces[result.piece_of_triangle[t]].euler_characteristic;

  // Corners of one vertex belong to the same fan when their triangles share an edge there. A boundary loop
  // runs from fan to fan.
  const std::vector<Side> sides = sorted_sides(triangles);
  UnionFind fans(triangles.size() * 3);
  const auto corner_at = [&](const Side& side, std::uint32_t vertex) {
    return triangles[side.corner / 3][side.corner % 3] == vertex ? side.corner
                                                                 : next_in_triangle(side.corner);
  };
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    --result.pieces[result.piece_of_triangle[sides[first].corner / 3]].euler_characteristic;
    for (std::size_t i = first + 1; i < last; ++i)
      for (const std::uint32_t vertex : {sides[i].low, sides[i].high})
        fans.join(corner_at(sides[first], vertex), corner_at(sides[i], vertex));
  });
  UnionFind loops(triangles.size() * 3);
  std::vector<std::uint32_t> boundary;
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (last - first != 1) return;
    const std::uint32_t corner = sides[first].corner;
    boundary.push_back(corner);
    loops.join(fans.find(corner), fans.find(next_in_triangle(corner)));
  });
  std::vector<std::uint32_t> roots;
  for (const std::uint32_t corner : boundary) roots.push_back(loops.find(fans.find(corner)));
  std::ranges::sort(roots);
  roots.erase(std::ranges::unique(roots).begin(), roots.end());
  for (const std::uint32_t root : roots) ++result.pieces[result.piece_of_triangle[root / 3]].boundary_loops;

  // Pieces were numbered by their first triangle, which a stable sort keeps among equals.
  std::vector<std::uint32_t> order(result.pieces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::uint32_t p) { return result.pieces[p].area; });
  std::vector<Piece> sorted;
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    sorted.push_back(result.pieces[order[i]]);
    rank[order[i]] = i;
  }
  result.pieces = std::move(sorted);
  for (std::uint32_t& piece : result.piece_of_triangle) piece = rank[piece];
  return result;
}

std::vector<std::size_t> sort_by_piece(Mesh& mesh, const Pieces& pieces) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t t) { return pieces.piece_of_triangle[t]; });
  const auto reorder = [&](auto& entries) {
    if (entries.empty()) return;
    auto sorted = entries;
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = entries[order[i]];
    entries = std::move(sorted);
  };
  reorder(mesh.triangles);
  reorder(mesh.polygon_of_triangle);
  reorder(mesh.uv_triangles);
  reorder(mesh.normal_triangles);
  std::vector<std::size_t> begin;
  std::size_t next = 0;
  for (const Piece& piece : pieces.pieces) {
    begin.push_back(next);
    next += piece.triangles;
  }
  return begin;
}

}  // namespace snip

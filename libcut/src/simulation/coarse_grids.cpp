#include "simulation/coarse_grids.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/vector3.hpp"
#include "simulation/implicit_kernels.hpp"
#include "simulation/implicit_system.hpp"

namespace cut {
namespace {

using Pair = std::array<std::uint32_t, 2>;

/// What a grid is laid over: the nodes of the cloth, or the points of a finer grid.
struct Points {
  std::vector<Eigen::Vector3d> places;  ///< in spacings of the new grid
  std::vector<Pair> joined;
};

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// The values at these points of the functions of a new grid, and where each of the functions is 1.
struct Cover {
  WeightRows rows;
  std::vector<Eigen::Vector3d> places;
};

/// A corner of a grid as one number. A grid has fewer than 2^20 cells along each axis (`coarse_grids`).
constexpr std::uint64_t axis_bits = 21;
Eigen::Vector3d place_of(std::uint64_t corner) {
  const auto along = [&](std::uint64_t axis) {
    return static_cast<double>((corner >> (axis * axis_bits)) & ((std::uint64_t{1} << axis_bits) - 1));
  };
  return {along(0), along(1), along(2)};
}

/// A function belongs to a corner of the grid and to points around it that are joined with each other there.
Cover cover(const Points& points) {
  Cover result;
  std::vector<std::uint64_t> corners;
  for (const Eigen::Vector3d& p : points.places) {
    std::array<std::array<double, 2>, 3> weights;
    std::uint64_t low = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = std::floor(p[static_cast<Eigen::Index>(axis)]);
      weights[axis][1] = p[static_cast<Eigen::Index>(axis)] - cell;
      weights[axis][0] = 1 - weights[axis][1];
      low += static_cast<std::uint64_t>(cell) << (axis * axis_bits);
    }
    for (std::uint64_t z = 0; z < 2; ++z)
      for (std::uint64_t y = 0; y < 2 && weights[2][z] > 0; ++y)
        for (std::uint64_t x = 0; x < 2; ++x) {
          const double weight = weights[0][x] * weights[1][y] * weights[2][z];
          if (!(weight > 0)) continue;
          corners.push_back(low + x + (y << axis_bits) + (z << (2 * axis_bits)));
          result.rows.weights.push_back(weight);
        }
    result.rows.begins.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  const std::vector<std::uint32_t>& begins = result.rows.begins;
  std::vector<std::uint32_t> parents(corners.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (const auto& [a, b] : points.joined)
    for (std::uint32_t i = begins[a]; i < begins[a + 1]; ++i)
      for (std::uint32_t k = begins[b]; k < begins[b + 1]; ++k)
        if (corners[i] == corners[k]) {
          const auto [first, second] = std::minmax({root_of(parents, i), root_of(parents, k)});
          parents[second] = first;
        }
  result.rows.columns.resize(corners.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t root = root_of(parents, i);
    if (root == i) {
      result.rows.columns[i] = static_cast<std::uint32_t>(result.places.size());
      result.places.push_back(place_of(corners[i]));
    } else {
      result.rows.columns[i] = result.rows.columns[root];
    }
  }
  return result;
}

bool same_columns(const WeightRows& rows, std::size_t a, std::size_t b) {
  const std::size_t size = rows.begins[a + 1] - rows.begins[a];
  if (rows.begins[b + 1] - rows.begins[b] != size) return false;
  const std::uint32_t *const of_a = &rows.columns[rows.begins[a]], *const of_b =
                                                                       &rows.columns[rows.begins[b]];
  for (std::size_t i = 0; i < size; ++i)
    if (of_a[i] != of_b[i]) return false;
  return true;
}

/// Functions that share a point.
std::vector<Pair> overlaps(const WeightRows& rows) {
  std::vector<Pair> result;
  for (std::size_t p = 0; p + 1 < rows.begins.size(); ++p) {
    if (p > 0 && same_columns(rows, p, p - 1)) continue;
    for (std::size_t i = rows.begins[p]; i < rows.begins[p + 1]; ++i)
      for (std::size_t k = rows.begins[p]; k < i; ++k) result.push_back({rows.columns[k], rows.columns[i]});
  }
  return result;
}

/// @param columns  how many there are
WeightRows transposed(const WeightRows& rows, std::size_t columns) {
  WeightRows result;
  result.begins.assign(columns + 1, 0);
  for (const std::uint32_t c : rows.columns) ++result.begins[c + 1];
  std::partial_sum(result.begins.begin(), result.begins.end(), result.begins.begin());
  result.columns.resize(rows.columns.size());
  result.weights.resize(rows.weights.size());
  std::vector<std::uint32_t> next(result.begins.begin(), result.begins.end() - 1);
  for (std::uint32_t r = 0; r + 1 < rows.begins.size(); ++r)
    for (std::size_t i = rows.begins[r]; i < rows.begins[r + 1]; ++i) {
      const std::uint32_t to = next[rows.columns[i]]++;
      result.columns[to] = r;
      result.weights[to] = rows.weights[i];
    }
  return result;
}

/// @param columns  how many b has
WeightRows product(const WeightRows& a, const WeightRows& b, std::size_t columns) {
  WeightRows result;
  std::vector<double> sums(columns, 0);  // weights are > 0
  for (std::size_t r = 0; r + 1 < a.begins.size(); ++r) {
    for (std::size_t i = a.begins[r]; i < a.begins[r + 1]; ++i)
      for (std::size_t k = b.begins[a.columns[i]]; k < b.begins[a.columns[i] + 1]; ++k) {
        double& sum = sums[b.columns[k]];
        if (sum == 0) result.columns.push_back(b.columns[k]);
        sum += a.weights[i] * b.weights[k];
      }
    for (std::size_t i = result.begins.back(); i < result.columns.size(); ++i)
      result.weights.push_back(std::exchange(sums[result.columns[i]], 0));
    result.begins.push_back(static_cast<std::uint32_t>(result.columns.size()));
  }
  return result;
}

/// How much finer a grid is than the next one, and than the springs are long.
constexpr double ratio = 4;

/// Adds factor · from.
void add(SymmetricBlock& to, double factor, const SymmetricBlock& from) {
  for (std::size_t k = 0; k < 6; ++k) to[k] += factor * from[k];
}

/// The block of the system that a spring adds for its other node.
SymmetricBlock block_of(const ImplicitWork::FourCouplings& c, std::size_t lane) {
  SymmetricBlock block{c.across[lane], c.across[lane], c.across[lane], 0, 0, 0};
  add_square(block, c.along[lane], {c.x[lane], c.y[lane], c.z[lane]});
  return block;
}

/// Adds to blocks of functions what a spring with this block gives, whose ends have these rows; the second
/// one is held if it has none.
void add_spring(std::vector<SymmetricBlock>& blocks, const SymmetricBlock& block, const WeightRows& rows,
                std::size_t a, std::size_t b, bool b_held) {
  const auto add_at = [&](std::size_t i, double difference) {
    add(blocks[rows.columns[i]], difference * difference, block);
  };
  const std::size_t begin_a = rows.begins[a], end_a = rows.begins[a + 1];
  const std::size_t begin_b = rows.begins[b], end_b = rows.begins[b + 1];
  if (b_held) {
    for (std::size_t i = begin_a; i < end_a; ++i) add_at(i, rows.weights[i]);
  } else if (same_columns(rows, a, b)) {  // most springs
    for (std::size_t i = begin_a; i < end_a; ++i)
      add_at(i, rows.weights[i] - rows.weights[i - begin_a + begin_b]);
  } else {
    const auto weight_in = [&](std::size_t begin, std::size_t end, std::uint32_t column) {
      for (std::size_t i = begin; i < end; ++i)
        if (rows.columns[i] == column) return rows.weights[i];
      return 0.0;
    };
    for (std::size_t i = begin_a; i < end_a; ++i)
      add_at(i, rows.weights[i] - weight_in(begin_b, end_b, rows.columns[i]));
    for (std::size_t i = begin_b; i < end_b; ++i)
      if (weight_in(begin_a, end_a, rows.columns[i]) == 0) add_at(i, rows.weights[i]);
  }
}

/// The blocks of the diagonal of the system that moves functions.
/// @param rows  their values at the nodes
void find_blocks(const ImplicitWork& work, const WeightRows& rows, std::vector<SymmetricBlock>& blocks) {
  for (std::size_t n = 0; n + 1 < rows.begins.size(); ++n) {
    if (!(work.inverse_mass[n] > 0)) continue;
    const SymmetricBlock own = cut::block_of(work.blocks, n);
    for (std::size_t i = rows.begins[n]; i < rows.begins[n + 1]; ++i)
      add(blocks[rows.columns[i]], rows.weights[i] * rows.weights[i], own);
    for (std::size_t s = work.row_begins[n / 4]; s < work.row_begins[n / 4 + 1]; ++s) {
      const std::size_t other = work.others[s][n % 4];
      const bool held = !(work.inverse_mass[other] > 0);
      if (other > n || (held && other != n))
        add_spring(blocks, block_of(work.couplings[s], n % 4), rows, n, other, held);
    }
  }
}

}  // namespace

std::vector<CoarseGrid> coarse_grids(const HybridMesh& mesh, const SpringArrays& springs) {
  std::vector<CoarseGrid> grids;
  Points points;
  double length_of_all = 0;
  for (std::size_t i = 0; i < springs.nodes.size(); ++i) {
    if (springs.nodes[i][0] == springs.nodes[i][1]) continue;
    points.joined.push_back(springs.nodes[i]);
    length_of_all += springs.rest_length[i];
  }
  const std::vector<Eigen::Vector3d>& rest = mesh.ancestors.rest_positions;
  Eigen::Vector3d low = rest.front(), high = low;
  for (const Eigen::Vector3d& p : rest) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = length(high - low);
  double spacing = std::max(ratio * length_of_all / static_cast<double>(points.joined.size()), 2e-6 * extent);
  if (!(spacing > 0)) spacing = 1;  // of springs whose squared length is less than any number
  for (const AncestorNodeId n : mesh.buffers.nodes)
    points.places.emplace_back((rest[n.index()] - low) / spacing);
  for (;; spacing *= ratio) {
    Cover covered = cover(points);
    const std::size_t functions = covered.places.size();
    CoarseGrid& grid = grids.emplace_back();
    grid.to_finer = std::move(covered.rows);
    grid.from_finer = transposed(grid.to_finer, functions);
    if (grids.size() > 1) {
      const CoarseGrid& finer = *(grids.end() - 2);
      grid.at_nodes = product(grids.size() == 2 ? finer.to_finer : finer.at_nodes, grid.to_finer, functions);
    }
    grid.inverses.resize(functions);
    grid.residual.resize(functions);
    grid.correction.resize(functions);
    if (2 * spacing >= extent) return grids;
    points.joined = overlaps(grid.to_finer);
    points.places = std::move(covered.places);
    for (Eigen::Vector3d& p : points.places) p /= ratio;
  }
}

void look_at_system(ImplicitWork& work, const Executor& executor) {
  executor.for_each(work.grids.size(), [&](std::size_t g) {
    CoarseGrid& grid = work.grids[g];
    std::fill(grid.inverses.begin(), grid.inverses.end(), SymmetricBlock{});
    find_blocks(work, g == 0 ? grid.to_finer : grid.at_nodes, grid.inverses);
    for (SymmetricBlock& block : grid.inverses)
      if (block[0] > 0) block = inverse(block);  // 0 where all nodes are held
  });
}

void find_correction(ImplicitWork& work, const Executor& executor) {
  const ImplicitKernels& kernels = best_implicit_kernels();
  const auto for_each_part = [&](CoarseGrid& grid, const auto& body) {
    for_each_range(executor, grid.residual.size(), 64,
                   [&](std::size_t, std::size_t first, std::size_t last) { body(first, last); });
  };
  const PaddedVector* residual = work.residual.data();
  for (CoarseGrid& grid : work.grids) {
    for_each_part(grid, [&](std::size_t first, std::size_t last) {
      std::fill(grid.residual.begin() + static_cast<std::ptrdiff_t>(first),
                grid.residual.begin() + static_cast<std::ptrdiff_t>(last), PaddedVector{});
      kernels.add_weighted(grid.from_finer, residual, grid.residual.data(), first, last);
    });
    residual = grid.residual.data();
  }
  for (std::size_t g = work.grids.size(); g-- > 0;) {
    CoarseGrid& grid = work.grids[g];
    for_each_part(grid, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        grid.correction[i] = cut::product(grid.inverses[i], grid.residual[i]);
      if (g + 1 < work.grids.size())
        kernels.add_weighted(work.grids[g + 1].to_finer, work.grids[g + 1].correction.data(),
                             grid.correction.data(), first, last);
    });
  }
}

}  // namespace cut

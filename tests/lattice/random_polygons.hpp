/// @file
/// Random weakly simple polygons: unions of grid cells, which touch themselves and enclose holes and slits
/// all by themselves, and star-shaped ones.
#pragma once
#include <rapidcheck.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "polygons.hpp"

namespace cut::lattice {

/// How loops go on where two cells meet in a point only.
enum class AtPinch {
  stay,   ///< around the same cell: the wedges of the corners there are disjoint
  cross,  ///< over to the other cell: loops touch that are given as separate
};

/// Coloured cells, row by row. Cells of one colour hang together where no wall is between them; a wall with
/// the same polygon on both sides is a slit in it.
struct Cells {
  int width, height;
  std::vector<int> colour;
  std::vector<bool> wall_right;  ///< by cell: a wall to the cell at x + 1
  std::vector<bool> wall_above;  ///< by cell: a wall to the cell at y + 1

  [[nodiscard]] std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  /// True when one can go from cell (x, y) to the next one in direction d (+x, +y, -x, -y).
  [[nodiscard]] bool open(int x, int y, std::size_t d) const {
    const int to_x = x + (d == 0) - (d == 2), to_y = y + (d == 1) - (d == 3);
    if (to_x < 0 || to_y < 0 || to_x >= width || to_y >= height) return false;
    const std::size_t from = index(x, y), to = index(to_x, to_y);
    const bool wall = d % 2 == 0 ? wall_right[std::min(from, to)] : wall_above[std::min(from, to)];
    return colour[from] == colour[to] && !wall;
  }
};

constexpr std::array<LatticePoint, 4> unit_step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Numbers the sets of cells that hang together.
inline std::vector<int> components(const Cells& cells, int& count) {
  std::vector<int> label(cells.colour.size(), -1);
  count = 0;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      if (label[cells.index(x, y)] >= 0) continue;
      std::vector<LatticePoint> stack = {{x, y}};
      while (!stack.empty()) {
        const LatticePoint cell = stack.back();
        stack.pop_back();
        label[cells.index(cell.x, cell.y)] = count;
        for (std::size_t d = 0; d < 4; ++d) {
          const LatticePoint to = {cell.x + unit_step[d].x, cell.y + unit_step[d].y};
          if (cells.open(cell.x, cell.y, d) && label[cells.index(to.x, to.y)] < 0) stack.push_back(to);
        }
      }
      ++count;
    }
  return label;
}

/// Which of the four unit steps from a grid point are edges of a polygon, the inside on their left.
using Leaving = std::map<LatticePoint, std::array<bool, 4>>;

inline Leaving edges_around(const Cells& cells, const std::vector<int>& label, int wanted) {
  Leaving leaving;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      if (label[cells.index(x, y)] != wanted) continue;
      if (!cells.open(x, y, 3)) leaving[{x, y}][0] = true;
      if (!cells.open(x, y, 0)) leaving[{x + 1, y}][1] = true;
      if (!cells.open(x, y, 1)) leaving[{x + 1, y + 1}][2] = true;
      if (!cells.open(x, y, 2)) leaving[{x, y + 1}][3] = true;
    }
  return leaving;
}

inline std::vector<std::vector<LatticePoint>> loops_of(const Leaving& leaving, AtPinch at_pinch) {
  const std::array<std::size_t, 4> turns = at_pinch == AtPinch::stay ? std::array<std::size_t, 4>{1, 0, 3, 2}
                                                                     : std::array<std::size_t, 4>{3, 0, 1, 2};
  Leaving left = leaving;
  std::vector<std::vector<LatticePoint>> loops;
  for (const auto& [start, directions] : leaving)
    for (std::size_t first = 0; first < 4; ++first) {
      if (!left[start][first]) continue;
      auto& loop = loops.emplace_back();
      LatticePoint p = start;
      std::size_t d = first;
      while (left[p][d]) {
        left[p][d] = false;
        loop.push_back(p);
        p = {p.x + unit_step[d].x, p.y + unit_step[d].y};
        const auto& ways = leaving.at(p);
        d = (d +
             *std::find_if(turns.begin(), turns.end(), [&](std::size_t t) { return ways[(d + t) % 4]; })) %
            4;
      }
    }
  return loops;
}

/// Polygons that partition a rectangle, in one of three shapes: cells with random widths, sheared by an
/// affine map and with straight corners that come and go; cells with displaced corners; a plain grid.
inline std::vector<Polygon> random_cell_polygons(AtPinch at_pinch) {
  Cells cells;
  const int width = cells.width = *rc::gen::inRange(1, 11);
  const int height = cells.height = *rc::gen::inRange(1, 11);
  const auto size = static_cast<std::size_t>(width * height);
  cells.colour = *rc::gen::container<std::vector<int>>(size, rc::gen::weightedElement<int>({{3, 0}, {2, 1}}));
  // Crossing over at a pinch is only well defined without slits.
  const auto open = at_pinch == AtPinch::cross ? std::size_t{0} : *rc::gen::element<std::size_t>(0, 1, 5);
  const auto wall =
      open == 0 ? rc::gen::just(false) : rc::gen::weightedElement<bool>({{open, false}, {1, true}});
  cells.wall_right = *rc::gen::container<std::vector<bool>>(size, wall);
  cells.wall_above = *rc::gen::container<std::vector<bool>>(size, wall);
  const int shape = *rc::gen::inRange(0, 3);
  const auto lines = [](int n) {
    std::vector<std::int32_t> at = {0};
    for (int i = 0; i < n; ++i) at.push_back(at.back() + *rc::gen::inRange(1, 40));
    return at;
  };
  const auto xs = lines(width), ys = lines(height);
  // Sheared, never mirrored; the first row keeps x in range for every height.
  const LatticePoint ex = {*rc::gen::inRange(20, 5000), *rc::gen::inRange(0, 5000)};
  const LatticePoint ey = {*rc::gen::inRange(0, 20), *rc::gen::inRange(5001, 30000)};
  const auto displacement = *rc::gen::container<std::vector<std::pair<int, int>>>(
      static_cast<std::size_t>((width + 1) * (height + 1)),
      rc::gen::pair(rc::gen::inRange(-240, 241), rc::gen::inRange(-240, 241)));
  const auto place = [&](LatticePoint p) -> LatticePoint {
    if (shape == 2) return {p.x + 7, p.y + 9};
    if (shape == 1) {
      const auto& [dx, dy] = displacement[static_cast<std::size_t>(p.y * (width + 1) + p.x)];
      return {1000 * (p.x + 1) + dx, 1000 * (p.y + 1) + dy};
    }
    const std::int32_t x = xs[static_cast<std::size_t>(p.x)], y = ys[static_cast<std::size_t>(p.y)];
    return {ex.x * x + ey.x * y, ex.y * x + ey.y * y};
  };
  int count = 0;
  const auto label = components(cells, count);
  std::vector<Polygon> result;
  for (int wanted = 0; wanted < count; ++wanted) {
    const Leaving leaving = edges_around(cells, label, wanted);
    Polygon polygon;
    for (const auto& loop : loops_of(leaving, at_pinch)) {
      std::vector<LatticePoint> placed;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const LatticePoint before = loop[i == 0 ? loop.size() - 1 : i - 1];
        const LatticePoint after = loop[(i + 1) % loop.size()];
        // A straight corner may go, unless another corner is at the same position.
        const auto& ways = leaving.at(loop[i]);
        const bool straight = before != after && orientation(before, loop[i], after) == 0;
        if (straight && shape != 1 && std::count(ways.begin(), ways.end(), true) == 1 &&
            *rc::gen::arbitrary<bool>())
          continue;
        placed.push_back(place(loop[i]));
      }
      polygon.add_loop(placed);
    }
    result.push_back(std::move(polygon));
  }
  return result;
}

/// A hull around a centre with up to `most` corners at random distances, with corners added on its edges.
inline Polygon random_star(int most) {
  const int n = *rc::gen::inRange(3, most + 1);
  std::vector<LatticePoint> loop;
  const LatticePoint centre = {1 << 22, 1 << 22};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    const double radius = *rc::gen::inRange(1 << 10, 1 << 18);
    // Multiples of 4 leave room for exact points on the edges.
    loop.push_back({centre.x + 4 * static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                    centre.y + 4 * static_cast<std::int32_t>(std::lround(radius * std::sin(angle)))});
  }
  std::vector<LatticePoint> all;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const LatticePoint a = loop[i], b = loop[(i + 1) % loop.size()];
    all.push_back(a);
    for (int k = 1; k < 4; ++k)
      if (*rc::gen::inRange(0, 4) == 0)
        all.push_back({a.x + k * ((b.x - a.x) / 4), a.y + k * ((b.y - a.y) / 4)});
  }
  Polygon result;
  result.add_loop(all);
  return result;
}

}  // namespace cut::lattice

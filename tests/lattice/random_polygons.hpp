/// @file
/// Random weakly simple polygons: unions of grid cells, which touch themselves and enclose holes all by
/// themselves, and star-shaped ones.
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

/// The loops around the cells (x, y) with label[y * width + x] == wanted, one unit wide, the inside on the
/// left.
inline std::vector<std::vector<LatticePoint>> loops_of_cells(const std::vector<int>& label, int width,
                                                             int wanted, AtPinch at_pinch) {
  const int height = static_cast<int>(label.size()) / width;
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height &&
           label[static_cast<std::size_t>(y * width + x)] == wanted;
  };
  constexpr std::array<LatticePoint, 4> step = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  std::map<LatticePoint, std::array<bool, 4>> leaving;  // by direction
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!inside(x, y)) continue;
      if (!inside(x, y - 1)) leaving[{x, y}][0] = true;
      if (!inside(x + 1, y)) leaving[{x + 1, y}][1] = true;
      if (!inside(x, y + 1)) leaving[{x + 1, y + 1}][2] = true;
      if (!inside(x - 1, y)) leaving[{x, y + 1}][3] = true;
    }
  std::vector<std::vector<LatticePoint>> loops;
  for (auto& [start, directions] : leaving)
    for (std::size_t first = 0; first < 4; ++first) {
      if (!directions[first]) continue;
      auto& loop = loops.emplace_back();
      LatticePoint p = start;
      std::size_t d = first;
      while (leaving[p][d]) {
        leaving[p][d] = false;
        loop.push_back(p);
        p = {p.x + step[d].x, p.y + step[d].y};
        // At a pinch both turns are open; everywhere else one direction is.
        const std::array<std::size_t, 3> turns = {at_pinch == AtPinch::stay ? d + 1 : d + 3, d,
                                                  at_pinch == AtPinch::stay ? d + 3 : d + 1};
        for (const std::size_t turn : turns)
          if (leaving[p][turn % 4]) {
            d = turn % 4;
            break;
          }
      }
    }
  return loops;
}

/// Numbers the sets of cells of one colour that hang together by edges.
inline std::vector<int> components(const std::vector<int>& colour, int width, int& count) {
  std::vector<int> label(colour.size(), -1);
  count = 0;
  for (int start = 0; start < static_cast<int>(colour.size()); ++start) {
    if (label[static_cast<std::size_t>(start)] >= 0) continue;
    std::vector<int> stack = {start};
    label[static_cast<std::size_t>(start)] = count;
    while (!stack.empty()) {
      const int cell = stack.back();
      stack.pop_back();
      const auto visit = [&](bool exists, int other) {
        if (!exists || label[static_cast<std::size_t>(other)] >= 0) return;
        if (colour[static_cast<std::size_t>(other)] != colour[static_cast<std::size_t>(start)]) return;
        label[static_cast<std::size_t>(other)] = count;
        stack.push_back(other);
      };
      visit(cell % width > 0, cell - 1);
      visit(cell % width < width - 1, cell + 1);
      visit(cell >= width, cell - width);
      visit(cell + width < static_cast<int>(colour.size()), cell + width);
    }
    ++count;
  }
  return label;
}

/// Polygons that partition a rectangle, in one of three shapes: cells with random widths, sheared by an
/// affine map and with straight corners that come and go; cells with displaced corners; a plain grid.
inline std::vector<Polygon> random_cell_polygons(AtPinch at_pinch) {
  const int width = *rc::gen::inRange(1, 11);
  const int height = *rc::gen::inRange(1, 11);
  const auto colour = *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(width * height),
                                                            rc::gen::weightedElement<int>({{3, 0}, {2, 1}}));
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
  const auto label = components(colour, width, count);
  std::vector<Polygon> result;
  for (int wanted = 0; wanted < count; ++wanted) {
    Polygon polygon;
    for (const auto& loop : loops_of_cells(label, width, wanted, at_pinch)) {
      std::vector<LatticePoint> placed;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const LatticePoint before = loop[i == 0 ? loop.size() - 1 : i - 1],
                           after = loop[(i + 1) % loop.size()];
        const bool straight = orientation(before, loop[i], after) == 0;
        // A displaced corner is kept: another component may have a corner there.
        if (straight && shape != 1 && *rc::gen::arbitrary<bool>()) continue;
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

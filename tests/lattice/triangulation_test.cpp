// Triangulation of weakly simple polygons: hand-made cases, then random ones, all properties checked exactly.
#include "lattice/triangulation.hpp"

#include <doctest/doctest.h>

#include "polygons.hpp"

using namespace cut;
using namespace cut::lattice;

namespace {

const Metric equilateral({1.0, 1.0, 1.0});

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles checked(const Polygon& p, std::size_t expected, bool by_corner = true,
                  const Metric& metric = equilateral) {
  Triangles triangles;
  TriangulationScratch scratch;
  CHECK(triangulate(p.points, p.loop_ends, metric, triangles, scratch));
  CHECK(fault(p, triangles, by_corner) == "");
  CHECK(triangles.size() == expected);
  return triangles;
}

}  // namespace

TEST_CASE("convex and concave polygons") {
  checked(polygon({{{0, 0}, {1, 0}, {0, 1}}}), 1);
  checked(polygon({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}), 2);
  checked(polygon({{{0, 0}, {4, 0}, {1, 1}, {0, 4}}}), 2);
  checked(polygon({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}), 4);
}

TEST_CASE("corners on straight sides make no flat triangle and are not lost") {
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 1}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}}), 7);
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}}}), 3);
  // All but one corner on one line.
  checked(polygon({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {9, 0}, {0, 1}}}), 4);
}

TEST_CASE("holes") {
  const std::vector<LatticePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  checked(polygon({square, {{3, 3}, {3, 6}, {6, 6}, {6, 3}}}), 8);
  // The hull may come second.
  checked(polygon({{{3, 3}, {3, 6}, {6, 6}, {6, 3}}, square}), 8);
  // Holes that see only each other to the left, with corners at equal heights.
  checked(polygon({square,
                   {{1, 1}, {1, 8}, {2, 8}, {2, 1}},
                   {{3, 1}, {3, 8}, {4, 8}, {4, 1}},
                   {{5, 1}, {5, 8}, {6, 1}}}),
          4 + 4 + 4 + 3 + 6 - 2);
}

TEST_CASE("a hole that touches the hull opens it") {
  const std::vector<LatticePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  checked(polygon({square, {{0, 0}, {3, 6}, {6, 3}}}), 5, false);
  // As one loop, the hull touches itself.
  checked(polygon({{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 6}, {6, 3}}}), 5);
}

TEST_CASE("holes that touch each other are one hole") {
  const std::vector<LatticePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  checked(polygon({square, {{2, 2}, {2, 4}, {4, 4}}, {{4, 4}, {6, 6}, {6, 4}}}), 10 - 2 + 2, false);
  checked(polygon({square, {{2, 2}, {2, 4}, {4, 4}, {6, 6}, {6, 4}, {4, 4}}}), 10 - 2 + 2);
}

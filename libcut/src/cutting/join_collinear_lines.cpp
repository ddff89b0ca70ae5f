#include "cutting/join_collinear_lines.hpp"

#include <algorithm>
#include <tuple>

#include "lattice/orientation.hpp"
#include "lattice/sort_unique.hpp"

namespace cut {
namespace {

using lattice::operator-;
using Index = std::uint32_t;

struct Ending {
  std::uint32_t polygon;
  LineEnd end;
  Index line;
  bool operator<(const Ending& o) const {
    return std::tie(polygon, end.point, line) < std::tie(o.polygon, o.end.point, o.line);
  }
  [[nodiscard]] bool same_place(const Ending& o) const {
    return polygon == o.polygon && end.point == o.end.point;
  }
};

/// Within two lattice units of the chord, and between its ends.
bool close_to_chord(LatticePoint a, LatticePoint b, LatticePoint p) {
  const lattice::Vector ab = b - a;
  const auto squared = static_cast<double>(lattice::dot(ab, ab));
  const auto across = static_cast<double>(lattice::cross(ab, p - a));
  const std::int64_t along = lattice::dot(ab, p - a);
  return across * across <= 4 * squared && along > 0 && along < lattice::dot(ab, ab);
}

/// From the segment and not from its line: a chain that turns back along its chord is divided where it turns.
double squared_distance(LatticePoint a, LatticePoint b, LatticePoint p) {
  const lattice::Vector ab = b - a;
  const std::int64_t along = lattice::dot(ab, p - a);
  if (along <= 0) return static_cast<double>(lattice::dot(p - a, p - a));
  if (along >= lattice::dot(ab, ab)) return static_cast<double>(lattice::dot(p - b, p - b));
  const auto across = static_cast<double>(lattice::cross(ab, p - a));
  return across * across / static_cast<double>(lattice::dot(ab, ab));
}

/// Keeps the points of chain[first..last] that the chain cannot do without, ends left out (Ramer, Douglas,
/// Peucker). Chains whose furthest point is always near an end are divided in the middle from some depth on,
/// so that neither the stack nor the time grow with the square of their length.
void keep_needed(const std::vector<LineEnd>& chain, std::size_t first, std::size_t last, unsigned depth,
                 std::vector<LineEnd>& kept) {
  std::size_t furthest = first;
  double distance = -1;
  bool all_close = true;
  for (std::size_t i = first + 1; i < last; ++i) {
    if (close_to_chord(chain[first].point, chain[last].point, chain[i].point)) continue;
    all_close = false;
    const double off = squared_distance(chain[first].point, chain[last].point, chain[i].point);
    if (off <= distance) continue;
    distance = off;
    furthest = i;
  }
  if (all_close) return;
  constexpr unsigned deep = 40;
  if (depth >= deep) furthest = first + (last - first) / 2;
  keep_needed(chain, first, furthest, depth + 1, kept);
  kept.push_back(chain[furthest]);
  keep_needed(chain, furthest, last, depth + 1, kept);
}

bool free_point(const LineEnd& end) {
  return end.on == LineEnd::On::nothing && end.point[0] != 0 && end.point[1] != 0 && end.point[2] != 0;
}

}  // namespace

void join_collinear_lines(std::vector<CuttingLine>& lines) {
  for (CuttingLine& l : lines)
    if (l.b < l.a) std::swap(l.a, l.b);
  lattice::sort_unique(lines);
  if (lines.size() < 2) return;

  std::vector<Ending> endings;
  for (Index i = 0; i < lines.size(); ++i) {
    endings.push_back({lines[i].polygon, lines[i].a, i});
    endings.push_back({lines[i].polygon, lines[i].b, i});
  }
  std::sort(endings.begin(), endings.end());
  // Per line end: the line that goes on there, or itself.
  const auto number = static_cast<Index>(lines.size());
  std::vector<std::array<Index, 2>> next(number, {number, number});
  const auto side_at = [&](Index line, LatticePoint p) { return lines[line].a.point == p ? 0u : 1u; };
  for (std::size_t i = 0; i < endings.size();) {
    std::size_t end = i + 1;
    while (end < endings.size() && endings[end].same_place(endings[i])) ++end;
    if (end - i == 2 && free_point(endings[i].end) && free_point(endings[i + 1].end)) {
      const LatticePoint p = endings[i].end.point;
      next[endings[i].line][side_at(endings[i].line, p)] = endings[i + 1].line;
      next[endings[i + 1].line][side_at(endings[i + 1].line, p)] = endings[i].line;
    }
    i = end;
  }
  std::vector<CuttingLine> joined;
  std::vector<std::uint8_t> done(number, 0);
  std::vector<LineEnd> chain;
  std::vector<LineEnd> kept;
  const auto walk = [&](Index first,
                        unsigned side) {  // from the end of `first` opposite to `side`, on towards `side`
    chain.clear();
    Index line = first;
    unsigned ahead = side;
    chain.push_back(side == 0 ? lines[line].b : lines[line].a);
    while (line != number && done[line] == 0) {
      done[line] = 1;
      const LineEnd& end = ahead == 0 ? lines[line].a : lines[line].b;
      chain.push_back(end);
      const Index following = next[line][ahead];
      if (following != number) ahead = 1 - side_at(following, end.point);
      line = following;
    }
    // The same way round however the chain is divided.
    const LatticePoint begin = chain.front().point;
    const LatticePoint end = chain.back().point;
    if (end < begin ||
        (end == begin && lattice::orientation(begin, chain[1].point, chain[chain.size() - 2].point) < 0))
      std::reverse(chain.begin(), chain.end());
    kept.clear();
    kept.push_back(chain.front());
    keep_needed(chain, 0, chain.size() - 1, 0, kept);
    kept.push_back(chain.back());
    for (std::size_t k = 0; k + 1 < kept.size(); ++k)
      if (kept[k].point != kept[k + 1].point)
        joined.push_back(
            {lines[first].polygon, std::min(kept[k], kept[k + 1]), std::max(kept[k], kept[k + 1])});
  };
  for (Index i = 0; i < number; ++i) {
    if (done[i] != 0) continue;
    if (next[i][0] == number)
      walk(i, 1);
    else if (next[i][1] == number)
      walk(i, 0);
  }
  // What is left are closed chains. The first line of each begins at its smallest point, which is a corner of
  // it however it is divided.
  for (Index i = 0; i < number; ++i)
    if (done[i] == 0) walk(i, 1);
  lattice::sort_unique(joined);
  lines = std::move(joined);
}

}  // namespace cut

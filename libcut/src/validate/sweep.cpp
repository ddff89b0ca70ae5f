/// @file
/// The line sweeps by increasing (x, y), which is a vertical line tilted by less than any angle on the
/// lattice: vertical edges need no special treatment. Edges under the line are kept from bottom to top. Up to
/// the first conflict that order is sound, and the first conflict is between neighbours in it.
#include "validate/sweep.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "lattice/orientation.hpp"

namespace cut::validation {
namespace {

using lattice::orientation;

struct Segment {
  LatticePoint low;
  LatticePoint high;
};

/// a is below b. @pre some sweep line meets both
bool below(const Segment& a, const Segment& b) {
  if (a.low <= b.low) {
    const std::int64_t start = orientation(a.low, a.high, b.low);
    return (start != 0 ? start : orientation(a.low, a.high, b.high)) > 0;
  }
  const std::int64_t start = orientation(b.low, b.high, a.low);
  return (start != 0 ? start : orientation(b.low, b.high, a.high)) < 0;
}

/// They have more in common than one end.
bool in_conflict(const Segment& a, const Segment& b) {
  using lattice::on_segment;
  if (a.low == b.low && a.high == b.high) return true;
  if (lattice::cross_properly(a.low, a.high, b.low, b.high)) return true;
  const auto touches = [](const Segment& s, LatticePoint p) {
    return p != s.low && p != s.high && on_segment(s.low, s.high, p);
  };
  return touches(a, b.low) || touches(a, b.high) || touches(b, a.low) || touches(b, a.high);
}

struct Order {
  using is_transparent = void;
  const std::vector<Segment>* segments;
  bool operator()(std::uint32_t a, std::uint32_t b) const { return below((*segments)[a], (*segments)[b]); }
  bool operator()(std::uint32_t a, LatticePoint p) const {
    return orientation((*segments)[a].low, (*segments)[a].high, p) > 0;
  }
  bool operator()(LatticePoint p, std::uint32_t a) const {
    return orientation((*segments)[a].low, (*segments)[a].high, p) < 0;
  }
};

using Status = std::set<std::uint32_t, Order>;

std::string describe(const std::vector<GraphEdge>& edges, std::uint32_t e) {
  return "edge " + std::to_string(edges[e].from) + "-" + std::to_string(edges[e].to);
}

}  // namespace

Sweep sweep(const Arrangement& arrangement, const std::vector<GraphEdge>& edges) {
  const auto point = [&](std::uint32_t node) { return arrangement.nodes[node].point; };
  const std::size_t node_count = arrangement.nodes.size();
  Sweep result{{}, std::vector<std::uint32_t>(node_count, outside)};

  std::vector<std::uint32_t> events(node_count);
  for (std::size_t n = 0; n < node_count; ++n) events[n] = static_cast<std::uint32_t>(n);
  std::sort(events.begin(), events.end(),
            [&](std::uint32_t a, std::uint32_t b) { return point(a) < point(b); });
  for (std::size_t i = 1; i < node_count; ++i)
    if (point(events[i - 1]) == point(events[i])) {
      result.conflict =
          "nodes " + std::to_string(events[i - 1]) + " and " + std::to_string(events[i]) + " coincide";
      return result;
    }

  std::vector<Segment> segments;
  std::vector<std::vector<std::uint32_t>> starting(node_count);
  std::vector<std::vector<std::uint32_t>> ending(node_count);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    std::uint32_t low = edges[e].from;
    std::uint32_t high = edges[e].to;
    if (low == high) {
      result.conflict = describe(edges, e) + " has no length";
      return result;
    }
    if (point(high) < point(low)) std::swap(low, high);
    segments.push_back({point(low), point(high)});
    starting[low].push_back(e);
    ending[high].push_back(e);
  }

  Status status(Order{&segments});
  std::vector<Status::iterator> place(edges.size());
  const auto check = [&](Status::iterator lower, Status::iterator upper) {
    if (!in_conflict(segments[*lower], segments[*upper])) return true;
    result.conflict = describe(edges, *lower) + " and " + describe(edges, *upper) + " cross or overlap";
    return false;
  };
  for (const std::uint32_t node : events) {
    for (const std::uint32_t e : ending[node]) {
      const auto above = status.erase(place[e]);
      if (above != status.begin() && above != status.end() && !check(std::prev(above), above)) return result;
    }
    const auto above = status.lower_bound(point(node));
    if (above != status.end() && orientation(segments[*above].low, segments[*above].high, point(node)) == 0) {
      result.conflict = "node " + std::to_string(node) + " lies on " + describe(edges, *above);
      return result;
    }
    if (above != status.begin()) result.below[node] = *std::prev(above);
    for (const std::uint32_t e : starting[node]) {
      const auto [it, inserted] = status.insert(e);
      place[e] = it;
      if (!inserted) {
        result.conflict = describe(edges, e) + " and " + describe(edges, *it) + " overlap";
        return result;
      }
      if (it != status.begin() && !check(std::prev(it), it)) return result;
      if (std::next(it) != status.end() && !check(it, std::next(it))) return result;
    }
  }
  return result;
}

}  // namespace cut::validation

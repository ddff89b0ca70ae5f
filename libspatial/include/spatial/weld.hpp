/// @file
/// Merges the points of a list (§5.2). In: points, a distance. Out: for each point the index of the one that
/// it was merged to.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "box.hpp"
#include "point_cluster_dictionary.hpp"

namespace spatial {

/// Merges points within `merge_distance`, in order: result[i] is the index, in `points`, of the point that
/// point i was merged to (its own if it was not). A point that is not accepted keeps its own index. O(n).
template <class T, std::size_t D>
[[nodiscard]] std::vector<std::uint32_t> weld(const std::vector<Point<T, D>>& points, T merge_distance) {
  PointClusterDictionary<T, D, std::uint32_t> dictionary(merge_distance);
  std::vector<std::uint32_t> result;
  result.reserve(points.size());
  for (const Point<T, D>& point : points) {
    const auto own = static_cast<std::uint32_t>(result.size());
    const MergeResult merged = dictionary.insert_or_merge(point, own);
    result.push_back(merged.cluster.valid() ? dictionary.value(merged.cluster) : own);
  }
  return result;
}

/// The same, but which points are merged does not depend on their order: the points are taken in
/// lexicographic order. O(n log n).
template <class T, std::size_t D>
[[nodiscard]] std::vector<std::uint32_t> weld_in_any_order(const std::vector<Point<T, D>>& points,
                                                           T merge_distance) {
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  PointClusterDictionary<T, D, std::uint32_t> dictionary(merge_distance);
  // Points that are not accepted may be NaN, which has no order.
  const auto refused = std::partition(order.begin(), order.end(),
                                      [&](std::uint32_t i) { return dictionary.accepts(points[i]); });
  std::sort(order.begin(), refused, [&](std::uint32_t a, std::uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  std::vector<std::uint32_t> result(points.size());
  for (auto i = order.begin(); i != refused; ++i) {
    result[*i] = dictionary.value(dictionary.insert_or_merge(points[*i], *i).cluster);
  }
  for (auto i = refused; i != order.end(); ++i) result[*i] = *i;
  return result;
}

}  // namespace spatial

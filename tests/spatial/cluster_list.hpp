// A point cluster dictionary as its definition has it (§5.2): all centres in a list, in the order of their
// age, and every question answered by looking at each. In: points. Out: what a dictionary must answer.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <spatial/point_cluster_dictionary.hpp>
#include <vector>

namespace operations {

template <class T, std::size_t D>
class ClusterList {
 public:
  using Point = spatial::Point<T, D>;
  static constexpr std::uint32_t none = spatial::ClusterId::invalid_index;
  struct Cluster {
    Point center;
    int value;
    bool alive;
  };
  struct Centre {
    Point point;
    std::uint32_t cluster;
  };
  std::vector<Cluster> clusters;
  std::vector<Centre> centres;
  double distance;

  explicit ClusterList(T merge_distance) : distance(double{merge_distance}) {}

  static double squared(const Point& p, const Point& q) {
    double sum = 0;
    for (std::size_t a = 0; a < D; ++a) sum += (double{p[a]} - double{q[a]}) * (double{p[a]} - double{q[a]});
    return sum;
  }
  // The bytes give no coordinate near the limit, so that nothing depends on how it is rounded.
  bool accepts(const Point& p) const {
    for (const T x : p) {
      if (!(std::abs(double{x}) <= distance * 1073741824.0)) return false;
    }
    return true;
  }
  bool is_near(const Centre& c, const Point& p) const {
    return clusters[c.cluster].alive && squared(c.point, p) <= distance * distance;
  }
  std::uint32_t nearest(const Point& p) const {
    std::uint32_t best = none;
    double best_squared = std::numeric_limits<double>::infinity();
    for (const Centre& c : centres) {
      if (!is_near(c, p) || squared(c.point, p) >= best_squared) continue;
      best = c.cluster;
      best_squared = squared(c.point, p);
    }
    return accepts(p) ? best : none;
  }
  std::vector<std::uint32_t> within(const Point& p) const {
    std::vector<std::uint32_t> result;
    for (const Centre& c : centres) {
      if (accepts(p) && is_near(c, p)) result.push_back(c.cluster);
    }
    return result;
  }
  spatial::MergeResult insert_or_merge(const Point& p, int value) {
    if (!accepts(p)) return {};
    const std::uint32_t near = nearest(p);
    if (near != none) return {{near}, false};
    const auto id = static_cast<std::uint32_t>(clusters.size());
    clusters.push_back({p, value, true});
    centres.push_back({p, id});
    return {{id}, true};
  }
  bool add_center(std::uint32_t cluster, const Point& p) {
    if (cluster >= clusters.size() || !clusters[cluster].alive || !accepts(p)) return false;
    for (const std::uint32_t other : within(p)) {
      if (other != cluster) return false;
    }
    centres.push_back({p, cluster});
    return true;
  }
  std::vector<std::uint32_t> merge(const ClusterList& other) {
    std::vector<std::uint32_t> result(other.clusters.size(), none);
    for (std::size_t i = 0; i < other.clusters.size(); ++i) {
      const Cluster& c = other.clusters[i];
      if (c.alive) result[i] = insert_or_merge(c.center, c.value).cluster.index;
    }
    for (const Centre& c : other.centres) {
      if (other.clusters[c.cluster].alive && c.point != other.clusters[c.cluster].center)
        add_center(result[c.cluster], c.point);
    }
    return result;
  }
};

}  // namespace operations

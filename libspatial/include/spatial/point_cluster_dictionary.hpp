/// @file
/// The point cluster dictionary (PCD, §5.2): merges points within a distance. No two cluster centres are
/// within that distance of each other, so that a cell of the grid holds few of them and every look-up takes
/// constant time. In: points and values. Out: clusters.
///
/// The paper nests one dictionary per axis; here one open-addressed table maps a cell to its centres, which
/// lie side by side.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "box.hpp"
#include "detail/cell_grid.hpp"

namespace spatial {

/// A cluster of a PointClusterDictionary, by its number in order of insertion.
struct ClusterId {
  static constexpr std::uint32_t invalid_index = 0xffffffffu;
  std::uint32_t index = invalid_index;
  [[nodiscard]] constexpr bool valid() const { return index != invalid_index; }
  friend constexpr bool operator==(ClusterId, ClusterId) = default;
};

/// What insert_or_merge did. The cluster is invalid if the point was refused.
struct MergeResult {
  ClusterId cluster;
  bool inserted = false;
};

/// @tparam T float or double
/// @tparam D 2 or 3 (any number works; a look-up visits up to 2^D cells)
template <class T, std::size_t D, class Value>
class PointClusterDictionary {
  static_assert(std::is_floating_point_v<T>);

 public:
  using point_type = Point<T, D>;

  /// @param merge_distance δm. Points are refused unless sqrt(smallest normal double) < δm < sqrt(largest
  /// double).
  explicit PointClusterDictionary(T merge_distance)
      : distance_(static_cast<double>(merge_distance)),
        squared_(distance_ * distance_),
        cells_per_length_(reach / (distance_ * (1 + relative_slack))) {
    // A sum of squares in T is off by a few of its last digits, and by less than the smallest normal number.
    bound_ =
        static_cast<T>(std::min(squared_ * (1 + 1e-5), static_cast<double>(std::numeric_limits<T>::max()))) +
        std::numeric_limits<T>::min();
    if (squared_ > 0.5 * static_cast<double>(std::numeric_limits<T>::max())) {
      bound_ = std::numeric_limits<T>::infinity();
    }
    usable_ = distance_ > 0 && squared_ >= std::numeric_limits<double>::min() &&
              squared_ <= std::numeric_limits<double>::max();
  }

  PointClusterDictionary(const PointClusterDictionary&) = default;
  PointClusterDictionary& operator=(const PointClusterDictionary&) = default;
  /// The other dictionary is empty afterwards.
  PointClusterDictionary(PointClusterDictionary&& other) noexcept
      : PointClusterDictionary(other.merge_distance()) {
    swap(other);
  }
  PointClusterDictionary& operator=(PointClusterDictionary&& other) noexcept {
    PointClusterDictionary moved(std::move(other));
    swap(moved);
    return *this;
  }
  ~PointClusterDictionary() = default;
  void swap(PointClusterDictionary& other) noexcept {
    std::swap(distance_, other.distance_);
    std::swap(squared_, other.squared_);
    std::swap(cells_per_length_, other.cells_per_length_);
    std::swap(usable_, other.usable_);
    std::swap(bound_, other.bound_);
    std::swap(grid_, other.grid_);
    clusters_.swap(other.clusters_);
    centres_.swap(other.centres_);
    std::swap(size_, other.size_);
    std::swap(next_id_, other.next_id_);
  }
  friend void swap(PointClusterDictionary& a, PointClusterDictionary& b) noexcept { a.swap(b); }

  [[nodiscard]] T merge_distance() const { return static_cast<T>(distance_); }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Memory in use and kept ready.
  [[nodiscard]] std::size_t bytes() const {
    return grid_.bytes() + clusters_.capacity() * sizeof(Cluster) + centres_.capacity() * sizeof(Centre);
  }

  /// True if the grid can hold the point: no NaN, and each coordinate within ±2^30 merge distances.
  [[nodiscard]] bool accepts(const point_type& point) const {
    bool fits = usable_;
    for (const T x : point) fits &= std::abs(static_cast<double>(x) * cells_per_length_) <= index_limit;
    return fits;
  }

  /// The cluster whose centre is nearest to the point, within δm, ties going to the oldest centre; else a new
  /// cluster with this centre and value. O(1). If it throws, nothing has changed.
  /// @return an invalid cluster, and no change, if the point is not accepted
  MergeResult insert_or_merge(const point_type& point, Value value) {
    if (!accepts(point)) return {};
    const ClusterId near = find_nearest(point);
    if (near.valid()) return {near, false};
    if (clusters_.size() > 2 * size_ + 64) forget_erased();
    const auto index = static_cast<std::uint32_t>(clusters_.size());
    const auto centre = static_cast<std::uint32_t>(centres_.size());
    const auto place = grid_.prepare(key_of(point));
    if (centres_.size() == centres_.capacity()) centres_.reserve(2 * centres_.size() + 8);
    clusters_.push_back({std::move(value), point, centre, next_id_, true});
    centres_.push_back({point, index, none});
    grid_.add(place, point, centre);
    ++size_;
    return {{next_id_++}, true};
  }

  /// Gives a cluster a further centre: points within δm of it are within reach of the cluster too. O(1), as
  /// long as there are few further centres in one place.
  /// @return false, and no change, if the point is not accepted, the cluster is not there, or a centre of
  /// another cluster
  ///         is within δm
  bool add_center(ClusterId cluster, const point_type& point) {
    if (!contains(cluster) || !accepts(point)) return false;
    bool taken = false;
    visit_near(point, [&](std::uint32_t centre, double) { taken |= cluster_of(centre) != cluster; });
    if (taken) return false;
    const auto place = grid_.prepare(key_of(point));
    const std::uint32_t index = index_of(cluster);
    Cluster& owner = clusters_[index];
    const auto centre = static_cast<std::uint32_t>(centres_.size());
    centres_.push_back({point, index, owner.last_centre});
    owner.last_centre = centre;
    grid_.add(place, point, centre);
    return true;
  }

  /// Removes a cluster and all its centres. Its id is not used again; its memory is. O(number of its
  /// centres).
  /// @return false if it is not there
  bool erase(ClusterId cluster) {
    if (!contains(cluster)) return false;
    Cluster& gone = clusters_[index_of(cluster)];
    for (std::uint32_t c = gone.last_centre; c != none; c = centres_[c].sibling) {
      grid_.remove(key_of(centres_[c].point), c);
    }
    gone.alive = false;
    --size_;
    return true;
  }

  /// Inserts or merges the clusters of another dictionary in their order, with their further centres where
  /// those are free. @return for each id of the other dictionary, the cluster here
  std::vector<ClusterId> merge(const PointClusterDictionary& other) {
    std::vector<ClusterId> result(other.next_id_);
    if (this == &other) {
      for (const ClusterId id : other) result[id.index] = id;
      return result;
    }
    for (const ClusterId id : other)
      result[id.index] = insert_or_merge(other.center(id), other.value(id)).cluster;
    for (const Centre& centre : other.centres_) {
      const Cluster& owner = other.clusters_[centre.cluster];
      if (owner.alive && centre.point != owner.center) add_center(result[owner.id], centre.point);
    }
    return result;
  }

  void clear() {
    grid_.clear();
    clusters_.clear();
    centres_.clear();
    size_ = 0;
    next_id_ = 0;
  }

  [[nodiscard]] bool contains(ClusterId cluster) const {
    const std::uint32_t index = index_of(cluster);
    return index < clusters_.size() && clusters_[index].alive;
  }

  /// The nearest cluster within δm, or an invalid id. O(1).
  [[nodiscard]] ClusterId find_nearest(const point_type& point) const {
    ClusterId best;
    double best_squared = std::numeric_limits<double>::infinity();
    std::uint32_t best_centre = none;
    visit_near(point, [&](std::uint32_t centre, double squared) {
      if (squared < best_squared || (squared == best_squared && centre < best_centre)) {
        best = cluster_of(centre);
        best_squared = squared;
        best_centre = centre;
      }
    });
    return best;
  }

  /// Calls `visitor(ClusterId)` or `visitor(ClusterId, double squared_distance)` for every centre within δm
  /// of the point, in no particular order. O(1).
  template <class Visitor>
  void for_each_within(const point_type& point, Visitor&& visitor) const {
    visit_near(point, [&](std::uint32_t centre, double squared) {
      if constexpr (std::is_invocable_v<Visitor&, ClusterId>) {
        visitor(cluster_of(centre));
      } else {
        visitor(cluster_of(centre), squared);
      }
    });
  }

  /// Goes through the clusters in the order in which they were inserted.
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = ClusterId;
    using difference_type = std::ptrdiff_t;
    using reference = ClusterId;
    using pointer = const ClusterId*;
    Iterator() = default;
    Iterator(const PointClusterDictionary& dictionary, std::uint32_t at) : dictionary_(&dictionary), at_(at) {
      skip();
    }
    ClusterId operator*() const { return {dictionary_->clusters_[at_].id}; }
    Iterator& operator++() {
      ++at_;
      skip();
      return *this;
    }
    Iterator operator++(int) {
      Iterator old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    void skip() {
      while (at_ < dictionary_->clusters_.size() && !dictionary_->clusters_[at_].alive) ++at_;
    }
    const PointClusterDictionary* dictionary_ = nullptr;
    std::uint32_t at_ = 0;
  };
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, static_cast<std::uint32_t>(clusters_.size())}; }

  /// @pre the cluster is in the dictionary
  [[nodiscard]] const point_type& center(ClusterId cluster) const {
    return clusters_[index_of(cluster)].center;
  }
  [[nodiscard]] const Value& value(ClusterId cluster) const { return clusters_[index_of(cluster)].value; }
  [[nodiscard]] Value& value(ClusterId cluster) { return clusters_[index_of(cluster)].value; }

 private:
  using Key = std::array<std::int32_t, D>;
  static constexpr std::uint32_t none = 0xffffffffu;
  // δm in cells. Wider cells mean fewer of them and more centres in each; these were the fastest.
  static constexpr double reach = D <= 2 ? 1.0 / 6 : 1.0 / 4;
  static constexpr double index_limit = 1073741824.0 * reach;  // 2^30 merge distances
  // Rounding moves a cell coordinate by at most 2^-24 cells, far less than this; so two points within δm of
  // each other are never `reach` apart.
  static constexpr double relative_slack = 1.0 / (1 << 20);

  struct Cluster {
    Value value;
    point_type center;
    std::uint32_t last_centre;
    std::uint32_t id;
    bool alive;
  };
  struct Centre {
    point_type point;
    std::uint32_t cluster;  // its index
    std::uint32_t sibling;  // of the same cluster
  };

  /// std::floor, without a call where the processor has no instruction for it. @pre |x| <= index_limit
  static std::int32_t floor_of(double x) {
    const auto whole = static_cast<std::int32_t>(x);
    return whole - static_cast<std::int32_t>(x < whole);
  }
  [[nodiscard]] Key key_of(const point_type& point) const {
    Key key{};
    for (std::size_t a = 0; a < D; ++a) {
      key[a] = floor_of(static_cast<double>(point[a]) * cells_per_length_);
    }
    return key;
  }
  [[nodiscard]] static double squared_distance(const point_type& p, const point_type& q) {
    double sum = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double d = static_cast<double>(p[a]) - static_cast<double>(q[a]);
      sum += d * d;
    }
    return sum;
  }

  /// While none is forgotten, a cluster's index is its id. `clusters_.size()` or more if it is not there.
  [[nodiscard]] std::uint32_t index_of(ClusterId cluster) const {
    if (clusters_.size() == next_id_) return cluster.index;
    const auto found = std::lower_bound(clusters_.begin(), clusters_.end(), cluster.index,
                                        [](const Cluster& each, std::uint32_t id) { return each.id < id; });
    const bool is_there = found != clusters_.end() && found->id == cluster.index;
    return is_there ? static_cast<std::uint32_t>(found - clusters_.begin()) : none;
  }
  /// Until a cluster gets a further centre or is forgotten, all have the same number.
  [[nodiscard]] ClusterId cluster_of(std::uint32_t centre) const {
    const std::uint32_t index = centres_.size() == clusters_.size() ? centre : centres_[centre].cluster;
    return {clusters_.size() == next_id_ ? index : clusters_[index].id};
  }

  /// Frees the memory of erased clusters. Ids and the order of centres stay.
  void forget_erased() {
    PointClusterDictionary kept(merge_distance());
    std::vector<std::uint32_t> fresh(clusters_.size(), none);
    std::vector<std::uint32_t> last(size_, none);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      if (clusters_[i].alive) fresh[i] = count++;
    }
    for (const Centre& centre : centres_) {
      const std::uint32_t index = fresh[centre.cluster];
      if (index == none) continue;
      const auto number = static_cast<std::uint32_t>(kept.centres_.size());
      kept.centres_.push_back({centre.point, index, std::exchange(last[index], number)});
      kept.grid_.add(kept.grid_.prepare(key_of(centre.point)), centre.point, number);
    }
    kept.clusters_.reserve(size_);
    for (Cluster& each : clusters_) {
      if (!each.alive) continue;
      kept.clusters_.push_back(std::move_if_noexcept(each));
      kept.clusters_.back().last_centre = last[kept.clusters_.size() - 1];
    }
    grid_ = std::move(kept.grid_);
    clusters_.swap(kept.clusters_);
    centres_.swap(kept.centres_);
  }

  template <class Visit>
  void visit_near(const point_type& point, Visit&& visit) const {
    if (!accepts(point)) return;
    Key home{};
    Key other{};
    double gap[D];  // to the other cell on each axis, in cells
    for (std::size_t a = 0; a < D; ++a) {
      const double at = static_cast<double>(point[a]) * cells_per_length_;
      home[a] = floor_of(at);
      const double fraction = at - home[a];
      const bool low = fraction < 0.5;
      other[a] = low ? home[a] - 1 : home[a] + 1;
      gap[a] = low ? fraction : 1 - fraction;
    }
    // A cell that is as far as `reach` is farther than δm.
    grid_.visit_near(point, bound_, home, other, gap, reach * reach,
                     [&](std::uint32_t centre, const point_type& at) {
                       const double squared = squared_distance(point, at);
                       if (squared <= squared_) visit(centre, squared);
                     });
  }

  double distance_;
  double squared_;
  double cells_per_length_;
  bool usable_ = false;
  T bound_;  // squared_ in T, not less
  detail::CellGrid<T, D> grid_;
  std::vector<Cluster> clusters_;
  std::vector<Centre> centres_;
  std::size_t size_ = 0;
  std::uint32_t next_id_ = 0;
};

}  // namespace spatial

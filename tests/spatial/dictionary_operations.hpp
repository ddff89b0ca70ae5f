// Runs a sequence of operations on point cluster dictionaries, encoded in bytes, against a plain list of
// centres. Shared by the property test and the fuzzer. In: bytes. Out: the first disagreement, or nullptr.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <spatial/point_cluster_dictionary.hpp>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "cluster_list.hpp"

namespace operations {

template <class T, std::size_t D>
class DictionaryRun {
  using Dictionary = spatial::PointClusterDictionary<T, D, int>;
  using List = ClusterList<T, D>;
  using Point = spatial::Point<T, D>;

 public:
  std::size_t operations = 0;

  /// `unit` is the merge distance and the measure of all coordinates. @pre a power of two
  explicit DictionaryRun(T unit) : unit_(unit), mine_(unit), list_(unit) {}

  const char* run(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    while (!bytes.empty()) {
      ++operations;
      const char* wrong = step(bytes);
      if (wrong == nullptr) wrong = check();
      if (wrong != nullptr) return wrong;
    }
    return nullptr;
  }

 private:
  // Quarters of the merge distance, so that distances of exactly that and ties are common; now and then a
  // number at an end of what the grid or the type can hold.
  T coordinate(Bytes& bytes) const {
    using Limits = std::numeric_limits<T>;
    const unsigned b = bytes.next();
    if (b < 240) return unit_ * static_cast<T>(static_cast<int>(b % 40) - 20) / 4;
    const T special[] = {Limits::quiet_NaN(),
                         Limits::infinity(),
                         -Limits::infinity(),
                         Limits::max(),
                         Limits::denorm_min(),
                         T(-0.0),
                         unit_ * T(536870912),
                         unit_ * T(-536870912),
                         unit_ * T(2147483648.0),
                         std::nextafter(unit_, T(0)),
                         std::nextafter(unit_, T(2) * unit_),
                         unit_ * T(0.1)};
    return special[b % 12];
  }
  Point point(Bytes& bytes) const {
    Point result;
    for (T& x : result) x = coordinate(bytes);
    return result;
  }

  const char* step(Bytes& bytes) {
    switch (bytes.next() % 16) {
      default:
        return insert(mine_, list_, point(bytes));
      case 9:
        return erase(bytes.next());
      case 10:
      case 11:
        return add_center(bytes.next(), point(bytes));
      case 12:
      case 13:
        return look(point(bytes));
      case 14:
        return merge(bytes);
      case 15:
        return copy_and_move(bytes.next());
    }
  }
  const char* insert(Dictionary& dictionary, List& list, const Point& p) {
    if (dictionary.accepts(p) != list.accepts(p)) return "accepts";
    if (const char* wrong = look(p)) return wrong;
    const auto expected = list.insert_or_merge(p, next_value_);
    const auto result = dictionary.insert_or_merge(p, next_value_++);
    return result.cluster == expected.cluster && result.inserted == expected.inserted ? nullptr
                                                                                      : "insert_or_merge";
  }
  const char* erase(unsigned which) {
    if (list_.clusters.empty()) return nullptr;
    const auto id = static_cast<std::uint32_t>(which % list_.clusters.size());
    const bool was_there = std::exchange(list_.clusters[id].alive, false);
    if (mine_.erase(spatial::ClusterId{id}) != was_there) return "erase tells whether it was there";
    return mine_.contains(spatial::ClusterId{id}) ? "what is erased is gone" : nullptr;
  }
  const char* add_center(unsigned which, const Point& p) {
    const auto id = static_cast<std::uint32_t>(which % (list_.clusters.size() + 1));
    return mine_.add_center(spatial::ClusterId{id}, p) == list_.add_center(id, p) ? nullptr : "add_center";
  }
  const char* look(const Point& p) {
    if (mine_.find_nearest(p).index != list_.nearest(p)) return "find_nearest";
    std::vector<std::uint32_t> found;
    bool is_near = true;
    mine_.for_each_within(p, [&](spatial::ClusterId id, double squared) {
      found.push_back(id.index);
      is_near &= squared <= list_.distance * list_.distance;
    });
    auto expected = list_.within(p);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    return found == expected && is_near ? nullptr : "for_each_within";
  }
  const char* merge(Bytes& bytes) {
    Dictionary other(unit_);
    List other_list(unit_);
    for (unsigned n = bytes.next() % 12; n > 0; --n) {
      const Point p = point(bytes);
      const auto made = other_list.insert_or_merge(p, next_value_);
      if (other.insert_or_merge(p, next_value_++).cluster != made.cluster) return "insert into another";
      if (n % 4 != 0) continue;
      const Point further = point(bytes);
      if (other.add_center(made.cluster, further) != other_list.add_center(made.cluster.index, further))
        return "add_center to another";
      if (n == 4 && other.erase(made.cluster)) other_list.clusters[made.cluster.index].alive = false;
    }
    const auto expected = list_.merge(other_list);
    const auto result = mine_.merge(other);
    if (result.size() != expected.size()) return "merge tells of each cluster";
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result[i].index != expected[i]) return "merge";
    }
    return nullptr;
  }
  const char* copy_and_move(unsigned how) {
    switch (how % 4) {
      case 0: {
        Dictionary copy(mine_);
        mine_.clear();
        if (!mine_.empty() || mine_.begin() != mine_.end()) return "clear";
        mine_ = copy;
        return nullptr;
      }
      case 1: {
        Dictionary moved(std::move(mine_));
        // NOLINTNEXTLINE(bugprone-use-after-move): says what that leaves behind
        if (!mine_.empty() || mine_.begin() != mine_.end()) return "what was moved from is empty";
        if (!mine_.insert_or_merge(Point{}, 0).inserted) return "what was moved from can be filled again";
        mine_ = std::move(moved);
        return nullptr;
      }
      case 2: {
        const auto result = mine_.merge(mine_);
        for (std::uint32_t i = 0; i < result.size(); ++i) {
          const spatial::ClusterId id{i};
          if (result[i] != (mine_.contains(id) ? id : spatial::ClusterId{})) return "merged with itself";
        }
        return nullptr;
      }
      default:
        if (how < 224) return nullptr;
        mine_.clear();
        list_ = List(unit_);
        return nullptr;
    }
  }
  const char* check() {
    std::size_t alive = 0;
    auto at = mine_.begin();
    for (std::uint32_t id = 0; id < list_.clusters.size(); ++id) {
      const auto& cluster = list_.clusters[id];
      if (mine_.contains(spatial::ClusterId{id}) != cluster.alive) return "contains";
      if (!cluster.alive) continue;
      ++alive;
      if (at == mine_.end() || *at != spatial::ClusterId{id}) return "iteration in the order of insertion";
      if (mine_.value(*at) != cluster.value) return "a cluster keeps its value";
      if (mine_.center(*at) != cluster.center) return "a cluster keeps its centre";
      ++at;
    }
    if (at != mine_.end()) return "iteration ends";
    if (mine_.size() != alive) return "size";
    return far_apart() ? nullptr : "no two centres of different clusters are within the merge distance";
  }
  // The newest centre against all others is enough, after each operation but a merge.
  bool far_apart() {
    for (; checked_ < list_.centres.size(); ++checked_) {
      const auto& newest = list_.centres[checked_];
      if (!list_.clusters[newest.cluster].alive) continue;
      for (const std::uint32_t other : list_.within(newest.point)) {
        if (other != newest.cluster) return false;
      }
    }
    checked_ = list_.centres.size();
    return true;
  }

  T unit_;
  Dictionary mine_;
  List list_;
  std::size_t checked_ = 0;
  int next_value_ = 0;
};

/// One sequence; its first byte chooses the type, the number of axes and the merge distance.
inline const char* run_dictionary(const std::uint8_t* data, std::size_t size, std::size_t& done) {
  if (size == 0) return nullptr;
  const auto run = [&](auto sequence) {
    const char* wrong = sequence.run(data + 1, size - 1);
    done += sequence.operations;
    return wrong;
  };
  const int exponent = (data[0] / 4 % 3 - 1) * 60;
  switch (data[0] % 4) {
    case 0:
      return run(DictionaryRun<float, 2>(std::ldexp(1.0f, exponent)));
    case 1:
      return run(DictionaryRun<float, 3>(std::ldexp(1.0f, exponent)));
    case 2:
      return run(DictionaryRun<double, 2>(std::ldexp(1.0, 6 * exponent)));
    default:
      return run(DictionaryRun<double, 3>(std::ldexp(1.0, 6 * exponent)));
  }
}

}  // namespace operations

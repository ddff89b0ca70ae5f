// The point cluster dictionary against an R-tree, a grid in an unordered_map, VTK and nanoflann. The counter
// `answer` is the number of clusters or of what was found.
#include <benchmark/benchmark.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <random>
#include <spatial/point_cluster_dictionary.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "data.hpp"
#include "flann.hpp"

namespace {

template <class T, std::size_t D>
T squared(const spatial::Point<T, D>& p, const spatial::Point<T, D>& q) {
  T sum = 0;
  for (std::size_t a = 0; a < D; ++a) sum += (p[a] - q[a]) * (p[a] - q[a]);
  return sum;
}

/// What one writes by hand: cells of the merge distance in an unordered_map, the neighbours looked through.
template <class T, std::size_t D>
class MapGrid {
  using Key = std::array<std::int32_t, D>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::size_t h = 0;
      for (const auto k : key) h = h * 73856093u ^ static_cast<std::size_t>(k);
      return h;
    }
  };
  struct Item {
    spatial::Point<T, D> point;
    std::uint32_t id;
  };

 public:
  explicit MapGrid(T distance) : distance_(distance) {}
  std::uint32_t find(const spatial::Point<T, D>& p) const {
    Key home, key;
    for (std::size_t a = 0; a < D; ++a) home[a] = static_cast<std::int32_t>(std::floor(p[a] / distance_));
    std::uint32_t best = none;
    T least = distance_ * distance_;
    for (std::size_t cell = 0; cell < (D == 2 ? 9u : 27u); ++cell) {
      std::size_t rest = cell;
      for (std::size_t a = 0; a < D; ++a, rest /= 3)
        key[a] = home[a] + static_cast<std::int32_t>(rest % 3) - 1;
      const auto found = cells_.find(key);
      if (found == cells_.end()) continue;
      for (const Item& item : found->second) {
        const T s = squared<T, D>(p, item.point);
        if (s > least) continue;
        least = s;
        best = item.id;
      }
    }
    return best;
  }
  std::uint32_t insert_or_merge(const spatial::Point<T, D>& p) {
    const std::uint32_t near = find(p);
    if (near != none) return near;
    Key home;
    for (std::size_t a = 0; a < D; ++a) home[a] = static_cast<std::int32_t>(std::floor(p[a] / distance_));
    cells_[home].push_back({p, next_});
    return next_++;
  }
  std::size_t size() const { return next_; }
  static constexpr std::uint32_t none = 0xffffffffu;

 private:
  T distance_;
  std::unordered_map<Key, std::vector<Item>, Hash> cells_;
  std::uint32_t next_ = 0;
};

template <class T, std::size_t D>
void add(std::size_t count, const std::string& type) {
  namespace bg = boost::geometry;
  const T distance = static_cast<T>(data::merge_distance<D>(count));
  const std::string tail = "/uniform/" + type + "/" + std::to_string(count) + "/";
  const auto reg = [&](const std::string& name, auto f) {
    benchmark::RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond);
  };
  reg("merge" + tail + "pcd", [=](benchmark::State& state) {
    const auto points = data::cloud<T, D>(count);
    for (auto _ : state) {
      spatial::PointClusterDictionary<T, D, std::uint32_t> dictionary(distance);
      for (const auto& p : points) benchmark::DoNotOptimize(dictionary.insert_or_merge(p, 0));
      state.counters["answer"] = static_cast<double>(dictionary.size());
    }
  });
  reg("merge" + tail + "unordered_map", [=](benchmark::State& state) {
    const auto points = data::cloud<T, D>(count);
    for (auto _ : state) {
      MapGrid<T, D> grid(distance);
      for (const auto& p : points) benchmark::DoNotOptimize(grid.insert_or_merge(p));
      state.counters["answer"] = static_cast<double>(grid.size());
    }
  });
  reg("merge" + tail + "boost_rtree", [=](benchmark::State& state) {
    using P = bg::model::point<T, D, bg::cs::cartesian>;
    const auto points = data::cloud<T, D>(count);
    for (auto _ : state) {
      bg::index::rtree<P, bg::index::linear<16>> tree;
      for (const auto& p : points) {
        P at;
        if constexpr (D == 2) at = P(p[0], p[1]);
        if constexpr (D == 3) at = P(p[0], p[1], p[2]);
        bool near = false;
        for (auto i = tree.qbegin(bg::index::nearest(at, 1)); i != tree.qend(); ++i) {
          near = bg::comparable_distance(at, *i) <= distance * distance;
        }
        if (!near) tree.insert(at);
      }
      benchmark::DoNotOptimize(tree);
      state.counters["answer"] = static_cast<double>(tree.size());
    }
  });
  reg("within" + tail + "pcd", [=](benchmark::State& state) {
    const auto points = data::cloud<T, D>(count);
    spatial::PointClusterDictionary<T, D, std::uint32_t> dictionary(distance);
    for (const auto& p : points) dictionary.insert_or_merge(p, 0);
    std::size_t sum = 0;
    for (auto _ : state) {
      sum = 0;
      for (const auto& p : points)
        dictionary.for_each_within(p, [&](spatial::ClusterId id) { sum += id.index; });
      benchmark::DoNotOptimize(sum);
    }
    state.counters["answer"] = static_cast<double>(sum);
  });
  reg("within" + tail + "nanoflann", [=](benchmark::State& state) {
    const auto points = data::cloud<T, D>(count);
    spatial::PointClusterDictionary<T, D, std::uint32_t> dictionary(distance);
    std::vector<spatial::Point<T, D>> centres;  // the same ones
    for (const auto& p : points) {
      if (dictionary.insert_or_merge(p, 0).inserted) centres.push_back(p);
    }
    peers::Flann<T, D> tree(centres);
    std::size_t sum = 0;
    for (auto _ : state) {
      sum = 0;
      for (const auto& p : points) tree.within(p, distance, [&](std::uint32_t i) { sum += i; });
      benchmark::DoNotOptimize(sum);
    }
    state.counters["answer"] = static_cast<double>(sum);
  });
}

}  // namespace

void add_dictionary() {
  for (const std::size_t count :
       {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}, std::size_t{1000000}}) {
    add<float, 2>(count, "float2");
    add<float, 3>(count, "float3");
    add<double, 2>(count, "double2");
    add<double, 3>(count, "double3");
  }
}

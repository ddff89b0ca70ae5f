// Peers that have one operation each: CGAL for pairs, nanoflann for nearest points; and all benchmarks of one
// scalar type.
#pragma once
#include <CGAL/box_intersection_d.h>

#include "flann.hpp"
#include "tree_benchmarks.hpp"

namespace tree_benchmarks {

template <class T, std::size_t D>
void add_cgal_pairs(const std::string& data_name, std::size_t count, const std::string& type) {
  if (data_name == "overlapping") return;
  benchmark::RegisterBenchmark(
      ("pairs/" + data_name + "/" + type + "/" + std::to_string(count) + "/cgal_box_intersection").c_str(),
      [=](benchmark::State& state) {
        using Box = CGAL::Box_intersection_d::Box_d<T, static_cast<int>(D)>;
        const auto& boxes = scene<T, D>(data_name, count).boxes;
        std::vector<Box> all;
        for (auto b : boxes) all.emplace_back(b.min.data(), b.max.data());
        const std::size_t first = all.front().id();
        std::size_t sum = 0;
        for (auto _ : state) {
          auto copy = all;
          sum = 0;
          CGAL::box_self_intersection_d(copy.begin(), copy.end(), [&](const Box& a, const Box& b) {
            sum += (a.id() - first) ^ (b.id() - first);
          });
          benchmark::DoNotOptimize(sum);
        }
        state.counters["answer"] = static_cast<double>(sum);
      })
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(
      ("pairs/" + data_name + "/" + type + "/" + std::to_string(count) + "/bbtt_with_build").c_str(),
      [=](benchmark::State& state) {
        const auto& boxes = scene<T, D>(data_name, count).boxes;
        std::size_t sum = 0;
        for (auto _ : state) benchmark::DoNotOptimize(sum = peers::Bbtt<T, D>::bulk(boxes).pairs(boxes));
        state.counters["answer"] = static_cast<double>(sum);
      })
      ->Unit(benchmark::kMillisecond);
}

/// Points, against nanoflann.
template <class T, std::size_t D>
void add_points(std::size_t count, const std::string& type) {
  using Tree = spatial::BoundingBoxTernaryTree<std::uint32_t, T, D>;
  static std::vector<spatial::Point<T, D>> points;
  const auto get = [=]() -> const std::vector<spatial::Point<T, D>>& {
    if (points.size() != count) {
      points.clear();
      for (const auto& b : data::make<T, D>("uniform", count)) points.push_back(b.min);
    }
    return points;
  };
  const auto queries = [=] { return data::make<T, D>("uniform", 1000, 99); };
  for (const unsigned k : {1u, 10u, 100u}) {
    const std::string name =
        "nearest_point_" + std::to_string(k) + "/uniform/" + type + "/" + std::to_string(count);
    benchmark::RegisterBenchmark((name + "/bbtt").c_str(), [=](benchmark::State& state) {
      std::vector<std::pair<spatial::Point<T, D>, std::uint32_t>> values;
      for (const auto& p : get()) values.push_back({p, static_cast<std::uint32_t>(values.size())});
      const Tree tree(values.begin(), values.end());
      const auto asked = queries();
      std::size_t sum = 0;
      for (auto _ : state) {
        sum = 0;
        for (const auto& q : asked)
          tree.query(spatial::nearest(q.min, k), [&](std::uint32_t v) { sum += v; });
        benchmark::DoNotOptimize(sum);
      }
      state.counters["answer"] = static_cast<double>(sum);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark((name + "/nanoflann").c_str(), [=](benchmark::State& state) {
      peers::Flann<T, D> tree(get());
      const auto asked = queries();
      std::size_t sum = 0;
      for (auto _ : state) {
        sum = 0;
        for (const auto& q : asked) tree.nearest(q.min, k, [&](std::uint32_t i) { sum += i; });
        benchmark::DoNotOptimize(sum);
      }
      state.counters["answer"] = static_cast<double>(sum);
    })->Unit(benchmark::kMillisecond);
  }
}

template <class T, std::size_t D>
void add_all(const std::string& type) {
  for_each_scene(10'000'000, [&](const std::string& name, std::size_t count) {
    add<T, D, peers::Bbtt>(name, count, type, "bbtt", false);
    add<T, D, peers::Linear>(name, count, type, "boost_linear", false);
    if (count <= 1'000'000) {
      add<T, D, peers::Quadratic>(name, count, type, "boost_quadratic", false);
      add<T, D, peers::Rstar>(name, count, type, "boost_rstar", false);
    }
    add<T, D, peers::Bbtt>(name, count, type, "bbtt", true);
    add<T, D, peers::Rstar>(name, count, type, "boost_packed", true);
    add_cgal_pairs<T, D>(name, count, type);
    if (name == "uniform") add_points<T, D>(count, type);
  });
}

}  // namespace tree_benchmarks

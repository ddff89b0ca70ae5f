// The benchmarks of the tree for one scalar type and dimension. Names are operation/data/type/count/peer; the
// time per iteration is that of the whole operation on all elements or queries, the same for all peers. The
// counter `answer` is what came out, or what queries find afterwards: compare.py refuses peers that differ.
#pragma once
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

#include "data.hpp"
#include "peers.hpp"

namespace tree_benchmarks {

template <class T, std::size_t D>
struct Scene {
  std::vector<spatial::Box<T, D>> boxes, moved;
  std::map<std::string, std::vector<spatial::Box<T, D>>> queries;
  std::vector<spatial::Point<T, D>> points;
};

template <class T, std::size_t D>
const Scene<T, D>& scene(const std::string& name, std::size_t count) {
  static std::map<std::string, Scene<T, D>> all;
  Scene<T, D>& s = all[name + std::to_string(count)];
  if (!s.boxes.empty()) return s;
  s.boxes = data::make<T, D>(name, count);
  const auto tree = peers::Bbtt<T, D>::bulk(s.boxes);
  const double n = static_cast<double>(count);
  const std::pair<const char*, double> sizes[] = {{"1", 1.2}, {"10", 10}, {"100", 100}, {"1%", n / 100}};
  for (const auto& [label, hits] : sizes) {
    const auto number = static_cast<std::size_t>(std::clamp(200000 / hits, 20.0, 2000.0));
    s.queries[label] =
        data::queries<T, D>(s.boxes, hits, number, [&](const auto& q) { return tree.count(q); });
  }
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> shift(-0.002, 0.002);
  s.moved = s.boxes;
  for (auto& b : s.moved) {
    for (std::size_t a = 0; a < D; ++a) {
      const T by = static_cast<T>(shift(random));
      b.min[a] += by;
      b.max[a] += by;
    }
  }
  for (int i = 0; i < 1000; ++i) {
    const auto& b = s.boxes[random() % count];
    spatial::Point<T, D> p;
    for (std::size_t a = 0; a < D; ++a) p[a] = b.min[a] + static_cast<T>(shift(random));
    s.points.push_back(p);
  }
  return s;
}

/// A tree is built once for all benchmarks that only ask it; of the big ones, one at a time is kept.
template <class Peer>
const Peer& cached(const std::string& key, bool is_big, const std::function<Peer()>& make) {
  static std::map<std::string, std::unique_ptr<Peer>> small, big;
  auto& trees = is_big ? big : small;
  if (is_big && trees.count(key) == 0) trees.clear();
  auto& peer = trees[key];
  if (!peer) peer = std::make_unique<Peer>(make());
  return *peer;
}

/// A tree of one's own to change. Peers that cannot be copied are built again.
template <class Peer, class Boxes>
std::unique_ptr<Peer> copy(const Peer& peer, const Boxes& boxes) {
  if constexpr (std::is_copy_constructible_v<Peer>) {
    return std::make_unique<Peer>(peer);
  } else {
    return std::make_unique<Peer>(Peer::one_by_one(boxes));
  }
}

/// What queries of about ten hits find.
template <class Peer, class Scene>
double answer_of(const Peer& peer, const Scene& scene) {
  std::size_t sum = 0;
  for (const auto& q : scene.queries.at("10")) sum += peer.query(q);
  return static_cast<double>(sum);
}

/// The squared distance from a point to a box.
template <class T, std::size_t D>
double squared_distance(const spatial::Point<T, D>& p, const spatial::Box<T, D>& box) {
  double sum = 0;
  for (std::size_t a = 0; a < D; ++a) {
    const double gap = std::max({0.0, double{box.min[a]} - double{p[a]}, double{p[a]} - double{box.max[a]}});
    sum += gap * gap;
  }
  return sum;
}

template <class T, std::size_t D, template <class, std::size_t> class P>
void add(const std::string& data_name, std::size_t count, const std::string& type, const std::string& peer,
         bool packed) {
  using Peer = P<T, D>;
  const std::string tail = "/" + data_name + "/" + type + "/" + std::to_string(count) + "/" + peer;
  const auto get = [=]() -> const Scene<T, D>& { return scene<T, D>(data_name, count); };
  const auto built = [=]() -> const Peer& {
    return cached<Peer>(data_name + type + std::to_string(count) + (packed ? "b" : "i"), count > 100000,
                        [=] { return packed ? Peer::bulk(get().boxes) : Peer::one_by_one(get().boxes); });
  };
  const auto reg = [&](const std::string& name, auto f) {
    benchmark::RegisterBenchmark((name + tail).c_str(), f)->Unit(benchmark::kMillisecond);
  };
  reg(packed ? "load" : "insert", [=](benchmark::State& state) {
    const auto& boxes = get().boxes;
    std::size_t bytes = 0;
    for (auto _ : state) {
      const std::size_t before = peers::bytes_in_use;
      auto tree = packed ? Peer::bulk(boxes) : Peer::one_by_one(boxes);
      bytes = peers::bytes_in_use - before;
      benchmark::DoNotOptimize(tree);
    }
    state.counters["bytes_per_element"] = static_cast<double>(bytes) / static_cast<double>(count);
  });
  for (const char* size : {"1", "10", "100", "1%"}) {
    reg(std::string(packed ? "query_loaded_" : "query_") + size, [=](benchmark::State& state) {
      const auto& tree = built();
      const auto& queries = get().queries.at(size);
      std::size_t sum = 0;
      for (auto _ : state) {
        sum = 0;
        for (const auto& q : queries) sum += tree.query(q);
        benchmark::DoNotOptimize(sum);
      }
      state.counters["answer"] = static_cast<double>(sum);
    });
  }
  if (packed) {
    if constexpr (requires(const Peer& p, const spatial::Point<T, D>& at) {
                    p.nearest(at, 1u, [](std::uint32_t) {});
                  }) {
      for (const unsigned k : {1u, 10u, 100u}) {
        reg("nearest_" + std::to_string(k), [=](benchmark::State& state) {
          const auto& tree = built();
          for (auto _ : state) {
            std::size_t sum = 0;
            for (const auto& p : get().points) tree.nearest(p, k, [&](std::uint32_t i) { sum += i; });
            benchmark::DoNotOptimize(sum);
          }
          // Which of several at the same distance is found is everybody's own business.
          double answer = 0;
          for (const auto& p : get().points) {
            double farthest = 0;
            tree.nearest(p, k, [&](std::uint32_t i) {
              farthest = std::max(farthest, squared_distance(p, get().boxes[i]));
            });
            answer += farthest;
          }
          state.counters["answer"] = answer;
        });
      }
    }
    if constexpr (requires(const Peer& p) { p.pairs(get().boxes); }) {
      if (data_name != "overlapping") {
        reg("pairs", [=](benchmark::State& state) {
          const auto& tree = built();
          std::size_t sum = 0;
          for (auto _ : state) benchmark::DoNotOptimize(sum = tree.pairs(get().boxes));
          state.counters["answer"] = static_cast<double>(sum);
        });
      }
    }
    return;
  }
  reg("erase", [=](benchmark::State& state) {
    const auto& boxes = get().boxes;
    for (auto _ : state) {
      state.PauseTiming();
      auto tree = copy(built(), boxes);
      state.ResumeTiming();
      for (std::uint32_t i = 0; i < boxes.size(); i += 2) tree->erase(i, boxes[i]);
      state.PauseTiming();
      state.counters["answer"] = answer_of(*tree, get());
      tree.reset();
      state.ResumeTiming();
    }
  });
  for (const std::uint32_t step : {1u, 100u}) {
    reg(step == 1 ? "move_100%" : "move_1%", [=](benchmark::State& state) {
      const auto& s = get();
      auto tree = copy(built(), s.boxes);
      bool forth = true;
      for (auto _ : state) {
        const auto& from = forth ? s.boxes : s.moved;
        const auto& to = forth ? s.moved : s.boxes;
        for (std::uint32_t i = 0; i < from.size(); i += step) tree->move(i, from[i], to[i]);
        forth = !forth;
      }
      if (forth) {
        for (std::uint32_t i = 0; i < s.boxes.size(); i += step) tree->move(i, s.boxes[i], s.moved[i]);
      }
      state.counters["answer"] = answer_of(*tree, s);
    });
  }
}

/// Calls `add(data, count)` for what is measured: all data up to a million elements, uniform data up to ten
/// million, but no more than `most` elements.
template <class Add>
void for_each_scene(std::size_t most, Add&& add) {
  for (std::size_t count = 1000; count <= std::min<std::size_t>(most, 10'000'000); count *= 10) {
    for (const std::string name : data::names) {
      if (name == "overlapping" && count > 100'000) continue;
      if (name != "uniform" && count > 1'000'000) continue;
      add(name, count);
    }
  }
}

}  // namespace tree_benchmarks

// One operation of one container, for run.sh, which counts its instructions. In: operation, peer, data,
// number of elements and type. Out: the sum that came out, so that peers can be compared.
#include <cstdio>
#include <cstdlib>
#include <random>
#include <spatial/point_cluster_dictionary.hpp>
#include <string>
#include <vector>

#include "spatial/data.hpp"
#include "spatial/flann.hpp"
#include "spatial/peers.hpp"

namespace {

// run.sh counts what happens in functions of this name.
template <class F>
[[gnu::noinline]] auto measured(F&& f) {
  return f();
}

template <class T, std::size_t D>
using Points = std::vector<spatial::Point<T, D>>;

template <class Peer, class T, std::size_t D>
std::size_t run_boxes(const std::string& operation, unsigned number,
                      const std::vector<spatial::Box<T, D>>& boxes) {
  if (operation == "insert" || operation == "load") {
    const Peer tree =
        measured([&] { return operation == "load" ? Peer::bulk(boxes) : Peer::one_by_one(boxes); });
    return tree.query(boxes.front());
  }
  const Peer tree = Peer::bulk(boxes);
  if (operation == "pairs") return measured([&] { return tree.pairs(boxes); });
  const auto counter = peers::Bbtt<T, D>::bulk(boxes);
  const auto queries = data::queries<T, D>(boxes, operation == "query" ? number : 1, 1000,
                                           [&](const auto& q) { return counter.count(q); });
  return measured([&] {
    std::size_t sum = 0;
    for (const auto& q : queries) {
      if (operation == "query") {
        sum += tree.query(q);
      } else {
        tree.nearest(q.min, number, [&](std::uint32_t i) { sum += i; });
      }
    }
    return sum;
  });
}

/// The nearest points of 1000 others.
template <class T, std::size_t D>
std::size_t run_points(unsigned number, const std::string& peer, const Points<T, D>& points) {
  const auto asked = data::make<T, D>("uniform", 1000, 99);
  std::size_t sum = 0;
  if (peer == "bbtt") {
    std::vector<std::pair<spatial::Point<T, D>, std::uint32_t>> values;
    for (const auto& p : points) values.push_back({p, static_cast<std::uint32_t>(values.size())});
    const spatial::BoundingBoxTernaryTree<std::uint32_t, T, D> tree(values.begin(), values.end());
    return measured([&] {
      for (const auto& q : asked)
        tree.query(spatial::nearest(q.min, number), [&](std::uint32_t i) { sum += i; });
      return sum;
    });
  }
  peers::Flann<T, D> tree(points);
  return measured([&] {
    for (const auto& q : asked) tree.nearest(q.min, number, [&](std::uint32_t i) { sum += i; });
    return sum;
  });
}

/// For each of the points, the centres within the merge distance.
template <class T, std::size_t D>
std::size_t run_within(const std::string& peer, std::size_t count) {
  const T distance = static_cast<T>(data::merge_distance<D>(count));
  const auto points = data::cloud<T, D>(count);
  spatial::PointClusterDictionary<T, D, std::uint32_t> dictionary(distance);
  Points<T, D> centres;
  for (const auto& p : points) {
    if (dictionary.insert_or_merge(p, 0).inserted) centres.push_back(p);
  }
  std::size_t sum = 0;
  if (peer == "pcd") {
    return measured([&] {
      for (const auto& p : points)
        dictionary.for_each_within(p, [&](spatial::ClusterId id) { sum += id.index; });
      return sum;
    });
  }
  peers::Flann<T, D> tree(centres);
  return measured([&] {
    for (const auto& p : points) tree.within(p, distance, [&](std::uint32_t i) { sum += i; });
    return sum;
  });
}

template <class T, std::size_t D>
std::size_t run(const std::string& operation, unsigned number, const std::string& peer,
                const std::string& data, std::size_t count) {
  if (operation == "within") return run_within<T, D>(peer, count);
  const auto boxes = data::make<T, D>(data, count);
  if (operation == "points") {
    Points<T, D> points;
    for (const auto& b : boxes) points.push_back(b.min);
    return run_points<T, D>(number, peer, points);
  }
  if (peer == "bbtt") return run_boxes<peers::Bbtt<T, D>, T, D>(operation, number, boxes);
  if (peer == "linear") return run_boxes<peers::Linear<T, D>, T, D>(operation, number, boxes);
  return run_boxes<peers::Rstar<T, D>, T, D>(operation, number, boxes);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) {
    std::fprintf(
        stderr,
        "usage: %s insert|load|query|nearest|pairs|points|within NUMBER bbtt|linear|rstar|pcd|nanoflann DATA "
        "COUNT double3|float2\n",
        argv[0]);
    return 2;
  }
  const auto number = static_cast<unsigned>(std::atoi(argv[2]));
  const auto count = static_cast<std::size_t>(std::atoi(argv[5]));
  const std::size_t sum = std::string(argv[6]) == "float2"
                              ? run<float, 2>(argv[1], number, argv[3], argv[4], count)
                              : run<double, 3>(argv[1], number, argv[3], argv[4], count);
  std::printf("%zu\n", sum);
  return 0;
}

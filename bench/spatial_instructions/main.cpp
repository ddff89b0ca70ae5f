// One operation of one container, for run.sh, which counts its instructions. In: operation, peer, data and
// number of elements. Out: the sum that came out, so that peers can be compared.
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "spatial/data.hpp"
#include "spatial/peers.hpp"

namespace {

using Box = spatial::Box<double, 3>;
using Boxes = std::vector<Box>;

// run.sh counts what happens in functions of this name.
template <class Peer>
[[gnu::noinline]] Peer measured(const Boxes& boxes, bool load) {
  return load ? Peer::bulk(boxes) : Peer::one_by_one(boxes);
}
template <class Peer>
[[gnu::noinline]] std::size_t measured(const Peer& tree, const std::string& operation, unsigned number,
                                       const Boxes& boxes, const Boxes& queries) {
  std::size_t sum = 0;
  if (operation == "query") {
    for (const Box& q : queries) sum += tree.query(q);
  } else if (operation == "nearest") {
    for (const Box& q : queries) tree.nearest(q.min, number, [&](std::uint32_t i) { sum += i; });
  } else {
    sum = tree.pairs(boxes);
  }
  return sum;
}

template <class Peer>
std::size_t run(const std::string& operation, unsigned number, const Boxes& boxes) {
  if (operation == "insert" || operation == "load") {
    const Peer tree = measured<Peer>(boxes, operation == "load");
    return tree.query(boxes.front());
  }
  const Peer tree = Peer::bulk(boxes);
  Boxes queries;
  if (operation != "pairs") {
    const auto counter = peers::Bbtt<double, 3>::bulk(boxes);
    queries = data::queries<double, 3>(boxes, operation == "query" ? number : 1, 1000,
                                       [&](const Box& q) { return counter.count(q); });
  }
  return measured(tree, operation, number, boxes, queries);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: %s insert|load|query|nearest|pairs NUMBER bbtt|linear|rstar DATA COUNT\n",
                 argv[0]);
    return 2;
  }
  const std::string operation = argv[1];
  const auto number = static_cast<unsigned>(std::atoi(argv[2]));
  const std::string peer = argv[3];
  const auto boxes = data::make<double, 3>(argv[4], static_cast<std::size_t>(std::atoi(argv[5])));
  const std::size_t sum = peer == "bbtt"     ? run<peers::Bbtt<double, 3>>(operation, number, boxes)
                          : peer == "linear" ? run<peers::Linear<double, 3>>(operation, number, boxes)
                                             : run<peers::Rstar<double, 3>>(operation, number, boxes);
  std::printf("%zu\n", sum);
  return 0;
}

// A simulation in blocks: the same to the bit for any number of threads, fresh and after cuts; and blocks
// pull at nodes as single springs do.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cut/adapt/threads.hpp>
#include <cut/cutter.hpp>
#include <cut/simulation.hpp>
#include <cut/spring_blocks.hpp>
#include <cut/validate.hpp>
#include <random>
#include <scenes/cloths.hpp>
#include <scenes/cutters.hpp>

namespace {

constexpr std::size_t cells = 60;  // 3,721 nodes, more than one block

/// A sheet that is cut again and again while it swings.
std::vector<Eigen::Vector3d> swing(const cut::Executor& executor) {
  cut::HybridMesh mesh = *cut::HybridMesh::build(scenes::grid(cells, cells));
  cut::Cutter knife(cut::default_merge_distances(mesh));
  cut::Simulation simulation = *cut::Simulation::build(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.01});
  simulation.executor = knife.executor = executor;
  simulation.surroundings.gravity = {0, 1, -9.81};
  simulation.surroundings.longest_way = 100;
  simulation.anchor(cut::NodeId{0u});
  simulation.set_force(cut::NodeId{cells * cells / 2}, {0.1, 0.2, 3});
  std::mt19937 random(7);
  const auto somewhere = [&] { return static_cast<double>(random() % 1000) / 1000 * cells; };
  for (int i = 0; i < 12; ++i) {
    CHECK_FALSE(simulation.step(mesh, 1e-3, 5));
    const Eigen::Vector3d from{somewhere(), somewhere(), 0}, to{somewhere(), somewhere(), 0};
    const auto changes = knife.cut(mesh, scenes::ribbon({from, to}, {0.1, 0, 20}));
    REQUIRE(changes);
    CHECK_FALSE(simulation.apply(*changes, mesh));
  }
  CHECK_FALSE(simulation.step(mesh, 1e-3, 5));
  CHECK(mesh.buffers.nodes.size() > (cells + 1) * (cells + 1));
  CHECK(cut::validate(mesh, 1).empty());
  return mesh.positions;
}

/// What pulls at each node, block by block: the other end and a number of the spring, sorted.
using Pulls = std::vector<std::vector<std::pair<std::uint32_t, double>>>;

Pulls pulls_of(const cut::SpringBlocks& blocks) {
  Pulls pulls(blocks.node_count());
  for (const cut::SpringDiagonal& d : blocks.diagonals())
    for (std::size_t i = 0; i < d.used.size(); ++i) {
      const double stiffness = d.springs[i / 4].stiffness[i % 4];
      if (d.used[i] == 0) {
        CHECK(stiffness == 0);
        continue;
      }
      const auto a = static_cast<std::uint32_t>(i), b = a + d.offset;
      pulls[a].emplace_back(b, stiffness);
      pulls[b].emplace_back(a, stiffness);
    }
  for (const cut::SpringBlock& block : blocks.blocks()) {
    const auto node = [&](std::uint32_t name) {
      return blocks.diagonals().empty() ? name : block.placed[name % 2].nodes()[name / 2];
    };
    REQUIRE(block.copy_places.size() == (blocks.diagonals().empty() ? 0 : block.copies.size()));
    for (std::size_t i = 0; i < block.copy_places.size(); ++i)
      CHECK(node(2 * block.copy_places[i] + 1) == block.copies[i] + blocks.nodes_in_diagonals());
    for (const auto* list : {&block.inner, &block.outer})
      for (std::size_t i = 0; i < list->nodes.size(); ++i) {
        if (list->nodes[i][0] == list->nodes[i][1]) continue;
        const std::uint32_t a = node(list->nodes[i][0]), b = node(list->nodes[i][1]);
        pulls[a].emplace_back(b, list->stiffness[i]);
        if (list == &block.inner) pulls[b].emplace_back(a, list->stiffness[i]);
      }
  }
  for (auto& list : pulls) std::sort(list.begin(), list.end());
  return pulls;
}

}  // namespace

TEST_CASE("a simulation is the same to the bit for any number of threads") {
  const auto one_thread = swing({});
  for (const std::size_t threads : {std::size_t{2}, std::size_t{3}, std::size_t{8}})
    CHECK(swing(cut::thread_executor(threads)) == one_thread);
}

TEST_CASE("blocks have each spring at both of its ends, however springs are set and moved") {
  std::mt19937 random(3);
  for (const std::size_t nodes : {std::size_t{10}, std::size_t{5000}, std::size_t{6000}}) {
    cut::SpringBlocks blocks;
    blocks.reset(nodes, nodes == 5000 ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{1, 7, 30});
    CHECK((blocks.blocks().size() > 1) == (nodes > 10));
    const std::size_t count = 4 * nodes;
    cut::SpringArrays springs{std::vector<std::array<std::uint32_t, 2>>(count), std::vector<double>(count),
                              std::vector<double>(count), std::vector<double>(count)};
    std::vector<cut::SpringPlace> places(count);
    for (std::size_t change = 0; change < 5 * count; ++change) {
      if (change % 100 == 0) blocks.add_copy(static_cast<std::uint32_t>(random() % blocks.node_count()));
      const std::size_t i = random() % count;
      const auto a = static_cast<std::uint32_t>(random() % blocks.node_count());
      const std::size_t kind = random() % 5;
      auto b = static_cast<std::uint32_t>(random() % blocks.node_count());
      if (kind == 0) b = a;
      if (kind < 4) b = std::min(b, a + std::array<std::uint32_t, 4>{0, 1, 7, 30}[kind]);
      springs.nodes[i] = {a, b};
      springs.stiffness[i] = a == b ? 0 : static_cast<double>(change);
      blocks.set(springs, i, places[i]);
    }
    Pulls wanted(blocks.node_count());
    for (std::size_t i = 0; i < count; ++i) {
      const auto [a, b] = springs.nodes[i];
      if (a == b) continue;
      wanted[a].emplace_back(b, springs.stiffness[i]);
      wanted[b].emplace_back(a, springs.stiffness[i]);
    }
    for (auto& list : wanted) std::sort(list.begin(), list.end());
    CHECK(pulls_of(blocks) == wanted);
  }
}

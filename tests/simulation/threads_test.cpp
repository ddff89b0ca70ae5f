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

/// A sheet that is cut again and again while it swings; onto a ball in implicit steps.
std::vector<Eigen::Vector3d> swing(const cut::Executor& executor,
                                   cut::Integrator integrator = cut::Integrator::semi_implicit_euler) {
  cut::HybridMesh mesh = *cut::HybridMesh::build(scenes::grid(cells, cells));
  cut::Cutter knife(cut::default_merge_distances(mesh));
  cut::Simulation simulation = *cut::Simulation::build(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.01});
  simulation.executor = knife.executor = executor;
  simulation.surroundings.gravity = {0, 1, -9.81};
  simulation.surroundings.longest_way = 100;
  simulation.surroundings.integrator = integrator;
  const bool implicit = integrator == cut::Integrator::implicit_euler;
  if (implicit) simulation.surroundings.spheres.push_back({{40, 40, -8.1}, 8, {0, 0, 0}, 0.2});
  simulation.anchor(cut::NodeId{0u});
  simulation.set_force(cut::NodeId{cells * cells / 2}, {0.1, 0.2, 3});
  std::mt19937 random(7);
  const auto somewhere = [&] { return static_cast<double>(random() % 1000) / 1000 * cells; };
  for (int i = 0; i < (implicit ? 4 : 12); ++i) {
    CHECK_FALSE(simulation.step(mesh, implicit ? 0.05 : 1e-3, implicit ? 1 : 5));
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
  const std::vector<std::uint32_t>& node_at = blocks.slots();
  std::vector<const cut::SpringBlock*> owners(node_at.size(), nullptr);  // who writes there
  for (const cut::SpringBlock& block : blocks.blocks()) {
    const auto own = [&](std::uint32_t slot) {
      CHECK(owners[slot] == nullptr);
      owners[slot] = &block;
    };
    if (!blocks.diagonals().empty()) own(block.nobody);
    for (const cut::SlottedNode& copy : block.copies) {
      own(copy.slot);
      CHECK(node_at[copy.slot] == copy.node);
      CHECK(blocks.slot(copy.node) == copy.slot);
    }
    for (const cut::SlottedNode& held : block.held.nodes()) {
      own(held.slot);
      CHECK(node_at[held.slot] == held.node);
    }
    if (blocks.diagonals().empty())
      for (std::uint32_t n = block.first; n < block.last; ++n) own(n);
    for (const auto* list : {&block.inner, &block.outer})
      for (std::size_t i = 0; i < 4 * list->size(); ++i) {
        const auto slots = (*list)[i / 4].nodes[i % 4];
        const double stiffness = (*list)[i / 4].springs.stiffness[i % 4];
        CHECK(owners[slots[0]] == &block);
        if (slots[0] == slots[1]) {
          CHECK(stiffness == 0);
          continue;
        }
        if (list == &block.inner) CHECK(owners[slots[1]] == &block);
        const std::uint32_t a = node_at[slots[0]], b = node_at[slots[1]];
        pulls[a].emplace_back(b, stiffness);
        if (list == &block.inner) pulls[b].emplace_back(a, stiffness);
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

TEST_CASE("implicit steps are the same to the bit for any number of threads") {
  const auto one_thread = swing({}, cut::Integrator::implicit_euler);
  for (const std::size_t threads : {std::size_t{2}, std::size_t{3}, std::size_t{4}})
    CHECK(swing(cut::thread_executor(threads), cut::Integrator::implicit_euler) == one_thread);
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

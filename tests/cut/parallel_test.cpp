// Results are the same to the bit for any number of threads: random sequences, and one cut that meets every
// triangle of a sheet.
#include <doctest/doctest.h>

#ifdef SNIP_TBB
#include <cut/adapt/tbb.hpp>
#endif
#include <cut/adapt/threads.hpp>
#include <random>
#include <vector>

#include "random_cuts.hpp"

namespace {

/// Runs the sequence that the bytes describe, and returns the buffers after each cut.
std::vector<cut::Buffers> buffers_of(const std::vector<std::uint8_t>& data, const cut::Executor& executor) {
  random_cuts::Bytes bytes(data.data(), data.size());
  const random_cuts::Cloth input = random_cuts::cloth(bytes);
  cut::HybridMesh mesh = *cut::HybridMesh::build(input.mesh);
  cut::Cutter knife(random_cuts::distances(bytes, mesh));
  knife.executor = executor;
  std::vector<cut::Buffers> all;
  for (int i = 0; i < 12 && !bytes.empty(); ++i) {
    REQUIRE(knife.cut(mesh, random_cuts::cutter(bytes, input)));
    CHECK(cut::validate(mesh, 1).empty());
    all.push_back(mesh.buffers);
  }
  return all;
}

cut::HybridMesh cut_to_ribbons(const cut::Executor& executor) {
  cut::HybridMesh mesh = *cut::HybridMesh::build(scenes::grid(20, 20));
  std::vector<cut::TriangleMesh> parts;
  for (int i = 0; i < 20; ++i)
    parts.push_back(scenes::ribbon({{i + 0.37, -1, 0}, {i + 0.57, 21, 0}}, {0.1, 0, 2}));
  cut::Cutter knife(cut::default_merge_distances(mesh));
  knife.executor = executor;
  REQUIRE(knife.cut(mesh, scenes::joined(parts)));
  return mesh;
}

std::vector<cut::Executor> parallel_executors() {
  std::vector<cut::Executor> executors{cut::thread_executor(2), cut::thread_executor(3),
                                       cut::thread_executor(8)};
#ifdef SNIP_TBB
  executors.push_back(cut::tbb_executor());
#endif
  return executors;
}

}  // namespace

TEST_CASE("random cuts are the same for any number of threads") {
  const std::vector<cut::Executor> executors = parallel_executors();
  std::mt19937 random(4);
  for (int sequence = 0; sequence < 40; ++sequence) {
    std::vector<std::uint8_t> data(300);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
    const auto one_thread = buffers_of(data, {});
    for (const cut::Executor& executor : executors) CHECK(buffers_of(data, executor) == one_thread);
  }
}

TEST_CASE("a sheet cut to ribbons at once is the same for any number of threads") {
  const cut::HybridMesh one_thread = cut_to_ribbons({});
  CHECK(one_thread.buffers.triangles.size() >= 1600);  // every triangle was cut
  CHECK(cut::validate(one_thread, 1).empty());
  for (const cut::Executor& executor : parallel_executors()) {
    const cut::HybridMesh mesh = cut_to_ribbons(executor);
    CHECK(mesh.buffers == one_thread.buffers);
    CHECK(mesh.edge_states == one_thread.edge_states);
  }
}

// Updates per second of the mass-spring-damper simulation: on the paper's patch of 12 triangles (§6 reports
// 63,000) and on grids, beside the plainest loop over springs that does the same work.
//   paper_ratio   updates per second as a multiple of the paper's
//   ns_per_spring
#include <benchmark/benchmark.h>

#include <cut/simulation.hpp>
#include <scenes/cloths.hpp>

namespace {

constexpr double time_step = 1e-4;
const cut::Material material{cut::MaterialMode::conserving, 0.2, 100, 0.01};

cut::HybridMesh cloth(std::size_t cells) {
  return *cut::HybridMesh::build(cells == 0 ? scenes::twelve_triangles() : scenes::grid(cells, cells));
}

/// Ripples, so that springs have work to do.
void ripple(std::vector<Eigen::Vector3d>& positions) {
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n].z() += 0.01 * static_cast<double>(n % 5);
}

void report(benchmark::State& state, std::size_t springs, std::size_t steps) {
  const double updates = static_cast<double>(state.iterations()) * static_cast<double>(steps);
  state.counters["updates_per_s"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["paper_ratio"] = benchmark::Counter(updates / 63000, benchmark::Counter::kIsRate);
  state.counters["ns_per_spring"] =
      benchmark::Counter(updates * static_cast<double>(springs) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// cells × cells squares (0: the paper's patch), range(1) steps for each call.
void simulation(benchmark::State& state) {
  cut::HybridMesh mesh = cloth(static_cast<std::size_t>(state.range(0)));
  cut::Simulation simulation = *cut::Simulation::build(mesh, material);
  simulation.surroundings.gravity = {0, 0, -9.81};
  simulation.surroundings.longest_way = 1e9;
  simulation.anchor(cut::NodeId{0u});
  ripple(mesh.positions);
  const auto steps = static_cast<std::size_t>(state.range(1));
  for (auto _ : state)
    if (const auto error = simulation.step(mesh, time_step, steps))
      state.SkipWithError(error->message.c_str());
  report(state, simulation.spring_count(), steps);
}

/// Equations 1 to 6 as one would write them down.
struct PlainCloth {
  std::vector<Eigen::Vector3d> positions, velocities, forces;
  std::vector<double> masses;
  struct PlainSpring {
    std::uint32_t a, b;
    double rest_length, stiffness, damping;
  };
  std::vector<PlainSpring> springs;

  explicit PlainCloth(const cut::HybridMesh& mesh) : positions(mesh.positions) {
    const cut::Simulation simulation = *cut::Simulation::build(mesh, material);
    velocities.assign(positions.size(), Eigen::Vector3d::Zero());
    forces = velocities;
    for (std::size_t n = 0; n < positions.size(); ++n) masses.push_back(simulation.mass(cut::NodeId{n}));
    for (const cut::Spring& s : mesh.buffers.springs)
      springs.push_back({s.nodes[0].value, s.nodes[1].value, mesh.ancestors.rest_length(s.edge),
                         material.stiffness, material.damping});
    ripple(positions);
  }

  void step() {
    for (std::size_t n = 0; n < positions.size(); ++n) forces[n] = masses[n] * Eigen::Vector3d(0, 0, -9.81);
    for (const PlainSpring& s : springs) {
      const Eigen::Vector3d along = positions[s.b] - positions[s.a];
      const double length = along.norm();
      const Eigen::Vector3d direction = along / length;
      const double rate = (velocities[s.b] - velocities[s.a]).dot(direction);
      const Eigen::Vector3d force = direction * (s.stiffness * (length - s.rest_length) + s.damping * rate);
      forces[s.a] += force;
      forces[s.b] -= force;
    }
    for (std::size_t n = 1; n < positions.size(); ++n) {
      velocities[n] += forces[n] / masses[n] * time_step;
      positions[n] += velocities[n] * time_step;
    }
  }
};

void plain_loop(benchmark::State& state) {
  PlainCloth cloth_of_springs(cloth(static_cast<std::size_t>(state.range(0))));
  for (auto _ : state)
    for (std::int64_t i = 0; i < state.range(1); ++i) cloth_of_springs.step();
  benchmark::DoNotOptimize(cloth_of_springs.positions.data());
  report(state, cloth_of_springs.springs.size(), static_cast<std::size_t>(state.range(1)));
}

/// The paper's patch one step at a time and a frame at a time; then 10³ to 10⁶ nodes.
void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"cells", "steps"})->Args({0, 1})->Args({0, 100});
  for (const std::int64_t cells : {31, 99, 315, 999}) b->Args({cells, 10});
}

BENCHMARK(simulation)->Apply(sizes);
BENCHMARK(plain_loop)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();

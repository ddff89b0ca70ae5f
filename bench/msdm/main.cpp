// The speed of the mass-spring-damper simulation, and of cutting on several threads, as tables in Markdown
// (bench/results/msdm.md). All programs of a table take turns in one process; times are those of the wall
// clock, the least of all rounds.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cut/adapt/threads.hpp>
#include <cut/cutter.hpp>
#include <limits>
#include <scenes/cutters.hpp>

#include "msdm/measure.hpp"
#include "msdm/plain.hpp"
#ifdef SNIP_BENCH_BULLET
#include "msdm/bullet.hpp"
#endif

namespace {

using msdm::Contender;

/// Bytes per second of a[i] = b[i] + c[i] in arrays that no cache holds.
double bandwidth() {
  const std::size_t size = 8'000'000;
  std::vector<double> a(size, 1), b(size, 2), c(size, 3);
  std::vector<Contender> sum{{"sum", [&] {
                                for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + c[i];
                              }}};
  msdm::take_turns(sum, 15);
  if (a[size / 2] != 5) std::abort();
  return static_cast<double>(3 * size * sizeof(double)) / (sum[0].least() * 1e-3);
}

/// What a step of a sheet in diagonals has to move: position and velocity of a node in and out, and the
/// inverse of its mass; rest length, stiffness and damping of a spring.
double bytes_of_step(const cut::Simulation& simulation) {
  return 104.0 * static_cast<double>(simulation.node_count()) +
         24.0 * static_cast<double>(simulation.spring_count());
}

/// In one call, as for a frame: explicit steps of stiff cloth are short.
constexpr std::size_t steps_of_frame = 64;

struct Simulated {
  cut::HybridMesh mesh;
  cut::Simulation simulation;

  explicit Simulated(cut::HybridMesh cloth, std::size_t threads = 1)
      : mesh(std::move(cloth)), simulation(*cut::Simulation::build(mesh, msdm::material)) {
    simulation.surroundings.gravity = {0, 0, -9.81};
    simulation.surroundings.longest_way = 1e9;
    simulation.anchor(cut::NodeId{0u});
    if (threads > 1) simulation.executor = cut::thread_executor(threads);
    msdm::ripple(mesh.positions);
  }
  void step(std::size_t count) {
    if (const auto error = simulation.step(mesh, msdm::time_step, count)) {
      std::fputs(error->message.c_str(), stderr);
      std::abort();
    }
  }
};

void speeds() {
  const double speed = bandwidth();
  std::printf("Memory: %.1f GB/s\n\n", speed * 1e-9);
  std::puts(
      "| nodes | springs | ns per spring | plain loop / ours | one thread / two | two simulations, in turn / "
      "at once | Bullet, a step / ours | its links alone / ours | ours / what memory allows | updates per "
      "second / 63,000 |");
  std::puts("|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  const cut::Executor two = cut::thread_executor(2);
  for (const std::size_t cells : {0u, 31u, 99u, 315u, 999u}) {
    const cut::HybridMesh mesh = msdm::cloth(cells);
    Simulated ours(mesh), threads(mesh, 2);
    std::array<Simulated, 2> alone{Simulated(mesh), Simulated(mesh)};
    msdm::PlainCloth plain(mesh);
    const std::size_t springs = ours.simulation.spring_count();
    const std::size_t steps = std::max(steps_of_frame, 300'000 / springs);
    const std::size_t theirs = std::max<std::size_t>(4, 300'000 / springs);
    const auto times = [theirs](auto step) {
      return [theirs, step] {
        for (std::size_t i = 0; i < theirs; ++i) step();
      };
    };
    std::vector<Contender> all{
        {"ours", [&] { ours.step(steps); }},
        {"threads", [&] { threads.step(steps); }},
        {"at once", [&] { two.for_each(2, [&](std::size_t i) { alone[i].step(steps); }); }},
        {"plain", times([&] { plain.step(); })}};
#ifdef SNIP_BENCH_BULLET
    msdm::BulletCloth bullet(mesh);
    all.push_back({"bullet", times([&] { bullet.step(); })});
    all.push_back({"links", times([&] { bullet.links(); })});
#endif
    msdm::take_turns(all, cells > 500 ? 15 : 40);
    const double best = all[0].least(), step = best / static_cast<double>(steps);
    const auto other = [&](std::size_t i) { return all[i].least() / static_cast<double>(theirs) / step; };
    std::printf("| %zu | %zu | %.2f | %.2f | %.2f | %.2f | ", ours.simulation.node_count(), springs,
                step * 1e6 / static_cast<double>(springs), other(3), best / all[1].least(),
                2 * best / all[2].least());
    if (all.size() > 4)
      std::printf("%.2f | %.2f | ", other(4), other(5));
    else
      std::printf("| | ");
    std::printf("%.2f | %.1f |\n", step * 1e-3 * speed / bytes_of_step(ours.simulation), 1e3 / step / 63000);
    if (ours.mesh.positions != threads.mesh.positions) std::puts("NOT THE SAME with two threads");
  }
}

/// Speed per spring of a cloth that was cut so often, and of the same cloth uncut. Cuts begin anywhere and
/// are up to three cells long in each direction.
void after_cuts(const char* name, const cut::HybridMesh& cloth, std::size_t cuts) {
  Simulated fresh(cloth), worn(cloth);
  cut::Cutter knife(cut::default_merge_distances(worn.mesh));
  std::uint64_t random = 1;
  const auto number = [&](double most) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(random >> 40) / static_cast<double>(1 << 24) * most;
  };
  for (std::size_t i = 0; i < cuts; ++i) {
    const auto n = static_cast<std::size_t>(number(static_cast<double>(cloth.positions.size())));
    const Eigen::Vector3d from = cloth.positions[n] + Eigen::Vector3d(number(1), number(1), 0);
    const Eigen::Vector3d to = from + Eigen::Vector3d(number(6) - 3, number(6) - 3, 0);
    const auto changes = knife.cut(worn.mesh, scenes::ribbon({from, to}, {0.01, 0, 4}));
    if (!changes || worn.simulation.apply(*changes, worn.mesh)) std::abort();
  }
  std::vector<Contender> both{{"fresh", [&] { fresh.step(steps_of_frame); }},
                              {"worn", [&] { worn.step(steps_of_frame); }}};
  msdm::take_turns(both, cloth.positions.size() > 500'000 ? 10 : cloth.positions.size() > 50'000 ? 20 : 60);
  const double per_spring = static_cast<double>(fresh.simulation.spring_count()) /
                            static_cast<double>(worn.simulation.spring_count());
  std::printf("| %s | %zu | %zu | %zu | %zu | %.2f | %.3f |\n", name, cloth.positions.size(), cuts,
              fresh.simulation.spring_count(), worn.simulation.spring_count(),
              both[0].least() * 1e6 / static_cast<double>(steps_of_frame * fresh.simulation.spring_count()),
              both[1].least() / both[0].least() * per_spring);
}

/// 10,368 triangles, all of them cut at once by 72 walls: on one thread, on two, and two such cuts at once, a
/// thread for each, which shows what the second core adds to this work.
void cut_at_once() {
  const std::size_t n = 72;
  std::vector<cut::TriangleMesh> walls;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) + 0.37;
    walls.push_back(scenes::ribbon({{x, -1, 0}, {x + 0.2, n + 1.0, 0}}, {0.1, 0, 2}));
  }
  const cut::TriangleMesh cutter = scenes::joined(walls);
  const cut::HybridMesh cloth = msdm::cloth(n);
  const cut::Executor two = cut::thread_executor(2);
  std::array<cut::StepTimings, 3> steps{};
  std::array<cut::Buffers, 2> results;
  std::array<double, 3> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (std::size_t round = 0; round < 60; ++round) {
    const std::size_t which = round % 3;
    std::array<cut::HybridMesh, 2> meshes{cloth, cloth};
    const cut::MergeDistances distances = cut::default_merge_distances(cloth);
    std::array<cut::Cutter, 2> knives{cut::Cutter(distances), cut::Cutter(distances)};
    if (which == 1) knives[0].executor = two;
    const auto cut = [&](std::size_t i) {
      if (!knives[i].cut(meshes[i], cutter)) std::abort();
    };
    const auto begin = std::chrono::steady_clock::now();
    if (which == 2)
      two.for_each(2, cut);
    else
      cut(0);
    const double time =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (time < least[which]) {
      least[which] = time;
      steps[which] = knives[0].timings();
    }
    if (which < 2) results[which] = std::move(meshes[0].buffers);
  }
  std::puts(
      "\n| cuts | threads for each | all, ms | detect | merge endpoints | arrange | reconnect | publish |");
  std::puts("|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (std::size_t which = 0; which < 3; ++which) {
    const cut::StepTimings& t = steps[which];
    std::printf("| %d | %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", which == 2 ? 2 : 1,
                which == 1 ? 2 : 1, least[which], t.detect, t.merge_endpoints, t.arrange, t.reconnect,
                t.publish);
  }
  if (!(results[0] == results[1])) std::puts("NOT THE SAME with two threads");
}

/// Two seconds at 60 frames per second of a sheet with cells of 1 cm that hangs on two corners, while a blade
/// goes through it at half a metre per second. An implicit step goes over the whole frame.
void scene(std::size_t cells, cut::Integrator integrator) {
  using Clock = std::chrono::steady_clock;
  cut::HybridMesh mesh = *cut::HybridMesh::build(scenes::grid(cells, cells, 0.01));
  cut::Simulation simulation =
      *cut::Simulation::build(mesh, {cut::MaterialMode::conserving, 0.2, 100, 0.01, 0, 0});
  cut::Cutter knife(cut::default_merge_distances(mesh));
  simulation.executor = knife.executor = cut::thread_executor(2);
  simulation.surroundings.gravity = {0, -9.81, 0};
  simulation.surroundings.air_drag = 0.05;
  simulation.anchor(cut::NodeId{cells * (cells + 1)});
  simulation.anchor(cut::NodeId{(cells + 1) * (cells + 1) - 1});
  const double frame = 1.0 / 60;
  const bool implicit = integrator == cut::Integrator::implicit_euler;
  simulation.surroundings.integrator = integrator;
  const auto substeps =
      implicit ? 1 : static_cast<std::size_t>(frame / (0.5 * simulation.stable_time_step(integrator))) + 1;
  std::vector<double> times;
  double cutting = 0;
  for (int i = 0; i < 120; ++i) {
    const Clock::time_point begin = Clock::now();
    if (simulation.step(mesh, frame / static_cast<double>(substeps), substeps)) std::abort();
    const Clock::time_point stepped = Clock::now();
    const double x = -0.01 + 0.5 * frame * i, y = 0.005 * static_cast<double>(cells);
    const auto changes = knife.cut(mesh, scenes::ribbon({{x, y, 0}, {x + 0.5 * frame, y, 0}}, {0, 0.01, 2}));
    if (!changes || simulation.apply(*changes, mesh)) std::abort();
    const Clock::time_point end = Clock::now();
    times.push_back(std::chrono::duration<double, std::milli>(end - begin).count());
    cutting += std::chrono::duration<double, std::milli>(end - stepped).count();
  }
  std::sort(times.begin(), times.end());
  double sum = 0;
  for (const double t : times) sum += t;
  std::printf("| %zu | %s | %zu | %.2f | %.2f | %.2f | %.2f | %zu |\n", 2 * cells * cells,
              implicit ? "implicit" : "semi-implicit", substeps, times[60], times[114], cutting / 120,
              2000 / sum, simulation.node_count() - (cells + 1) * (cells + 1));
}

}  // namespace

int main() {
  speeds();
  std::puts(
      "\n| cloth | nodes | cuts | springs | springs after | ns per spring | after / before |\n"
      "|---|--:|--:|--:|--:|--:|--:|");
  after_cuts("rows", msdm::cloth(99), 3);
  after_cuts("rows", msdm::cloth(99), 1000);
  after_cuts("rows", msdm::cloth(315), 1000);
  after_cuts("rows", msdm::cloth(999), 1000);
  after_cuts("rings", *cut::HybridMesh::build(scenes::hexagon(57)), 1000);
  after_cuts("rings", *cut::HybridMesh::build(scenes::hexagon(182)), 1000);
  cut_at_once();
  std::puts(
      "\n| triangles | integrator | substeps | frame, ms | 19 of 20 frames, ms | of it cutting | times real "
      "time | node "
      "copies |\n|--:|---|--:|--:|--:|--:|--:|--:|");
  for (const std::size_t cells : {71u, 80u, 90u, 100u, 142u})
    scene(cells, cut::Integrator::semi_implicit_euler);
  for (const std::size_t cells : {71u, 100u}) scene(cells, cut::Integrator::implicit_euler);
}

// bench_cutting: progressive cuts, one-shot cuts and a mesh of a million triangles, libcut and its peers in
// one run, as Markdown tables on stdout. Exit code 1 when libcut leaves a wrong number of pieces.
//
//   bench_cutting            everything, a few minutes
//   bench_cutting --quick    the small sizes, a few seconds
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "cutting/isolated.hpp"
#include "cutting/measure.hpp"
#include "cutting/programs.hpp"

namespace {

using namespace cutting;
using Cells = std::vector<std::size_t>;

constexpr std::size_t right_pieces = 2;  // in every experiment here
constexpr std::size_t any_size = 1'000'000'000;

template <class Experiment, class Result>
struct Program {
  const char* name;
  void (*run)(const Experiment&, Result&);
  std::size_t most_triangles;  // it takes gigabytes or minutes beyond that
};

// libcut comes first: the others are compared with it.
const std::vector<Program<Progressive, StepsResult>> steps_programs{
    {"libcut", libcut_steps, any_size},
#ifdef SNIP_BENCH_CGAL
    {"CGAL split, EPICK", epick_steps, any_size},
    {"CGAL split, EPECK", epeck_steps, any_size},
#endif
};

const std::vector<Program<OneShot, OneShotResult>> once_programs{
    {"libcut", libcut_once, any_size},
#ifdef SNIP_BENCH_CGAL
    {"CGAL split, EPICK", epick_once, any_size},
    {"CGAL split, EPECK", epeck_once, any_size},
#endif
#ifdef SNIP_BENCH_VTK
    {"VTK clip", vtk_once, any_size},
#endif
#ifdef SNIP_BENCH_BULLET
    {"Bullet refine", bullet_once, 25'000},
#endif
};

bool all_right = true;

/// The number of pieces for the table. @param program its index: 0 is libcut
std::string pieces_text(std::size_t program, bool finished, std::size_t pieces,
                        const std::string& otherwise) {
  if (program == 0 && !(finished && pieces == right_pieces)) all_right = false;
  if (!finished) return otherwise;
  return std::to_string(pieces) + (pieces == right_pieces ? "" : " (wrong)");
}

/// Times of one program at one size, over all rounds.
struct StepTimes {
  std::vector<double> steps;
  std::vector<double> slowest;  // of each round
  StepsResult last;

  void add(const StepsResult& result) {
    last = result;
    if (result.steps_done == 0) return;
    const double* begin = result.step_ms.data();
    const double* end = begin + result.steps_done;
    steps.insert(steps.end(), begin, end);
    slowest.push_back(*std::max_element(begin, end));
  }
};

void progressive(const char* title, Progressive (*make)(std::size_t), const Cells& sizes,
                 std::size_t rounds) {
  std::printf("\n### %s\n\n", title);
  std::printf(
      "| triangles | program | step, ms | × the smallest sheet's | × libcut's | slowest step, ms | pieces |\n"
      "|--:|:--|--:|--:|--:|--:|--:|\n");
  std::vector<double> smallest(steps_programs.size(), 0);
  for (const std::size_t cells : sizes) {
    const Progressive experiment = make(cells);
    std::vector<StepTimes> times(steps_programs.size());
    for (std::size_t round = 0; round < rounds; ++round)
      for (std::size_t p = 0; p < times.size(); ++p)
        if (experiment.cloth.triangles.size() <= steps_programs[p].most_triangles)
          times[p].add(run_isolated<StepsResult>(
              [&](StepsResult& result) { steps_programs[p].run(experiment, result); }));
    for (std::size_t p = 0; p < times.size(); ++p) {
      const StepTimes& t = times[p];
      const std::string pieces = pieces_text(p, t.last.finished, t.last.pieces,
                                             "crashed in step " + std::to_string(t.last.steps_done + 1));
      std::printf("| %zu | %s |", experiment.cloth.triangles.size(), steps_programs[p].name);
      if (t.steps.empty()) {
        std::printf(" | | | | %s |\n", pieces.c_str());
        continue;
      }
      const double ms = median(t.steps);
      if (smallest[p] == 0) smallest[p] = ms;
      std::printf(" %.4f | %.2f | %.0f | %.2f | %s |\n", ms, ms / smallest[p], ms / median(times[0].steps),
                  median(t.slowest), pieces.c_str());
    }
    std::fflush(stdout);
  }
}

void one_shot(const Cells& sizes, std::size_t rounds) {
  std::printf("\n### One-shot: a ribbon of 128 triangles across the sheet\n\n");
  std::printf(
      "| triangles | program | own mesh, ms | cut, ms | cut / libcut's both | both / libcut's both | pieces "
      "| simulated triangles | their smallest angle | drawn triangles | their smallest angle |\n"
      "|--:|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::size_t cells : sizes) {
    const OneShot experiment = wave_across(cells);
    std::vector<std::vector<double>> own(once_programs.size()), cut(once_programs.size());
    std::vector<OneShotResult> last(once_programs.size());
    for (std::size_t round = 0; round < rounds; ++round)
      for (std::size_t p = 0; p < once_programs.size(); ++p) {
        if (experiment.cloth.triangles.size() > once_programs[p].most_triangles) continue;
        last[p] = run_isolated<OneShotResult>(
            [&](OneShotResult& result) { once_programs[p].run(experiment, result); });
        own[p].push_back(last[p].prepare_ms);
        cut[p].push_back(last[p].cut_ms);
      }
    for (std::size_t p = 0; p < once_programs.size(); ++p) {
      const OneShotResult& r = last[p];
      const bool tried = !cut[p].empty();
      const std::string pieces = pieces_text(p, r.finished, r.pieces, tried ? "crashed" : "too large");
      std::printf("| %zu | %s |", experiment.cloth.triangles.size(), once_programs[p].name);
      if (!r.finished) {
        std::printf(" | | | | %s | | | | |\n", pieces.c_str());
        continue;
      }
      const double own_ms = median(own[p]), cut_ms = median(cut[p]), ours = median(own[0]) + median(cut[0]);
      std::printf(" %.1f | %.1f | %.2f | %.2f | %s | %zu | %.2g° | %zu | %.2g° |\n", own_ms, cut_ms,
                  cut_ms / ours, (own_ms + cut_ms) / ours, pieces.c_str(), r.physics_triangles,
                  r.smallest_physics_angle, r.render_triangles, r.smallest_render_angle);
    }
    std::fflush(stdout);
  }
}

/// One size each, since the point is what it takes at most.
void memory(const Cells& sizes) {
  std::printf(
      "\n### Memory: libcut, the same ribbon\n\n"
      "| triangles | build, ms | first cut, ms | pieces | most memory of the process, MiB |\n"
      "|--:|--:|--:|--:|--:|\n");
  for (const std::size_t cells : sizes) {
    const OneShotResult r =
        run_isolated<OneShotResult>([&](OneShotResult& result) { libcut_once(wave_across(cells), result); });
    std::printf("| %zu | %.0f | %.0f | %s | %.0f |\n", 2 * cells * cells, r.prepare_ms, r.cut_ms,
                pieces_text(0, r.finished, r.pieces, "crashed").c_str(), r.peak_mebibytes);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
  if (argc > 1 && !quick) {
    std::fprintf(stderr, "usage: bench_cutting [--quick]\n");
    return 2;
  }
  const Cells sizes = quick ? Cells{20, 50} : Cells{20, 50, 100, 200};  // 800, 5k, 20k, 80k triangles
  one_shot(quick ? Cells{20, 50} : Cells{100, 200}, quick ? 3 : 7);
  memory({quick ? 100u : 708u});     // 708: a million triangles
  constexpr std::size_t rounds = 3;  // of 60 steps each
  progressive("Progressive: 60 quads round a corner, upright; as many triangles per quad in every sheet",
              round_corner_upright, sizes, rounds);
  progressive("Progressive: the same, leaning", round_corner_leaning, sizes, rounds);
  progressive("Progressive: 60 quads across the sheet, leaning; more triangles per quad in finer sheets",
              across_sheet, sizes, rounds);
  if (!all_right) std::fprintf(stderr, "bench_cutting: libcut left a wrong number of pieces\n");
  return all_right ? 0 : 1;
}

// Registers the benchmarks of libspatial and runs them. For a table of ratios see compare.py.
#include <benchmark/benchmark.h>

void add_tree_f2();
void add_tree_f3();
void add_tree_d2();
void add_tree_d3();
void add_dictionary();
#ifdef SNIP_BENCH_BOX2D
void add_box2d();
#endif
#ifdef SNIP_BENCH_SPATIALINDEX
void add_spatialindex();
#endif
#ifdef SNIP_BENCH_VTK
void add_vtk();
#endif

int main(int argc, char** argv) {
  add_tree_f2();
  add_tree_f3();
  add_tree_d2();
  add_tree_d3();
  add_dictionary();
#ifdef SNIP_BENCH_BOX2D
  add_box2d();
#endif
#ifdef SNIP_BENCH_SPATIALINDEX
  add_spatialindex();
#endif
#ifdef SNIP_BENCH_VTK
  add_vtk();
#endif
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// VTK as a peer of the point cluster dictionary: its incremental octree, which merges points within a
// tolerance.
#include <benchmark/benchmark.h>
#include <vtkIncrementalOctreePointLocator.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <cstddef>
#include <string>

#include "data.hpp"

void add_vtk() {
  for (std::size_t count = 1000; count <= 1'000'000; count *= 10) {
    const std::string name = "merge/uniform/double3/" + std::to_string(count) + "/vtk_octree";
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
      const auto points = data::cloud<double, 3>(count);
      for (auto _ : state) {
        vtkNew<vtkPoints> held;
        held->SetDataTypeToDouble();
        vtkNew<vtkIncrementalOctreePointLocator> octree;
        octree->SetTolerance(data::merge_distance<3>(count));
        const double bounds[6] = {0, 1, 0, 1, 0, 1};
        octree->InitPointInsertion(held, bounds);
        vtkIdType id = 0;
        for (const auto& p : points) octree->InsertUniquePoint(p.data(), id);
        state.counters["answer"] = static_cast<double>(held->GetNumberOfPoints());
      }
    })->Unit(benchmark::kMillisecond);
  }
}

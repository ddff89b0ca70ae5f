// The one-shot cut with VTK, with both outputs of vtkClipPolyData (programs.hpp).
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkIdList.h>
#include <vtkImplicitFunction.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include <cstdint>

#include "cutting/measure.hpp"
#include "cutting/programs.hpp"

namespace cutting {
namespace {

class Side : public vtkImplicitFunction {
 public:
  static Side* New();
  vtkTypeMacro(Side, vtkImplicitFunction);
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double p[3]) override { return experiment->side(p[0], p[1]); }
  void EvaluateGradient(double p[3], double gradient[3]) override {
    constexpr double h = 1e-6;
    gradient[0] = (experiment->side(p[0] + h, p[1]) - experiment->side(p[0] - h, p[1])) / (2 * h);
    gradient[1] = 1;
    gradient[2] = 0;
  }
  const OneShot* experiment = nullptr;
};
vtkStandardNewMacro(Side);

}  // namespace

void vtk_once(const OneShot& experiment, OneShotResult& result) {
  vtkNew<Side> side;
  side->experiment = &experiment;

  Stopwatch watch;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& p : experiment.cloth.positions) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : experiment.cloth.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> cloth;
  cloth->SetPoints(points);
  cloth->SetPolys(cells);
  result.prepare_ms = watch.lap();

  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(cloth);
  clip->SetClipFunction(side);
  clip->GenerateClippedOutputOn();
  clip->Update();
  result.cut_ms = watch.lap();

  // Triangles of both halves; their points are apart, and each half keeps those that it does not use.
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(clip->GetOutput());
  both->AddInputData(clip->GetClippedOutput());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(both->GetOutputPort());
  triangles->Update();
  vtkPolyData* output = triangles->GetOutput();
  cut::TriangleMesh mesh;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i) {
    const double* p = output->GetPoint(i);
    mesh.positions.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i) {
    output->GetCellPoints(i, corners);
    if (corners->GetNumberOfIds() == 3)
      mesh.triangles.push_back({static_cast<std::uint32_t>(corners->GetId(0)),
                                static_cast<std::uint32_t>(corners->GetId(1)),
                                static_cast<std::uint32_t>(corners->GetId(2))});
  }
  describe(mesh, result);
}

}  // namespace cutting

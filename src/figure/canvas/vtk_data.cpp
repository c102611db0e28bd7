#include "figure/canvas/vtk_data.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTypeInt64Array.h>

namespace dotyk::figure {

vtkSmartPointer<vtkPolyData> poly_data(const std::vector<Vec3>& points, const std::vector<int>& nodes, int each) {
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  float* to = coordinates->GetPointer(0);
  for (const Vec3& p : points)
    for (const double c : p) *to++ = static_cast<float>(c);
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetData(coordinates);
  vtkNew<vtkTypeInt64Array> ids;
  ids->SetNumberOfValues(static_cast<vtkIdType>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) ids->SetValue(static_cast<vtkIdType>(i), nodes[i]);
  vtkNew<vtkCellArray> cells;
  cells->SetData(each, ids);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk_points);
  if (each == 2)
    data->SetLines(cells);
  else
    data->SetPolys(cells);
  return data;
}

vtkSmartPointer<vtkActor> add_plain(vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width, double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
  return actor;
}

}  // namespace dotyk::figure

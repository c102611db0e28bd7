#include "figure/scene/shapes.hpp"

#include <numeric>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace dotyk::figure {

vtkSmartPointer<vtkPolyData> poly_data(const std::vector<Vec3>& points, const Facets& polygons) {
  const auto& [nodes, each] = polygons;
  vtkNew<vtkPoints> vtk_points;
  for (const Vec3& p : points) vtk_points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k % each == 0) cells->InsertNextCell(each);
    cells->InsertCellPoint(nodes[k]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk_points);
  each == 2 ? data->SetLines(cells) : data->SetPolys(cells);
  return data;
}

void add_plain(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width, double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width * stage.factor));
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
}

void Shapes::show(vtkRenderer* renderer, Colour colour, double width, double opacity) const {
  if (empty()) return;
  std::vector<int> nodes(points_.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  add_plain(stage_, renderer, poly_data(points_, {nodes, each_}), colour, width, opacity);
}

}  // namespace dotyk::figure

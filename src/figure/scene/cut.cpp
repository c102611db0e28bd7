// A cut through the bodies of a scene in space: what is beyond it is left out, and the field is seen on it.
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkFloatArray.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>

#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

constexpr double kOff = 1e-6;  // of the size of the scene: so that no face of a cell lies in the plane

// In rendered pixels; its function is positive on the side that stays.
vtkSmartPointer<vtkPlane> plane_of(const Stage& stage) {
  const Cut& cut = *stage.picture.cut;
  const View& view = stage.view;
  const Vec3 n = unit(cut.normal);
  double size = 0;
  for (const auto& [least, most] : stage.body_boxes) size = std::max(size, length(plus(most, least, -1)));
  const Vec3 at = stage.rendered(view.pixel(plus(cut.point, n, -kOff * size)), 0);
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(at[0], at[1], at[2]);
  plane->SetNormal(-dot(n, view.right), -dot(n, view.up), -dot(n, view.towards));
  return plane;
}

// The cells of a body that the plane cuts, with its values.
vtkSmartPointer<vtkUnstructuredGrid> cells_at(const Stage& stage, const BodyPicture& body, vtkPlane* plane) {
  vtkNew<vtkPoints> points;
  std::vector<double> side;
  for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
    Vec3 p = stage.rendered(stage.view.pixel(body.node(i, stage.picture.deformation)), 0);
    points->InsertNextPoint(p.data());
    side.push_back(plane->EvaluateFunction(p.data()));
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  const int each = nodes_per_cell(body.shape, 1), type = body.shape == CellShape::tetrahedron ? VTK_TETRA : VTK_HEXAHEDRON;
  vtkNew<vtkFloatArray> values;
  each_polygon({body.cells, each}, [&, number = std::size_t{0}](std::span<const int> cell) mutable {
    const std::size_t own = number++;
    const auto [least, most] = std::ranges::minmax(cell, {}, [&](int i) { return side[i]; });
    if (side[least] >= 0 || side[most] <= 0) return;
    std::array<vtkIdType, 8> nodes{};
    std::copy(cell.begin(), cell.end(), nodes.begin());
    grid->InsertNextCell(type, each, nodes.data());
    if (!body.cell_values.empty()) values->InsertNextValue(static_cast<float>(body.cell_values[own]));
  });
  for (const double value : body.values) values->InsertNextValue(static_cast<float>(value));
  if (!body.cell_values.empty()) grid->GetCellData()->SetScalars(values);
  else if (!body.values.empty()) grid->GetPointData()->SetScalars(values);
  return grid;
}

std::vector<double> values_on(vtkPolyData* cap, bool on_cells) {
  vtkDataArray* scalars = on_cells ? cap->GetCellData()->GetScalars() : cap->GetPointData()->GetScalars();
  std::vector<double> out;
  for (vtkIdType i = 0; scalars && i < scalars->GetNumberOfTuples(); ++i) out.push_back(scalars->GetTuple1(i));
  return out;
}

}  // namespace

void cut_bodies(const Stage& stage, vtkRenderer* renderer) {
  const vtkSmartPointer<vtkPlane> plane = plane_of(stage);
  vtkActorCollection* actors = renderer->GetActors();
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor()) actor->GetMapper()->AddClippingPlane(plane);
  for (std::size_t k = 0; k < stage.picture.bodies.size(); ++k) {
    const BodyPicture& body = stage.picture.bodies[k];
    vtkNew<vtkCutter> cutter;
    cutter->SetInputData(cells_at(stage, body, plane));
    cutter->SetCutFunction(plane);
    cutter->GenerateTrianglesOff();
    cutter->Update();
    vtkPolyData* cap = cutter->GetOutput();
    if (cap->GetNumberOfCells() == 0) continue;
    const bool on_cells = !body.cell_values.empty();
    const std::vector<double> values = stage.scale.shown ? values_on(cap, on_cells) : std::vector<double>{};
    values.empty() ? add_surface(stage, renderer, cap, plain_colour(k)) : add_coloured(stage, renderer, cap, values, on_cells);
    add_features(stage, renderer, cap, outline_colour, std::max(1.6, stage.em / 12));
  }
}

}  // namespace dotyk::figure

#include "figure/scene/shapes.hpp"

#include <numeric>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
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

namespace {

constexpr double feature_angle = 30;  // degrees between facets that make an edge

// Of a mapper whose input is to be set.
vtkSmartPointer<vtkActor> lit_actor(const Stage& stage, vtkRenderer* renderer, vtkPolyDataMapper* mapper, vtkPolyData* data) {
  const auto actor = vtkSmartPointer<vtkActor>::New();
  if (stage.plane) {
    mapper->SetInputData(data);
    actor->GetProperty()->SetLighting(false);
  } else {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(data);
    normals->SetFeatureAngle(feature_angle);
    mapper->SetInputConnection(normals->GetOutputPort());
    // Mostly unshaded, so that colours remain those of the bar.
    actor->GetProperty()->SetAmbient(0.68);
    actor->GetProperty()->SetDiffuse(0.38);
    actor->GetProperty()->SetSpecular(0);
  }
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

// A shaft of four corners, a head of four of which two coincide. `half`: of the head's width.
void add_arrow(Shapes& quads, const Vec3& tail, const Vec3& head, double width, double tip, double half, double lift) {
  const double size = std::hypot(head[0] - tail[0], head[1] - tail[1]);
  if (!(size > 0.5)) return;
  tip = std::min(tip, 0.7 * size);
  const Vec3 side{-(head[1] - tail[1]) / size, (head[0] - tail[0]) / size, 0};
  const Vec3 neck = part_way(head, tail, tip / size);
  for (const Vec3& p : {plus(tail, side, width / 2), plus(tail, side, -width / 2), plus(neck, side, -width / 2), plus(neck, side, width / 2),
                        plus(neck, side, half), plus(neck, side, -half), head, head})
    quads.add_pixel(p, lift);
}

}  // namespace

void add_coloured(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, const std::vector<double>& values, bool on_polygons) {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkFloatArray> scalars;
  for (const double value : values) scalars->InsertNextValue(static_cast<float>(value));
  if (on_polygons) data->GetCellData()->SetScalars(scalars), mapper->SetScalarModeToUseCellData();
  else data->GetPointData()->SetScalars(scalars), mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetLookupTable(lookup_table(stage.scale));
  mapper->UseLookupTableScalarRangeOn();
  lit_actor(stage, renderer, mapper, data);
}

void add_surface(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->ScalarVisibilityOff();
  lit_actor(stage, renderer, mapper, data)->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
}

void add_features(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width) {
  vtkNew<vtkFeatureEdges> features;
  features->SetInputData(data);
  features->SetFeatureAngle(feature_angle);
  features->ColoringOff();
  features->ManifoldEdgesOff();
  features->NonManifoldEdgesOff();
  features->Update();
  add_plain(stage, renderer, features->GetOutput(), colour, width);
}

void Shapes::show(vtkRenderer* renderer, Colour colour, double width, double opacity) const {
  if (empty()) return;
  std::vector<int> nodes(points_.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  add_plain(stage_, renderer, poly_data(points_, {nodes, each_}), colour, width, opacity);
}

void Arrows::add(const Vec3& tail, const Vec3& head) {
  const Vec3 back = unit(plus(tail, head, -1));
  add_arrow(dark_, tail, head, width_, tip_, 0.38 * tip_, 6);
  add_arrow(white_, plus(tail, back, rim_), plus(head, back, -2 * rim_), width_ + 2 * rim_, tip_ + 3 * rim_, 0.38 * tip_ + 1.8 * rim_, 5);
}

void Arrows::show(vtkRenderer* renderer, Colour colour) const {
  white_.show(renderer, {255, 255, 255});
  dark_.show(renderer, colour);
}

}  // namespace dotyk::figure

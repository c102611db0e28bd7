// The bodies themselves: fields, mesh edges, outlines.
#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "figure/scene/stage.hpp"
#include "figure/canvas/vtk_data.hpp"

namespace dotyk::figure {

namespace {

constexpr double feature_angle = 30;  // degrees between facets that make an edge
constexpr Colour outline_colour{40, 40, 40}, undeformed_colour{130, 130, 130};

Colour plain_colour(std::size_t k) {
  static constexpr std::array<Colour, 5> tints{{{214, 222, 232}, {233, 224, 208}, {216, 230, 218}, {230, 218, 230}, {226, 226, 226}}};
  return tints[k % tints.size()];
}

// Nodes in rendered pixels, `lift` pixels nearer to the eye.
std::vector<Vec3> pixels(const Stage& stage, const BodyPicture& body, double factor, double lift) {
  std::vector<Vec3> out(body.points.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) {
    Vec3 p = stage.view.pixel(node(body, i, factor));
    if (stage.plane) p[2] = 0;
    p[2] += lift;
    for (double& c : p) c *= stage.factor;
    out[i] = p;
  }
  return out;
}

void add_surface(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, const BodyPicture& body, std::size_t k) {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  if (!body.values.empty() && stage.scale.shown) {
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfValues(static_cast<vtkIdType>(body.values.size()));
    for (std::size_t i = 0; i < body.values.size(); ++i) values->SetValue(static_cast<vtkIdType>(i), static_cast<float>(body.values[i]));
    data->GetPointData()->SetScalars(values);
    mapper->SetLookupTable(lookup_table(stage.scale));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  } else {
    mapper->ScalarVisibilityOff();
    const Colour c = plain_colour(k);
    actor->GetProperty()->SetColor(c.r / 255.0, c.g / 255.0, c.b / 255.0);
  }
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
}

bool edges_wanted(const Stage& stage, const std::vector<Vec3>& at, const std::vector<int>& edges) {
  if (stage.picture.edges != MeshEdges::automatic) return stage.picture.edges == MeshEdges::on;
  double sum = 0;
  const std::size_t n = edges.size() / 2, step = std::max<std::size_t>(1, n / 2000);
  std::size_t count = 0;
  for (std::size_t e = 0; e < n; e += step, ++count) {
    const Vec3 d = plus(at[static_cast<std::size_t>(edges[2 * e])], at[static_cast<std::size_t>(edges[2 * e + 1])], -1);
    sum += std::hypot(d[0], d[1]);
  }
  return count > 0 && sum / static_cast<double>(count) > 0.4 * stage.em * stage.factor;
}

void plane_outlines(Stage& stage, const BodyPicture& body) {
  const Facets facets = boundary(body);
  for (const std::vector<int>& chain : chains(facets.nodes)) {
    std::vector<Point> now, before;
    for (const int i : chain) {
      now.push_back(stage.view.flat(node(body, static_cast<std::size_t>(i), stage.picture.deformation)));
      before.push_back(stage.view.flat(node(body, static_cast<std::size_t>(i), 0)));
    }
    const std::array<double, 2> dash{0.35 * stage.em, 0.22 * stage.em};
    if (stage.picture.undeformed_outline && stage.deformation_shows && !body.displacement.empty())
      stage.over.polyline(before, std::max(1.0, stage.em / 18), undeformed_colour, dash);
    stage.over.polyline(now, std::max(1.2, stage.em / 18), outline_colour);
  }
}

void add_features(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width) {
  vtkNew<vtkFeatureEdges> features;
  features->SetInputData(data);
  features->SetFeatureAngle(feature_angle);
  features->ColoringOff();
  features->ManifoldEdgesOff();
  features->NonManifoldEdgesOff();
  features->Update();
  add_plain(renderer, features->GetOutput(), colour, width * stage.factor);
}

}  // namespace

void draw_bodies(Stage& stage, vtkRenderer* renderer) {
  const double f = stage.picture.deformation;
  for (std::size_t k = 0; k < stage.picture.bodies.size(); ++k) {
    const BodyPicture& body = stage.picture.bodies[k];
    const int corners = body.shape == CellShape::triangle ? 3 : 4;
    const Facets facets = stage.window ? Facets{cells_near(body, f, *stage.window), corners} : stage.plane ? Facets{body.cells, corners} : boundary(body);
    const std::vector<Vec3> at = pixels(stage, body, f, 0);
    const vtkSmartPointer<vtkPolyData> surface = poly_data(at, facets.nodes, facets.each);
    add_surface(stage, renderer, surface, body, k);
    if (stage.picture.edges != MeshEdges::off) {
      const std::vector<int> edges = body.edges.empty() ? unique_edges(facets.nodes, facets.each) : body.edges;
      if (edges_wanted(stage, at, edges))
        add_plain(renderer, poly_data(pixels(stage, body, f, 0.5), edges, 2), {0, 0, 0}, 0.6 * stage.factor, 0.32);
    }
    if (stage.plane) {
      plane_outlines(stage, body);
      continue;
    }
    add_features(stage, renderer, poly_data(pixels(stage, body, f, 2), facets.nodes, facets.each), outline_colour, std::max(1.2, stage.em / 18));
    if (stage.picture.undeformed_outline && stage.deformation_shows && !body.displacement.empty())
      add_features(stage, renderer, poly_data(pixels(stage, body, 0, 0.3), facets.nodes, facets.each), undeformed_colour, std::max(0.8, stage.em / 28));
  }
}

}  // namespace dotyk::figure

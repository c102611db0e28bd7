// The bodies themselves: fields, mesh edges, outlines.
#include <vtkActor.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "figure/canvas/axes.hpp"
#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

constexpr double feature_angle = 30;  // degrees between facets that make an edge
constexpr Colour outline_colour{40, 40, 40}, undeformed_colour{130, 130, 130};
constexpr std::array<Colour, 5> plain_colours{{{214, 222, 232}, {233, 224, 208}, {216, 230, 218}, {230, 218, 230}, {226, 226, 226}}};

// Nodes in rendered pixels, `lift` pixels nearer to the eye.
std::vector<Vec3> pixels(const Stage& stage, const BodyPicture& body, double factor, double lift) {
  std::vector<Vec3> out(body.points.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) {
    Vec3 p = stage.view.pixel(body.node(i, factor));
    if (stage.plane) p[2] = 0;
    out[i] = stage.rendered(p, lift);
  }
  return out;
}

void add_surface(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, const BodyPicture& body, Colour plain) {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  if (!body.values.empty() && stage.scale.shown) {
    vtkNew<vtkFloatArray> values;
    for (const double value : body.values) values->InsertNextValue(static_cast<float>(value));
    data->GetPointData()->SetScalars(values);
    mapper->SetLookupTable(lookup_table(stage.scale));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  } else {
    mapper->ScalarVisibilityOff();
    actor->GetProperty()->SetColor(plain.r / 255.0, plain.g / 255.0, plain.b / 255.0);
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
    const Vec3 d = plus(at[edges[2 * e]], at[edges[2 * e + 1]], -1);
    sum += std::hypot(d[0], d[1]);
  }
  return count > 0 && sum / static_cast<double>(count) > 0.4 * stage.em * stage.factor;
}

// Thin, where the deformation can be seen.
bool draws_undeformed(const Stage& stage, const BodyPicture& body) { return stage.deformation_shows && !body.displacement.empty(); }

void plane_outlines(Stage& stage, const BodyPicture& body) {
  const std::array<double, 2> dash{0.35 * stage.em, 0.22 * stage.em};
  for (const std::vector<int>& chain : chains(outline_edges(body))) {
    std::vector<Point> now, before;
    for (const int i : chain) now.push_back(stage.at(body, i, stage.picture.deformation)), before.push_back(stage.at(body, i, 0));
    if (draws_undeformed(stage, body)) stage.over.polyline(before, std::max(1.0, stage.em / 18), undeformed_colour, dash);
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
  add_plain(stage, renderer, features->GetOutput(), colour, width);
}

void draw_bodies(Stage& stage, vtkRenderer* renderer) {
  const double f = stage.picture.deformation;
  for (std::size_t k = 0; k < stage.picture.bodies.size(); ++k) {
    const BodyPicture& body = stage.picture.bodies[k];
    const int corners = nodes_per_cell(body.shape, 1);
    const Facets faces = stage.window ? Facets{cells_near(body, f, *stage.window), corners} : stage.plane ? Facets{body.cells, corners} : Facets{body.facets, body.nodes_per_facet};
    const std::vector<Vec3> at = pixels(stage, body, f, 0);
    const vtkSmartPointer<vtkPolyData> surface = poly_data(at, faces);
    add_surface(stage, renderer, surface, body, plain_colours[k % plain_colours.size()]);
    if (stage.picture.edges != MeshEdges::off) {
      const std::vector<int> edges = body.edges.empty() ? unique_edges(faces) : body.edges;
      if (edges_wanted(stage, at, edges)) add_plain(stage, renderer, poly_data(pixels(stage, body, f, 0.5), {edges, 2}), {0, 0, 0}, 0.6, 0.32);
    }
    if (stage.plane) {
      plane_outlines(stage, body);
      continue;
    }
    add_features(stage, renderer, poly_data(pixels(stage, body, f, 2), faces), outline_colour, std::max(1.2, stage.em / 18));
    if (draws_undeformed(stage, body)) add_features(stage, renderer, poly_data(pixels(stage, body, 0, 0.3), faces), undeformed_colour, std::max(0.8, stage.em / 28));
  }
}

void body_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  const double em = stage.em;
  if (stage.deformation_shows)
    out.push_back({"undeformed", [em, plane = stage.plane](Canvas& c, const Box& b) {
                     const std::array<double, 2> dash{0.35 * em, 0.22 * em};
                     c.polyline(b.midline(), std::max(1.0, em / 18), undeformed_colour, plane ? std::span<const double>(dash) : std::span<const double>());
                   }});
  const auto& bodies = stage.picture.bodies;
  const bool displaced = std::any_of(bodies.begin(), bodies.end(), [](const BodyPicture& body) { return !body.displacement.empty(); });
  if (displaced && stage.picture.deformation != 1) out.push_back({"deformation × " + number(stage.picture.deformation), {}});
  else if (stage.deformation_shows) out.push_back({"true scale", {}});
}

}  // namespace

std::vector<int> outline_edges(const BodyPicture& body) {
  return body.facets.empty() ? rim({body.cells, nodes_per_cell(body.shape, 1)}) : body.facets;
}

Layer body_layer() { return {1, draw_bodies, body_legend}; }

}  // namespace dotyk::figure

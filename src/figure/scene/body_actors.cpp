// The bodies themselves: fields, mesh edges, outlines. A cut through them in space: what is beyond it is left out, and the field is seen on it.
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

#include "figure/canvas/axes.hpp"
#include "figure/scene/shapes.hpp"

namespace dotyk::figure {
namespace {

constexpr Colour undeformed_colour{130, 130, 130};

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

std::vector<int> nodes_of(const BodyPicture& body, const std::vector<int>& cells) {
  const std::size_t each = nodes_per_cell(body.shape, 1);
  std::vector<int> out;
  for (const int c : cells) out.insert(out.end(), &body.cells[c * each], &body.cells[c * each] + each);
  return out;
}

std::vector<double> values_of(const BodyPicture& body, const std::vector<int>& cells) {
  std::vector<double> out;
  if (!body.cell_values.empty())
    for (const int c : cells) out.push_back(body.cell_values[c]);
  return out;
}

// Polygons with the field of a body, and the edges of its cells. `on_polygons`: values for each of these; empty: those of the nodes.
void draw_faces(const Stage& stage, vtkRenderer* renderer, const BodyPicture& body, const Facets& faces, const std::vector<double>& on_polygons, Colour plain) {
  const double f = stage.picture.deformation;
  const std::vector<Vec3> at = pixels(stage, body, f, 0);
  const vtkSmartPointer<vtkPolyData> surface = poly_data(at, faces);
  if (!stage.scale.shown || (body.values.empty() && on_polygons.empty())) add_surface(stage, renderer, surface, plain);
  else on_polygons.empty() ? add_coloured(stage, renderer, surface, body.values) : add_coloured(stage, renderer, surface, on_polygons, true);
  if (stage.picture.edges == MeshEdges::off) return;
  const std::vector<int> edges = body.edges.empty() ? unique_edges(faces) : body.edges;
  if (edges_wanted(stage, at, edges)) add_plain(stage, renderer, poly_data(pixels(stage, body, f, 0.5), {edges, 2}), {0, 0, 0}, 0.6, 0.32);
}

void draw_in_plane(Stage& stage, vtkRenderer* renderer, const BodyPicture& body, Colour plain) {
  const int corners = nodes_per_cell(body.shape, 1);
  if (!stage.window) {
    draw_faces(stage, renderer, body, {body.cells, corners}, body.cell_values, plain);
  } else {
    const std::vector<int> near = cells_near(body, stage.picture.deformation, *stage.window);
    draw_faces(stage, renderer, body, {nodes_of(body, near), corners}, values_of(body, near), plain);
  }
  plane_outlines(stage, body);
}

// The surface of a body in space without its inside.
BodyPicture skin_of(const BodyPicture& body) {
  std::vector<int> place(body.points.size() / 3, -1);
  BodyPicture skin;
  const auto take = [&](int i) {
    if (place[i] >= 0) return place[i];
    for (std::size_t c = 0; c < 3; ++c) skin.points.push_back(body.points[3 * i + c]);
    for (std::size_t c = 0; c < 3 && !body.displacement.empty(); ++c) skin.displacement.push_back(body.displacement[3 * i + c]);
    if (!body.values.empty()) skin.values.push_back(body.values[i]);
    return place[i] = static_cast<int>(skin.points.size()) / 3 - 1;
  };
  for (const int i : body.facets) skin.facets.push_back(take(i));
  for (const int i : body.edges) skin.edges.push_back(take(i));
  for (const int cell : body.facet_cells) skin.cell_values.push_back(body.cell_values[cell]);  // of facets now
  return skin;
}

void draw_in_space(Stage& stage, vtkRenderer* renderer, const BodyPicture& body, Colour plain) {
  const BodyPicture skin = skin_of(body);
  const Facets faces{skin.facets, body.nodes_per_facet};
  draw_faces(stage, renderer, skin, faces, skin.cell_values, plain);
  add_features(stage, renderer, poly_data(pixels(stage, skin, stage.picture.deformation, 2), faces), outline_colour, std::max(1.2, stage.em / 18));
  if (draws_undeformed(stage, skin)) add_features(stage, renderer, poly_data(pixels(stage, skin, 0, 0.3), faces), undeformed_colour, std::max(0.8, stage.em / 28));
}

void draw_bodies(Stage& stage, vtkRenderer* renderer) {
  for (std::size_t k = 0; k < stage.picture.bodies.size(); ++k) {
    const BodyPicture& body = stage.picture.bodies[k];
    if (!body.cells.empty() || !body.facets.empty()) stage.plane ? draw_in_plane(stage, renderer, body, plain_colour(k)) : draw_in_space(stage, renderer, body, plain_colour(k));
  }
}

void body_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  const double em = stage.em;
  if (stage.deformation_shows)
    out.push_back({"undeformed", [em, plane = stage.plane](Canvas& c, const Box& b) {
                     const std::array<double, 2> dash{0.35 * em, 0.22 * em};
                     c.polyline(b.midline(), std::max(1.0, em / 18), undeformed_colour, plane ? std::span<const double>(dash) : std::span<const double>());
                   }});
  if (displaced(stage.picture) && stage.names_scale) out.push_back({scale_name(stage.picture), {}});
}

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

bool displaced(const ScenePicture& picture) {
  return std::ranges::any_of(picture.bodies, [](const BodyPicture& body) { return !body.displacement.empty(); });
}

std::string scale_name(const ScenePicture& picture) {
  return picture.deformation == 1 ? "true scale" : (picture.gaps_magnified ? "deformation and gaps × " : "deformation × ") + number(picture.deformation);
}

std::vector<int> outline_edges(const BodyPicture& body) {
  return body.facets.empty() ? rim({body.cells, nodes_per_cell(body.shape, 1)}) : body.facets;
}

Colour plain_colour(std::size_t k) {
  constexpr std::array<Colour, 5> colours{{{214, 222, 232}, {233, 224, 208}, {216, 230, 218}, {230, 218, 230}, {226, 226, 226}}};
  return colours[k % colours.size()];
}

Layer body_layer() { return {1, draw_bodies, body_legend}; }

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

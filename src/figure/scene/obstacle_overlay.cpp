// Rigid obstacles: neutral grey, hatched on the solid side in the plane.
#include <cmath>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "figure/scene/stage.hpp"
#include "figure/canvas/vtk_data.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour body_grey{205, 205, 205}, edge_grey{95, 95, 95}, hatch_grey{140, 140, 140};

void draw_plane(Stage& stage, const RigidPicture& rigid) {
  std::vector<Point> at;
  for (std::size_t i = 0; i < rigid.points.size() / 3; ++i) at.push_back(stage.view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], 0}));
  Canvas& c = stage.under;
  const double width = std::max(1.5, stage.em / 12);
  if (rigid.closed) {
    c.polygon(at, body_grey);
    c.polyline(at, width, edge_grey, {}, true);
    return;
  }
  const Point into = stage.view.direction(rigid.into_solid);
  const double depth = hatch_depth * stage.em, spacing = 0.55 * stage.em;
  // Far ends, as of a plane without end, are cut before they are hatched.
  double walked = 0;
  const double reach = 2.0 * (stage.frame.width() + stage.frame.height());
  const Point centre{(stage.frame.left + stage.frame.right) / 2, (stage.frame.bottom + stage.frame.top) / 2};
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    Point p = at[i], q = at[i + 1];
    double length = std::hypot(q.x - p.x, q.y - p.y);
    if (!(length > 0)) continue;
    const Point along{(q.x - p.x) / length, (q.y - p.y) / length};
    const double nearest = (centre.x - p.x) * along.x + (centre.y - p.y) * along.y;
    const double from = std::max(0.0, nearest - reach), to = std::min(length, nearest + reach);
    if (from >= to) continue;
    q = {p.x + to * along.x, p.y + to * along.y};
    p = {p.x + from * along.x, p.y + from * along.y};
    length = to - from;
    c.convex(std::array<Point, 4>{{p, q, {q.x + depth * into.x, q.y + depth * into.y}, {p.x + depth * into.x, p.y + depth * into.y}}}, {226, 226, 226});
    double s = spacing - std::fmod(walked, spacing);
    for (; s <= length; s += spacing) {
      const Point start{p.x + s * along.x, p.y + s * along.y};
      // Slanted by half a right angle against the direction of the line.
      c.line(start, {start.x + depth * (into.x - 0.7 * along.x), start.y + depth * (into.y - 0.7 * along.y)}, std::max(1.0, stage.em / 24), hatch_grey);
    }
    walked += length;
  }
  c.polyline(at, width, edge_grey);
}

void draw_space(const Stage& stage, const RigidPicture& rigid, vtkRenderer* renderer) {
  std::vector<Vec3> at;
  for (std::size_t i = 0; i < rigid.points.size() / 3; ++i) {
    at.push_back(stage.view.pixel({rigid.points[3 * i], rigid.points[3 * i + 1], rigid.points[3 * i + 2]}));
    for (double& c : at.back()) c *= stage.factor;
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(poly_data(at, rigid.triangles, 3));
  normals->SetFeatureAngle(40);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(0.72, 0.72, 0.72);
  property->SetAmbient(0.4);
  property->SetDiffuse(0.6);
  // Seen through, so that the contact behind remains visible.
  property->SetOpacity(0.28);
  renderer->AddActor(actor);
}

}  // namespace

void draw_obstacles(Stage& stage, vtkRenderer* renderer) {
  if (stage.plane) stage.under.clip(stage.frame);
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    if (stage.plane)
      draw_plane(stage, rigid);
    else
      draw_space(stage, rigid, renderer);
  }
  stage.under.no_clip();
}

}  // namespace dotyk::figure

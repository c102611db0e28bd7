// Rigid obstacles: neutral grey, hatched on the solid side in the plane.
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour hatch_ground{226, 226, 226}, edge_grey{95, 95, 95}, hatch_grey{140, 140, 140};

std::vector<Vec3> corners(const RigidPicture& rigid) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < rigid.points.size(); i += 3) out.push_back({rigid.points[i], rigid.points[i + 1], rigid.points[i + 2]});
  return out;
}

// Unit normals of the line at its points, to its solid side.
std::vector<Point> normals(const std::vector<Point>& line, Point into) {
  std::vector<Point> out(line.size(), Point{0, 0});
  double side = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point d = line[i + 1] - line[i], left{-d.y, d.x};
    side += left.x * into.x + left.y * into.y;
    if (!(length(d) > 0)) continue;
    for (const std::size_t end : {i, i + 1}) out[end] = out[end] + (1 / length(d)) * left;
  }
  for (Point& n : out) n = length(n) > 0 ? ((side < 0 ? -1 : 1) / length(n)) * n : into;
  return out;
}

// On the solid side of p q; far ends, as of a plane without end, are cut before. `normals`: at p and q. `walked`: the
// length of the line up to here, so that strokes go on evenly.
void draw_hatching(Stage& stage, Point p, Point q, std::array<Point, 2> normals, double& walked) {
  const double size = length(q - p), reach = 2.0 * (stage.frame.width() + stage.frame.height());
  if (!(size > 0)) return;
  const Point along{(q.x - p.x) / size, (q.y - p.y) / size}, to_centre = stage.frame.centre() - p;
  const double nearest = to_centre.x * along.x + to_centre.y * along.y;
  const double from = std::max(0.0, nearest - reach), to = std::min(size, nearest + reach);
  if (from >= to) return;
  const double depth = hatch_depth * stage.em, spacing = 0.55 * stage.em;
  const auto into = [&](double s) { return part_way(normals[0], normals[1], s / size); };
  const Point first = p + from * along, last = p + to * along;
  stage.under.convex(std::array{first, last, last + depth * into(to), first + depth * into(from)}, hatch_ground);
  // Slanted by half a right angle against the direction of the line.
  for (double s = spacing - std::fmod(walked, spacing); s <= to - from; s += spacing)
    stage.under.line(first + s * along, first + s * along + depth * (into(from + s) - 0.7 * along), std::max(1.0, stage.em / 24), hatch_grey);
  walked += to - from;
}

void draw_in_plane(Stage& stage, const RigidPicture& rigid) {
  const std::vector<Point> at = obstacle_line(stage.view, rigid), into = normals(at, stage.view.direction(rigid.into_solid));
  double walked = 0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) draw_hatching(stage, at[i], at[i + 1], {into[i], into[i + 1]}, walked);
  stage.under.polyline(at, std::max(1.5, stage.em / 12), edge_grey);
  stage.tell("obstacle", at);
}

void draw_in_space(const Stage& stage, const RigidPicture& rigid, vtkRenderer* renderer) {
  std::vector<Vec3> at;
  for (const Vec3& corner : corners(rigid)) at.push_back(stage.rendered(stage.view.pixel(corner), 0));
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(poly_data(at, {rigid.triangles, 3}));
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

void draw_obstacles(Stage& stage, vtkRenderer* renderer) {
  if (stage.plane) stage.under.clip(stage.frame);
  for (const RigidPicture& rigid : stage.picture.obstacles) stage.plane ? draw_in_plane(stage, rigid) : draw_in_space(stage, rigid, renderer);
  stage.under.no_clip();
}

// The hatching of what of the line is near all that has asked for room before.
void add_hatching(const Stage& stage, Bounds& bounds) {
  if (!stage.plane) return;
  const double depth = hatch_depth * stage.em;
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    const Point d = stage.view.direction(rigid.into_solid);
    const Box near = bounds;
    const std::vector<Point> at = obstacle_line(stage.view, rigid);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      Point p = at[i], q = at[i + 1];
      if (!crop(p, q, near)) continue;
      Bounds piece;
      piece.add(p), piece.add(q);
      if (d.y < -0.3) bounds.add(Point{piece.left, piece.bottom + d.y * depth});
      if (d.y > 0.3) bounds.add(Point{piece.left, piece.top + d.y * depth});
      if (d.x < -0.3) bounds.add(Point{piece.left + d.x * depth, piece.bottom});
      if (d.x > 0.3) bounds.add(Point{piece.right + d.x * depth, piece.bottom});
    }
  }
}

void obstacle_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  const auto& all = stage.picture.obstacles;
  const bool seen = std::any_of(all.begin(), all.end(), [&](const RigidPicture& rigid) {
    const std::vector<Point> at = obstacle_line(stage.view, rigid);
    return !stage.window || std::adjacent_find(at.begin(), at.end(), [&](Point p, Point q) { return stage.shows(p, q); }) != at.end();
  });
  if (!seen) return;
  out.push_back({"rigid obstacle", [em = stage.em, plane = stage.plane](Canvas& c, const Box& b) {
                   if (!plane) return c.box(Box::about(b.centre(), {std::min(1.2 * em, 0.8 * b.width()), 0.7 * em}), hatch_ground);
                   const double foot = b.centre().y - 0.3 * em, depth = 0.6 * em, line = std::max(1.0, em / 24);
                   c.box({b.left, foot, b.right, foot + depth}, hatch_ground);
                   for (double x = b.left + 0.3 * em; x < b.right; x += 0.55 * em)
                     c.line({x, foot}, {std::max(b.left, x - 0.7 * depth), foot + std::min(depth, (x - b.left) / 0.7)}, line, hatch_grey);
                   c.line({b.left, foot}, {b.right, foot}, std::max(1.5, em / 12), edge_grey);
                 }});
}

}  // namespace

std::vector<Point> obstacle_line(const View& view, const RigidPicture& rigid) {
  std::vector<Point> out;
  for (const Vec3& corner : corners(rigid)) out.push_back(view.flat(corner));
  return out;
}

Layer obstacle_layer() { return {0, draw_obstacles, obstacle_legend, add_hatching}; }

}  // namespace dotyk::figure

// A deflected plate in space: statuses along its edges, the gap under those
// that are open, the zone that bears on an obstacle.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <vtkActor.h>
#include <vtkRenderer.h>

#include "figure/plate/plate_lines.hpp"
#include "figure/plate/plate_stage.hpp"
#include "figure/canvas/vtk_data.hpp"

namespace dotyk::figure {

namespace {

constexpr double edge_width = 0.2;  // em
constexpr Colour base_colour{95, 95, 95};

// Lines or quadrilaterals in rendered pixels.
struct Shapes {
  std::vector<Vec3> points;
  std::vector<int> nodes;

  void add(const Stage& stage, const Vec3& p, double lift) {
    Vec3 pixel = stage.view.pixel(p);
    pixel[2] += lift;
    for (double& c : pixel) c *= stage.factor;
    nodes.push_back(static_cast<int>(points.size()));
    points.push_back(pixel);
  }
};

Vec3 raised(const Stage& stage, const EdgePoint& p) { return {p.position[0], p.position[1], stage.picture.deformation * p.deflection}; }

bool lifted(const Stage& stage, const EdgePoint& p) { return std::abs(raised(stage, p)[2]) * stage.view.scale > 1.5; }

bool rests(const EdgeRun& run) { return run.support != PlateSupport::free && run.support != PlateSupport::held; }

// Each half of a piece in the colour of its end.
void add_edges(const Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  std::map<std::array<unsigned char, 3>, Shapes> lines;
  for (const EdgeRun& run : plate.runs) {
    if (run.support == PlateSupport::free) continue;
    for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
      const Vec3 p = raised(stage, run.points[i]), q = raised(stage, run.points[i + 1]), middle = plus(p, plus(q, p, -1), 0.5);
      for (const auto& [end, at] : {std::pair{&run.points[i], p}, std::pair{&run.points[i + 1], q}}) {
        const Colour c = support_colour(run.support, end->status);
        Shapes& shapes = lines[{c.r, c.g, c.b}];
        shapes.add(stage, at, 4), shapes.add(stage, middle, 4);
      }
    }
  }
  for (const auto& [c, shapes] : lines) add_plain(renderer, poly_data(shapes.points, shapes.nodes, 2), {c[0], c[1], c[2]}, edge_width * stage.em * stage.factor);
}

// Between an edge and where it would rest.
void add_gaps(const Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  Shapes curtain, base, ordinates;
  for (const EdgeRun& run : plate.runs) {
    if (!rests(run)) continue;
    std::vector<Point> feet;
    for (const EdgePoint& p : run.points) feet.push_back(stage.view.flat(p.position));
    for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
      const EdgePoint &a = run.points[i], &b = run.points[i + 1];
      if (!lifted(stage, a) && !lifted(stage, b)) continue;
      for (const Vec3& p : {a.position, b.position, raised(stage, b), raised(stage, a)}) curtain.add(stage, p, 1);
      for (const Vec3& p : {a.position, b.position}) base.add(stage, p, 2);
    }
    for (const std::size_t i : stage.spaced(feet, 0.6 * stage.em))
      if (lifted(stage, run.points[i])) ordinates.add(stage, run.points[i].position, 1.5), ordinates.add(stage, raised(stage, run.points[i]), 1.5);
  }
  const double thin = std::max(0.8, stage.em / 28) * stage.factor;
  if (!base.points.empty()) add_plain(renderer, poly_data(base.points, base.nodes, 2), base_colour, 0.12 * stage.em * stage.factor);
  if (!ordinates.points.empty()) add_plain(renderer, poly_data(ordinates.points, ordinates.nodes, 2), status_colour(Status::open), thin);
  if (!curtain.points.empty()) add_plain(renderer, poly_data(curtain.points, curtain.nodes, 4), status_colour(Status::open), 1, 0.3);
}

void add_zone(Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  const PlatePicture& p = plate.picture;
  const std::vector<int> zone = bearing_triangles(p);
  const auto at = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    return Vec3{p.points[2 * k], p.points[2 * k + 1], p.deformation * p.deflection[k]};
  };
  Shapes lines, outline;
  for (const PlateLine& line : hatch(p, zone, 0.7 * stage.em / stage.view.scale))
    for (const Vec3& end : line) lines.add(stage, {end[0], end[1], p.deformation * end[2]}, 2);
  for (const int i : rim(zone, 3)) outline.add(stage, at(i), 3);
  const Colour colour = status_colour(Status::closed);
  if (!lines.points.empty()) add_plain(renderer, poly_data(lines.points, lines.nodes, 2), colour, std::max(1.0, stage.em / 18) * stage.factor);
  if (!outline.points.empty()) add_plain(renderer, poly_data(outline.points, outline.nodes, 2), colour, std::max(1.6, stage.em / 10) * stage.factor);
  std::vector<int> inside = zone;
  std::sort(inside.begin(), inside.end());
  for (const int i : p.bearing)
    if (!std::binary_search(inside.begin(), inside.end(), i)) stage.over.marker(Marker::disc, stage.view.flat(at(i)), 0.45 * stage.em, colour);
}

// A cone below where the plate would rest, and the way the plate has gone from there.
void draw_point_supports(Stage& stage, const Plate& plate) {
  const double em = stage.em;
  for (const PlatePointSupport& s : plate.picture.supports) {
    const Point foot = stage.view.flat({s.x, s.y, 0}), top = stage.view.flat({s.x, s.y, stage.picture.deformation * s.deflection});
    const Colour colour = support_colour(s.support, s.status);
    for (const auto& [grow, paint] : {std::pair{0.1 * em, Colour{255, 255, 255}}, std::pair{0.0, colour}})
      stage.over.convex(std::array<Point, 3>{{{foot.x, foot.y + grow}, {foot.x - 0.45 * em - grow, foot.y - 0.8 * em - 0.7 * grow}, {foot.x + 0.45 * em + grow, foot.y - 0.8 * em - 0.7 * grow}}}, paint);
    if (std::abs(top.y - foot.y) < 2) continue;
    stage.over.line(foot, top, std::max(1.0, em / 16), colour);
    stage.over.marker(Marker::disc, top, 0.4 * em, colour);
  }
}

std::vector<LegendEntry> surface_legend(const Stage& stage, const Plate& plate) {
  std::vector<LegendEntry> out = plate_legend(plate, stage.em, edge_width * stage.em);
  bool gap = false;
  for (const EdgeRun& run : plate.runs)
    for (const EdgePoint& p : run.points) gap = gap || (rests(run) && lifted(stage, p));
  if (gap)
    out.push_back({"deflection of an edge", [em = stage.em](Canvas& c, const Box& b) {
                     const double low = (b.bottom + b.top) / 2 - 0.35 * em;
                     const std::array<Point, 3> corners{{{b.left, low}, {b.right, low}, {b.right, low + 0.75 * em}}};
                     c.convex(corners, status_colour(Status::open), 0.3);
                     c.line({b.left, low}, {b.right, low}, 0.12 * em, base_colour);
                   }});
  return out;
}

}  // namespace

Additions surface_additions(const Plate& plate) {
  Additions out;
  out.legend = [&plate](const Stage& stage) { return surface_legend(stage, plate); };
  out.bounds = [&plate](const Stage& stage, Bounds& bounds) {
    for (const PlatePointSupport& s : plate.picture.supports) {
      const Point foot = stage.view.flat({s.x, s.y, 0});
      bounds.add(Point{foot.x - 0.5 * stage.em, foot.y - 0.9 * stage.em});
    }
  };
  out.above = [&plate](Stage& stage, vtkRenderer* renderer) {
    add_gaps(stage, plate, renderer);
    add_edges(stage, plate, renderer);
    add_zone(stage, plate, renderer);
    draw_point_supports(stage, plate);
  };
  return out;
}

}  // namespace dotyk::figure

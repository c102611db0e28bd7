// A deflected plate in space: statuses along its edges, the gap under those
// that are open, the zone that bears on an obstacle.
#include <map>

#include "figure/plate/plate_stage.hpp"
#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

constexpr double edge_width = 0.2;  // em

Vec3 raised(const Stage& stage, const EdgePoint& p) { return {p.position[0], p.position[1], stage.picture.deformation * p.deflection}; }

bool lifted(const Stage& stage, const EdgePoint& p) { return std::abs(raised(stage, p)[2]) * stage.view.scale > 1.5; }

bool rests(const EdgeRun& run) { return run.support != PlateSupport::free && run.support != PlateSupport::held; }

// Each half of a piece in the colour of its end.
void add_edges(const Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  std::map<std::array<unsigned char, 3>, Shapes> lines;
  for (const EdgeRun& run : plate.runs) {
    if (run.support == PlateSupport::free) continue;
    for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
      const Vec3 p = raised(stage, run.points[i]), q = raised(stage, run.points[i + 1]), middle = part_way(p, q, 0.5);
      for (const auto& [end, at] : {std::pair{&run.points[i], p}, std::pair{&run.points[i + 1], q}}) {
        const Colour c = support_colour(run.support, end->status);
        Shapes& shapes = lines.try_emplace({c.r, c.g, c.b}, stage, 2).first->second;
        shapes.add(at, 4), shapes.add(middle, 4);
      }
    }
  }
  for (const auto& [c, shapes] : lines) shapes.show(renderer, {c[0], c[1], c[2]}, edge_width * stage.em);
}

// Between an edge and where it would rest.
void add_gaps(const Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  Shapes curtain(stage, 4), ordinates(stage, 2);
  for (const EdgeRun& run : plate.runs) {
    if (!rests(run)) continue;
    std::vector<Point> feet;
    for (const EdgePoint& p : run.points) feet.push_back(stage.view.flat(p.position));
    for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
      const EdgePoint &a = run.points[i], &b = run.points[i + 1];
      if (!lifted(stage, a) && !lifted(stage, b)) continue;
      for (const Vec3& p : {a.position, b.position, raised(stage, b), raised(stage, a)}) curtain.add(p, 1);
    }
    for (const std::size_t i : stage.spaced(feet, 0.6 * stage.em))
      if (lifted(stage, run.points[i])) ordinates.add(run.points[i].position, 1.5), ordinates.add(raised(stage, run.points[i]), 1.5);
  }
  ordinates.show(renderer, status_colour(Status::open), std::max(0.8, stage.em / 28));
  curtain.show(renderer, status_colour(Status::open), 1, 0.3);
}

void add_zone(Stage& stage, const Plate& plate, vtkRenderer* renderer) {
  const double factor = plate.picture.deformation;
  Shapes lines(stage, 2), outline(stage, 2), halo(stage, 2);
  for (const auto& line : hatch(plate, 0.7 * stage.em / stage.view.scale))
    for (const Vec3& end : line) lines.add({end[0], end[1], factor * end[2]}, 2);
  for (const PlateLine& line : plate.rim)
    for (const Vec3& end : line) outline.add({end[0], end[1], factor * end[2]}, 3 + 0.3 * stage.em), halo.add({end[0], end[1], factor * end[2]}, 2 + 0.3 * stage.em);
  lines.show(renderer, status_colour(Status::closed), std::max(1.0, stage.em / 18));
  halo.show(renderer, {255, 255, 255}, std::max(3.2, stage.em / 5));
  outline.show(renderer, status_colour(Status::closed), std::max(1.6, stage.em / 10));
  draw_bearing_points(stage, plate, factor, 0.45 * stage.em);
}

// A cone below where the plate would rest, and the way the plate has gone from there.
void draw_point_supports(Stage& stage, const Plate& plate) {
  const double em = stage.em;
  for (const PlatePointSupport& s : plate.picture.supports) {
    const Point foot = stage.view.flat({s.x, s.y, 0}), top = stage.view.flat({s.x, s.y, stage.picture.deformation * s.deflection});
    const Colour colour = support_colour(s.support, s.status);
    draw_apex(stage, foot, {0.45 * em, 0.8 * em}, 0.1 * em, colour);
    if (std::abs(top.y - foot.y) < 2) continue;
    stage.over.line(foot, top, std::max(1.0, em / 16), colour);
    stage.over.marker(Marker::disc, top, 0.4 * em, colour);
  }
}

void surface_legend(const Stage& stage, const Plate& plate, std::vector<LegendEntry>& out) {
  plate_legend(plate, stage.em, edge_width * stage.em, out);
  if (plate.any([&](const EdgeRun& run, const EdgePoint& p) { return rests(run) && lifted(stage, p); }))
    out.push_back({"deflection of an edge", [em = stage.em](Canvas& c, const Box& b) {
                     const double low = b.centre().y - 0.35 * em;
                     c.convex(std::array{Point{b.left, low}, Point{b.right, low}, Point{b.right, low + 0.75 * em}}, status_colour(Status::open), 0.3);
                   }});
}

}  // namespace

std::vector<Layer> surface_layers(const Plate& plate) {
  const auto draw = [&plate](Stage& stage, vtkRenderer* renderer) {
    for (const RigidPicture& block : stage.picture.obstacles) {
      std::vector<Vec3> at;
      for (std::size_t i = 0; i < block.points.size(); i += 3) at.push_back(stage.rendered(stage.view.pixel({block.points[i], block.points[i + 1], block.points[i + 2]}), 0.5));
      add_features(stage, renderer, poly_data(at, {block.triangles, 3}), {120, 120, 120}, std::max(0.8, stage.em / 28));
    }
    add_gaps(stage, plate, renderer);
    add_edges(stage, plate, renderer);
    add_zone(stage, plate, renderer);
    draw_point_supports(stage, plate);
  };
  return {{6, draw, [&plate](const Stage& stage, std::vector<LegendEntry>& out) { surface_legend(stage, plate, out); },
           [&plate](const Stage& stage, Bounds& bounds) {
             for (const PlatePointSupport& s : plate.picture.supports) bounds.add(stage.view.flat({s.x, s.y, 0}) - stage.em * Point{0.5, 0.9});
           }}};
}

}  // namespace dotyk::figure

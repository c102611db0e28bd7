// What the parts of a plate's figure share while it is drawn.
#pragma once

#include <string>
#include <vector>

#include "figure/plate/plate_picture.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

constexpr Colour support_ink{40, 40, 40}, pull_line{0, 105, 78}, pull_fill{196, 230, 216};

struct EdgePoint : EdgeSample {
  Vec3 position = {0, 0, 0};  // z = 0
  Vec3 normal = {0, 0, 0};    // outward
};

// Pieces that follow each other without a corner and rest on the same.
struct EdgeRun {
  PlateSupport support = PlateSupport::free;
  bool clamped = false;
  std::vector<EdgePoint> points;
};

// Pieces meet under a corner where they turn by more than 35 degrees;
// otherwise normals at their joint are the mean of both.
std::vector<EdgeRun> edge_runs(const PlatePicture& plate);

// Outwards at a point of the boundary: the mean of the runs that pass or end
// there; 0 within the plate.
Vec3 outwards_at(const std::vector<EdgeRun>& runs, double x, double y);

// Points on the plate: x, y, and the deflection there.
using PlateLine = std::vector<Vec3>;

struct Plate {
  explicit Plate(const PlatePicture& picture);

  const PlatePicture& picture;
  std::vector<EdgeRun> runs;
  double greatest_reaction = 0, greatest_force = 0;
  bool clamped = false;   // somewhere
  std::vector<PlateLine> zone, rim;  // what bears on the obstacle: polygons; its outline, two points each

  std::vector<int> lone;  // nodes that bear outside of the zone

  // Of some point of some run.
  bool any(const std::function<bool(const EdgeRun&, const EdgePoint&)>& of) const;
  Vec3 node(int i, double factor) const { return {picture.points[2 * i], picture.points[2 * i + 1], factor * picture.deflection[i]}; }
};

// Parallels, `spacing` apart, on the zone that bears on the obstacle.
std::vector<std::array<Vec3, 2>> hatch(const Plate& plate, double spacing);

// In the colour of its status, or of the kind of support where it has none.
Colour support_colour(PlateSupport support, const std::optional<Status>& status);

// Kinds of support that occur, in space statuses too, as lines of `width`
// pixels; point supports; the zone that bears on the obstacle.
void plate_legend(const Plate& plate, double em, double width, std::vector<LegendEntry>& out);

// Nodes that bear alone, in the plane of the plate where the factor is 0.
void draw_bearing_points(Stage& stage, const Plate& plate, double factor, double size);
// A support at a point: a triangle below it, with a rim of white.
void draw_apex(Stage& stage, Point at, Point size, double rim, Colour colour);

// Reactions along the edges, outside of them.
Point strip_foot(const Stage& stage, const Plate& plate, const EdgePoint& p, double ordinate = 0);
Point strip_tip(const Stage& stage, const Plate& plate, const EdgePoint& p);
void draw_strips(Stage& stage, const Plate& plate);
// "3.2 kN", in the colour of what pushes or pulls.
Label reaction_label(const Stage& stage, double value, const std::string& unit);
// The greatest reaction of each edge, beyond the strip, and those that differ from one that is told by less than a hundredth not again.
std::vector<Label> strip_labels(const Stage& stage, const Plate& plate);

std::vector<Layer> plan_layers(const Plate& plate);
std::vector<Layer> surface_layers(const Plate& plate);

}  // namespace dotyk::figure

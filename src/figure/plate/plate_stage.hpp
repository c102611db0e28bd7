// What the parts of a plate's figure share while it is drawn.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "figure/plate/plate_edges.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

constexpr Colour support_ink{40, 40, 40}, elastic_colour{120, 85, 55}, pull_line{0, 105, 78}, push_fill{205, 214, 235}, pull_fill{196, 230, 216};

struct Plate {
  explicit Plate(const PlatePicture& picture);

  const PlatePicture& picture;
  std::vector<EdgeRun> runs;
  double greatest_reaction = 0, greatest_force = 0;

  bool any(bool (*of)(const EdgeRun&)) const;
};

// In the colour of its status, or of the kind of support where it has none.
Colour support_colour(PlateSupport support, const std::optional<Status>& status);

// Kinds of support that occur, in space statuses too, as lines of `width`
// pixels; point supports; the zone that bears on the obstacle.
std::vector<LegendEntry> plate_legend(const Plate& plate, double em, double width);

// Reactions along the edges, outside of them.
Point strip_foot(const Stage& stage, const Plate& plate, const EdgePoint& p);
Point strip_tip(const Stage& stage, const Plate& plate, const EdgePoint& p);
void draw_strips(Stage& stage, const Plate& plate);

// A text clear of what it explains.
struct PlateLabel {
  std::string text;
  Box box;
  Colour colour;
  bool ground = false;  // on a pale ground of its own
};
// The greatest reaction of each edge, beyond the strip.
std::vector<PlateLabel> strip_labels(const Stage& stage, const Plate& plate);
void draw_label(Stage& stage, const PlateLabel& label);

Additions plan_additions(const Plate& plate);
Additions surface_additions(const Plate& plate);

}  // namespace dotyk::figure

// Reactions per length along the edges of a plate seen from above, as areas
// that stand outside the edge.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/plate/plate_stage.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

namespace {

// The strip leaves room for the line of the edge, and for hatching where it is clamped.
double foot(const Stage& stage, const Plate& plate) {
  return (plate.clamped ? 0.75 : 0.34) * stage.em;
}

Point outside(const Stage& stage, const EdgePoint& p, double by) {
  return stage.view.flat(p.position) + by * stage.view.direction(p.normal);
}

// Where the reaction between two points changes its sign.
EdgePoint root(const EdgePoint& a, const EdgePoint& b) {
  const double t = a.reaction / (a.reaction - b.reaction);
  EdgePoint out = a;
  out.position = plus(a.position, plus(b.position, a.position, -1), t);
  out.normal = unit(plus(a.normal, plus(b.normal, a.normal, -1), t));
  out.reaction = 0;
  return out;
}

// With a point of its own at each change of sign.
std::vector<EdgePoint> split(const std::vector<EdgePoint>& points) {
  std::vector<EdgePoint> out;
  for (const EdgePoint& p : points) {
    if (!out.empty() && out.back().reaction * p.reaction < 0) out.push_back(root(out.back(), p));
    out.push_back(p);
  }
  return out;
}

bool carries(const Plate& plate, const EdgeRun& run) {
  return std::any_of(run.points.begin(), run.points.end(), [&](const EdgePoint& p) { return std::abs(p.reaction) > 1e-6 * plate.greatest_reaction; });
}

// Lower than pressures of a scene: strips stand on all sides.
double ordinate(const Stage& stage, const Plate& plate, double reaction) {
  return plate.greatest_reaction > 0 ? 0.6 * stage.strip_height() * std::abs(reaction) / plate.greatest_reaction : 0;
}

}  // namespace

Point strip_foot(const Stage& stage, const Plate& plate, const EdgePoint& p) { return outside(stage, p, foot(stage, plate)); }

Point strip_tip(const Stage& stage, const Plate& plate, const EdgePoint& p) {
  return outside(stage, p, foot(stage, plate) + ordinate(stage, plate, p.reaction));
}

void draw_strips(Stage& stage, const Plate& plate) {
  const double width = std::max(1.2, stage.em / 14);
  for (const EdgeRun& run : plate.runs) {
    if (!carries(plate, run)) continue;
    const std::vector<EdgePoint> points = split(run.points);
    std::vector<Point> feet, tips;
    for (const EdgePoint& p : points) feet.push_back(strip_foot(stage, plate, p)), tips.push_back(strip_tip(stage, plate, p));
    const auto pulls = [&](std::size_t i) { return points[i].reaction + points[i + 1].reaction < 0; };
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      stage.over.convex(std::array{feet[i], feet[i + 1], tips[i + 1], tips[i]}, pulls(i) ? pull_fill : pressure_fill, 0.85);
    for (const std::size_t i : stage.spaced(feet, 0.55 * stage.em))
      stage.over.line(feet[i], tips[i], std::max(0.8, stage.em / 30), points[i].reaction < 0 ? pull_line : pressure_line, 0.6);
    stage.over.polyline(feet, std::max(0.8, stage.em / 30), {130, 130, 130});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (points[i].reaction == 0 && points[i + 1].reaction == 0) continue;
      const Colour colour = pulls(i) ? pull_line : pressure_line;
      stage.over.line(tips[i], tips[i + 1], width, colour);
      for (const std::size_t k : {i, i + 1}) stage.over.disc(tips[k], width / 2, colour);
    }
    if (length(feet.front() - feet.back()) < 0.5) continue;  // it goes all around
    for (const std::size_t i : {std::size_t{0}, points.size() - 1}) stage.over.line(feet[i], tips[i], width, points[i].reaction < 0 ? pull_line : pressure_line);
  }
}

namespace {

Label label_at(const Stage& stage, const Plate& plate, const EdgePoint& p) {
  Label label = reaction_label(stage, p.reaction, plate.picture.reaction_unit);
  const Point tip = strip_tip(stage, plate, p), n = stage.view.direction(p.normal), size = text_extent(label.text, label.size);
  const auto beyond = [](double c) { return std::clamp(1.5 * c, -1.0, 1.0); };  // on a slant by a corner of the box
  label.box = Box::about({tip.x + beyond(n.x) * size.x / 2 + 0.35 * stage.em * n.x, tip.y + beyond(n.y) * size.y / 2 + 0.3 * stage.em * n.y}, size);
  return label;
}

// Of equal peaks that in the middle; nothing where the run carries next to nothing.
void add_peak(std::vector<Label>& out, const Stage& stage, const Plate& plate, const EdgeRun& run, double sign) {
  double peak = 0;
  for (const EdgePoint& p : run.points)
    if (!p.extrapolated) peak = std::max(peak, sign * p.reaction);
  if (!(peak > 0.04 * plate.greatest_reaction)) return;
  std::vector<const EdgePoint*> peaks;
  for (const EdgePoint& p : run.points)
    if (!p.extrapolated && sign * p.reaction >= 0.9999 * peak) peaks.push_back(&p);
  out.push_back(label_at(stage, plate, *peaks[peaks.size() / 2]));
}

}  // namespace

Label reaction_label(const Stage& stage, double value, const std::string& unit) {
  return {number(value) + (unit.empty() ? "" : " " + unit), 0.85 * stage.em, {}, value < 0 ? pull_line : pressure_line};
}

std::vector<Label> strip_labels(const Stage& stage, const Plate& plate) {
  std::vector<Label> out;
  if (!(plate.greatest_reaction > 0)) return out;
  for (const EdgeRun& run : plate.runs)
    for (const double sign : {1.0, -1.0}) add_peak(out, stage, plate, run, sign);
  return out;
}

}  // namespace dotyk::figure

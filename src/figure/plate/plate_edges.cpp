// The boundary of a plate: its runs, and the reactions per length along them, seen from above, as areas that stand outside the edge.
#include <functional>

#include "figure/canvas/axes.hpp"
#include "figure/plate/plate_stage.hpp"

namespace dotyk::figure {

namespace {

const double straight = std::cos(35 * std::acos(-1.0) / 180);

double extent(const PlateEdge& e) { return std::hypot(e.to[0] - e.from[0], e.to[1] - e.from[1]); }

Vec3 normal(const PlateEdge& e) { return unit({e.to[1] - e.from[1], e.from[0] - e.to[0], 0}); }

bool joined(const PlateEdge& a, const PlateEdge& b) {
  return std::hypot(a.to[0] - b.from[0], a.to[1] - b.from[1]) <= 1e-6 * std::min(extent(a), extent(b));
}

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

// Of each piece the one that follows it, mostly the next.
std::vector<std::size_t> followers(const std::vector<PlateEdge>& all) {
  std::vector<std::size_t> out(all.size(), nowhere);
  std::size_t first = 0;  // of the present loop
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i + 1 < all.size() && joined(all[i], all[i + 1])) {
      out[i] = i + 1;
      continue;
    }
    if (joined(all[i], all[first])) out[i] = first;
    first = i + 1;
  }
  return out;
}

bool smooth(const PlateEdge& a, const PlateEdge& b) { return dot(normal(a), normal(b)) > straight; }

void append(EdgeRun& run, const PlateEdge& edge, const Vec3& at_start, const Vec3& at_end) {
  const Vec3 n = normal(edge);
  for (const EdgeSample& s : edge.samples) {
    EdgePoint& p = run.points.emplace_back(EdgePoint{s});
    for (std::size_t c = 0; c < 2; ++c) p.position[c] = edge.from[c] + s.share * (edge.to[c] - edge.from[c]);
    // From the mean at one end to that at the other.
    p.normal = unit(plus(plus(n, plus(at_start, n, -1), std::max(0.0, 1 - 2 * s.share)), plus(at_end, n, -1), std::max(0.0, 2 * s.share - 1)));
  }
}

// Where the reaction between two points changes its sign.
EdgePoint root(const EdgePoint& a, const EdgePoint& b) {
  const double t = a.reaction / (a.reaction - b.reaction);
  EdgePoint out = a;
  out.position = part_way(a.position, b.position, t);
  out.normal = unit(part_way(a.normal, b.normal, t));
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

Label label_at(const Stage& stage, const Plate& plate, const EdgePoint& p) {
  Label label = reaction_label(stage, p.reaction, plate.picture.reaction_unit);
  const Point tip = strip_tip(stage, plate, p), n = stage.view.direction(p.normal), size = text_extent(label.text, label.size);
  const auto beyond = [](double c) { return std::clamp(1.5 * c, -1.0, 1.0); };  // on a slant by a corner of the box
  label.box = Box::about({tip.x + beyond(n.x) * size.x / 2 + 0.35 * stage.em * n.x, tip.y + beyond(n.y) * size.y / 2 + 0.3 * stage.em * n.y}, size);
  return label;
}

// Of equal peaks that in the middle; nothing where the run carries next to nothing.
const EdgePoint* peak_of(const Plate& plate, const EdgeRun& run, double sign) {
  double peak = 0;
  for (const EdgePoint& p : run.points)
    if (!p.extrapolated) peak = std::max(peak, sign * p.reaction);
  if (!(peak > 0.04 * plate.greatest_reaction)) return nullptr;
  std::vector<const EdgePoint*> peaks;
  for (const EdgePoint& p : run.points)
    if (!p.extrapolated && sign * p.reaction >= 0.9999 * peak) peaks.push_back(&p);
  return peaks[peaks.size() / 2];
}

}  // namespace

std::vector<EdgeRun> edge_runs(const PlatePicture& plate) {
  const std::vector<PlateEdge>& all = plate.boundary;
  const std::vector<std::size_t> next = followers(all);
  std::vector<std::size_t> last(all.size(), nowhere);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (next[i] != nowhere) last[next[i]] = i;
  const auto mean = [&](std::size_t i, std::size_t j) {
    return j != nowhere && smooth(all[i], all[j]) ? unit(plus(normal(all[i]), normal(all[j]))) : normal(all[i]);
  };
  std::vector<EdgeRun> runs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool goes_on = i > 0 && next[i - 1] == i && smooth(all[i - 1], all[i]) && all[i - 1].support == all[i].support && all[i - 1].clamped == all[i].clamped;
    if (!goes_on) runs.push_back({all[i].support, all[i].clamped, {}});
    append(runs.back(), all[i], mean(i, last[i]), mean(i, next[i]));
  }
  return runs;
}

Vec3 outwards_at(const std::vector<EdgeRun>& runs, double x, double y) {
  Vec3 sum{0, 0, 0};
  double size = 0;
  for (const EdgeRun& run : runs)
    for (const EdgePoint& p : run.points) size = std::max({size, std::abs(p.position[0] - x), std::abs(p.position[1] - y)});
  for (const EdgeRun& run : runs)
    for (const EdgePoint& p : run.points)
      if (std::hypot(p.position[0] - x, p.position[1] - y) <= 1e-6 * size) sum = plus(sum, p.normal);
  return unit(sum);
}

// The strip leaves room for the line of the edge, and for hatching where it is clamped.
Point strip_foot(const Stage& stage, const Plate& plate, const EdgePoint& p, double ordinate) {
  const double foot = (plate.clamped ? 0.65 : 0.34) * stage.em;
  return stage.view.flat(p.position) + (foot + ordinate) * stage.view.direction(p.normal);
}

Point strip_tip(const Stage& stage, const Plate& plate, const EdgePoint& p) {
  // Lower than pressures of a scene: strips stand on all sides.
  const double ordinate = 1.3 * stage.em * std::abs(p.reaction) / plate.greatest_reaction;
  return strip_foot(stage, plate, p, plate.greatest_reaction > 0 ? ordinate : 0);
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
      stage.over.line(feet[i], tips[i], std::max(0.8, stage.em / 30), points[i].reaction < 0 ? pull_line : pressure_line, 0.6),
          stage.tell(points[i].reaction < 0 ? "pulling" : "pushing", Segment{feet[i], tips[i]});
    stage.over.polyline(feet, std::max(0.8, stage.em / 30), {130, 130, 130});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (points[i].reaction == 0 && points[i + 1].reaction == 0) continue;
      const Colour colour = pulls(i) ? pull_line : pressure_line;
      stage.over.line(tips[i], tips[i + 1], width, colour);
      for (const std::size_t k : {i, i + 1}) stage.over.disc(tips[k], width / 2, colour);
      if (pulls(i)) stage.over.line(part_way(feet[i], tips[i], 0.5), part_way(feet[i + 1], tips[i + 1], 0.5), width, colour);  // told apart in grey too
    }
    if (length(feet.front() - feet.back()) < 0.5) continue;  // it goes all around
    for (const std::size_t i : {std::size_t{0}, points.size() - 1}) stage.over.line(feet[i], tips[i], width, points[i].reaction < 0 ? pull_line : pressure_line);
  }
}

Label reaction_label(const Stage& stage, double value, const std::string& unit) {
  return {number(value) + (unit.empty() ? "" : " " + unit), 0.85 * stage.em, {}, value < 0 ? pull_line : pressure_line};
}

std::vector<Label> strip_labels(const Stage& stage, const Plate& plate) {
  std::vector<const EdgePoint*> peaks;
  for (const EdgeRun& run : plate.runs)
    for (const double sign : {1.0, -1.0})
      if (const EdgePoint* peak = plate.greatest_reaction > 0 ? peak_of(plate, run, sign) : nullptr) peaks.push_back(peak);
  std::vector<Label> out;
  const auto size = [](const EdgePoint* p) { return std::abs(p->reaction); };
  while (!peaks.empty()) {  // of equal peaks the first one is told
    const double greatest = size(std::ranges::max(peaks, {}, size));
    const EdgePoint& told = **std::ranges::find_if(peaks, [&](const EdgePoint* p) { return size(p) >= 0.9999 * greatest; });
    out.push_back(label_at(stage, plate, told));
    std::erase_if(peaks, [&](const EdgePoint* p) { return std::abs(p->reaction - told.reaction) < 0.01 * size(&told); });
  }
  return out;
}

}  // namespace dotyk::figure

// A plate from above: contour lines, what bears, supports, reactions.
#include "figure/canvas/axes.hpp"
#include "figure/plate/plate_stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double support_width = 0.2;  // of lines, em

std::vector<Point> flat(const Stage& stage, const PlateLine& line) {
  std::vector<Point> out;
  for (const Vec3& p : line) out.push_back(stage.view.flat({p[0], p[1], 0}));
  return out;
}

// Clear of edges, forces, supports and the zone that bears.
bool is_free(const Stage& stage, const Plate& plate, const Box& box) {
  for (const EdgeRun& run : plate.runs)
    for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
      Point p = stage.view.flat(run.points[i].position), q = stage.view.flat(run.points[i + 1].position);
      if (crop(p, q, box)) return false;
    }
  for (const PlateLine& line : plate.rim)
    if (std::vector<Point> ends = flat(stage, line); crop(ends[0], ends[1], box)) return false;
  const auto on = [&](double x, double y) { return box.holds(stage.view.flat({x, y, 0}), stage.em); };
  return std::ranges::none_of(plate.picture.forces, [&](const PlateForce& f) { return on(f.x, f.y); }) &&
         std::ranges::none_of(plate.picture.supports, [&](const PlatePointSupport& s) { return on(s.x, s.y); });
}

void draw_bearing(Stage& stage, const Plate& plate) {
  const Colour colour = status_colour(Status::closed);
  for (const auto& [p, q] : hatch(plate, 0.45 * stage.em / stage.view.scale))
    stage.over.line(stage.view.flat(p), stage.view.flat(q), std::max(1.0, stage.em / 18), colour);
  for (const auto& [width, ink] : {std::pair{stage.em / 5, Colour{255, 255, 255}}, std::pair{stage.em / 10, colour}})
    for (const PlateLine& line : plate.rim) {
      const std::vector<Point> ends = flat(stage, line);
      stage.over.line(ends[0], ends[1], std::max(1.6, width), ink);
      for (const Point& end : ends) stage.over.disc(end, std::max(1.6, width) / 2, ink);
    }
  draw_bearing_points(stage, plate, 0, 0.5 * stage.em);
}

// Hatching outside an edge that cannot rotate, as of a wall.
void draw_clamp(Stage& stage, const EdgeRun& run) {
  const double em = stage.em, depth = 0.45 * em, step = 0.4 * em;
  double rest = 0;
  for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
    const Point p = stage.view.flat(run.points[i].position), q = stage.view.flat(run.points[i + 1].position), n = stage.view.direction(run.points[i].normal);
    const double size = length(q - p);
    for (double s = rest; s <= size; s += step, rest = s) {
      const Point d{(q.x - p.x) / size, (q.y - p.y) / size}, a = p + s * d;
      stage.over.line(a, a + depth * (n - 0.7 * d), std::max(1.0, em / 20), support_ink);
    }
    rest -= size;
  }
}

// Supports without a status; those with one have been drawn with it.
void draw_edge(Stage& stage, const EdgeRun& run) {
  if (run.clamped) draw_clamp(stage, run);
  if (run.support == PlateSupport::free) return;
  for (std::size_t i = 0; i + 1 < run.points.size(); ++i) {
    if (run.points[i].status || run.points[i + 1].status) continue;
    stage.over.line(stage.view.flat(run.points[i].position), stage.view.flat(run.points[i + 1].position), support_width * stage.em, support_colour(run.support, std::nullopt));
  }
}

double dot_size(const Stage& stage, const Plate& plate, const PlateForce& f) {
  return stage.em * (0.35 + 0.35 * std::sqrt(std::abs(f.force) / plate.greatest_force));
}

bool carries(const Plate& plate, const PlateForce& f) { return std::abs(f.force) > 1e-6 * plate.greatest_force; }

// Beyond a corner; elsewhere within the plate, clear of strips.
Label force_label(const Stage& stage, const Plate& plate, const PlateForce& f) {
  Label label = reaction_label(stage, f.force, plate.picture.force_unit);
  const Point at = stage.view.flat({f.x, f.y, 0}), extent = text_extent(label.text, label.size);
  Point n = stage.view.direction(outwards_at(plate.runs, f.x, f.y));
  const bool corner = std::abs(n.x) > 0.3 && std::abs(n.y) > 0.3;
  if (!corner) n = n.x == 0 && n.y == 0 ? Point{0.7, 0.7} : Point{-n.x, -n.y};
  label.ground = corner ? 0 : 0.15 * stage.em;
  const double off = dot_size(stage, plate, f) / 2 + (corner ? 0.15 : 0.3) * stage.em;
  const auto side = [](double c) { return std::abs(c) > 0.3 ? (c > 0 ? 1.0 : -1.0) : 0.0; };
  label.box = Box::about({at.x + side(n.x) * (extent.x / 2 + off), at.y + side(n.y) * (extent.y / 2 + off)}, extent);
  return label;
}

// Of forces that differ by less than 5 % only the first has a label; the sizes of dots tell the others.
std::vector<Label> labels(const Stage& stage, const Plate& plate) {
  std::vector<Label> out;
  std::vector<double> told;
  for (const PlateForce& f : plate.picture.forces) {
    const bool again = std::ranges::any_of(told, [&](double value) { return std::abs(f.force - value) < 0.05 * std::abs(value); });
    if (!carries(plate, f) || again) continue;
    told.push_back(f.force);
    out.push_back(force_label(stage, plate, f));
  }
  for (Label& label : strip_labels(stage, plate)) out.push_back(std::move(label));
  return out;
}

void draw_above(Stage& stage, const Plate& plate) {
  for (const EdgeRun& run : plate.runs) draw_edge(stage, run);
  draw_strips(stage, plate);
  const auto told = [&](const char* what, const auto& thing) {
    const std::array at{stage.view.flat({thing.x, thing.y, 0})};
    return stage.tell(what, at), at[0];
  };
  for (const PlatePointSupport& s : plate.picture.supports)  // the apex at the point, as on drawings
    draw_apex(stage, told("point support", s), {0.5 * stage.em, 0.85 * stage.em}, 0.12 * stage.em, support_colour(s.support, s.status));
  for (const PlateForce& f : plate.picture.forces)
    if (const bool pulls = f.force < 0; carries(plate, f)) stage.over.marker(Marker::disc, told(pulls ? "pulling" : "pushing", f), dot_size(stage, plate, f), pulls ? pull_line : pressure_line);
  draw_labels(stage.over, labels(stage, plate));
}

void plan_bounds(const Stage& stage, const Plate& plate, Bounds& bounds) {
  for (const EdgeRun& run : plate.runs)
    for (const EdgePoint& p : run.points) {
      if (plate.greatest_reaction > 0) bounds.add(strip_tip(stage, plate, p));
      if (plate.clamped) bounds.add(strip_foot(stage, plate, p));
    }
  for (const PlatePointSupport& s : plate.picture.supports) {
    const Point at = stage.view.flat({s.x, s.y, 0});
    bounds.add(Box{at.x - 0.6 * stage.em, at.y - stage.em, at.x + 0.6 * stage.em, at.y});
  }
  for (const Label& label : labels(stage, plate)) bounds.add(label.box);
}

// Per length and at points, as far as they occur.
LegendEntry reaction_entry(double em, double sign, bool strip, bool force) {
  return {sign > 0 ? "reaction, pushing up" : "reaction, pulling down", [em, sign, strip, force](Canvas& c, const Box& b) {
            const double middle = b.centre().y, top = middle + 0.36 * em;
            const Colour colour = sign > 0 ? pressure_line : pull_line;
            if (strip) {
              c.box({b.left, middle - 0.36 * em, b.right, top}, sign > 0 ? pressure_fill : pull_fill);
              for (const double y : {top, sign > 0 ? top : middle}) c.line({b.left, y}, {b.right, y}, std::max(1.2, em / 14), colour);
            }
            if (force) c.marker(Marker::disc, {b.centre().x, middle - (strip ? 0.05 * em : 0)}, 0.5 * em, colour);
          }};
}

void plan_legend(const Stage& stage, const Plate& plate, std::vector<LegendEntry>& out) {
  const double em = stage.em;
  plate_legend(plate, em, support_width * em, out);
  if (plate.clamped)
    out.push_back({"cannot rotate", [em](Canvas& c, const Box& b) {
                     const double low = b.centre().y - 0.2 * em;
                     c.line({b.left, low}, {b.right, low}, std::max(1.2, em / 18), support_ink);
                     for (double x = b.left; x < b.right; x += 0.4 * em) c.line({x, low}, {x + 0.3 * em, low + 0.45 * em}, std::max(1.0, em / 20), support_ink);
                   }});
  for (const double sign : {1.0, -1.0}) {
    const auto& forces = plate.picture.forces;
    const bool strip = plate.any([&](const EdgeRun&, const EdgePoint& p) { return sign * p.reaction > 1e-6 * plate.greatest_reaction; });
    const bool force = std::any_of(forces.begin(), forces.end(), [&](const PlateForce& f) { return sign * f.force > 1e-6 * plate.greatest_force; });
    if (strip || force) out.push_back(reaction_entry(em, sign, strip, force));
  }
}

}  // namespace

std::vector<Layer> plan_layers(const Plate& plate) {
  const auto below = [&plate](Stage& stage, vtkRenderer*) { draw_isolines(stage, [&](const Box& box) { return is_free(stage, plate, box); }), draw_bearing(stage, plate); };
  return {{2, below},
          {6, [&plate](Stage& stage, vtkRenderer*) { draw_above(stage, plate); },
           [&plate](const Stage& stage, std::vector<LegendEntry>& out) { plan_legend(stage, plate, out); },
           [&plate](const Stage& stage, Bounds& bounds) { plan_bounds(stage, plate, bounds); }}};
}

}  // namespace dotyk::figure

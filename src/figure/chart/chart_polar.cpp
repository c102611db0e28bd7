#include "figure/chart/chart.hpp"

#include <numbers>

namespace dotyk::figure {

namespace {

constexpr int ray_every = 30;     // degrees between rays
constexpr double angle_gap = 0.3;   // em from the circle to the names of angles

Point direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

std::vector<Point> circle(const Axes& axes, double radius) {
  std::vector<Point> out;
  for (int degrees = 0; degrees < 360; degrees += 2) out.push_back(*axes.pole + radius * direction(degrees));
  return out;
}

std::string name_of(int degrees) { return std::to_string(degrees) + "°"; }

// As near to the circle from outside as the gap allows.
Box angle_box(const Axes& axes, int degrees) {
  const Point size = text_extent(name_of(degrees), axes.em);
  const double away = axes.y.to + angle_gap * axes.em;
  for (double r = away;; ++r) {
    const Box box = Box::about(*axes.pole + r * direction(degrees), size);
    const Point nearest{std::clamp(axes.pole->x, box.left, box.right), std::clamp(axes.pole->y, box.bottom, box.top)};
    if (length(nearest - *axes.pole) >= away) return box;
  }
}

std::vector<Box> radius_boxes(const Axes& axes, double degrees) {
  std::vector<Box> out;
  for (const Tick& t : axes.y_ticks.ticks) {
    const Point size = text_extent(t.label, small_text * axes.em);
    if (!t.label.empty()) out.push_back(Box::about(*axes.pole + axes.y.pixel(t.value) * direction(degrees), size));
  }
  return out;
}

// Degrees between names of angles: where the circle is too small for all, those of the axes.
int names_every(const Axes& axes) {
  constexpr int kBelow = 270, kAxes = 90;
  return angle_box(axes, kBelow).grown(0.3 * axes.em).overlaps(angle_box(axes, kBelow + ray_every)) ? kAxes : ray_every;
}

// Between two rays, such that labels meet least.
double freest_ray(const Axes& axes, const Occupied& occupied) {
  double best = 0, least = INFINITY;
  for (int degrees = ray_every / 2; degrees < 360; degrees += ray_every) {
    double met = 0;
    for (const Box& box : radius_boxes(axes, degrees)) met += std::max(0.0, axes.em - occupied.distance(box)) + (occupied.meets(box) ? axes.em : 0);
    if (met < least) least = met, best = degrees;
  }
  return best;
}

}  // namespace

Point polar_rim(double em) { return {angle_gap * em + text_extent(name_of(180), em).x, (angle_gap + 1) * em}; }

void place_polar(Axes& axes) {
  const Point beside = polar_rim(axes.em);
  axes.pole = axes.room.centre();
  axes.y.from = 0, axes.y.to = std::max(1.0, std::min(axes.room.width() / 2 - beside.x, axes.room.height() / 2 - beside.y));
  for (int n = std::clamp(static_cast<int>(axes.y.to / (1.8 * axes.em)), 2, 5); n <= 5; ++n) {
    axes.y_ticks = linear_ticks(axes.y.low, axes.y.high, n);
    std::erase_if(axes.y_ticks.ticks, [&](const Tick& t) { return t.value <= 0 || t.label.empty(); });
    if (axes.y_ticks.ticks.size() > 1) break;
  }
  axes.x_ticks = {};
}

void occupy_polar(const Axes& axes, Occupied& occupied) {
  occupied.add(circle(axes, axes.y.to), axes.room);
  for (int degrees = 0; degrees < 360; degrees += names_every(axes)) occupied.add(angle_box(axes, degrees));
}

void draw_polar_grid(Canvas& canvas, const Axes& axes) {
  canvas.polyline(circle(axes, axes.y.to), std::max(1.2, axes.em / 18), axes_ink, {}, true);
  const double width = std::max(1.0, axes.em / 24);
  for (const double r : axes.y_ticks.labelled()) canvas.polyline(circle(axes, axes.y.pixel(r)), width, axes_grid, {}, true);
  for (int degrees = 0; degrees < 360; degrees += ray_every) canvas.line(*axes.pole, *axes.pole + axes.y.to * direction(degrees), width, axes_grid);
}

void draw_polar_labels(Canvas& canvas, const Axes& axes, const Occupied& occupied) {
  for (int degrees = 0; degrees < 360; degrees += names_every(axes))
    canvas.text(angle_box(axes, degrees).centre(), name_of(degrees), {.size = axes.em, .across = Align::middle, .up = Align::middle});
  const std::vector<Box> boxes = radius_boxes(axes, freest_ray(axes, occupied));
  for (std::size_t k = 0; k < boxes.size(); ++k)
    canvas.text(boxes[k].centre(), axes.y_ticks.ticks[k].label, {.size = small_text * axes.em, .across = Align::middle, .up = Align::middle, .halo = true});
}

}  // namespace dotyk::figure

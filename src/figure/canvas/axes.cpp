#include "figure/canvas/axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dotyk::figure {

bool Axis::shows(double value) const { return std::isfinite(value) && (!log || value > 0); }

namespace {

Wide place(const Axis& axis, double value) { return axis.log ? Wide{std::log10(value)} : Wide{value}; }

Wide per_unit(const Axis& axis) { return (axis.to - axis.from) / (place(axis, axis.high) - place(axis, axis.low)); }

}  // namespace

double Axis::pixel(double value) const {
  const Wide a = place(*this, low), b = place(*this, high);
  const Wide at = from + (to - from) * ((place(*this, value) - a) / (b - a));
  return static_cast<double>(std::clamp<Wide>(at, -most_pixels, most_pixels));
}

double Axis::pixels_per_unit() const { return static_cast<double>(std::min<Wide>(per_unit(*this), most_pixels)); }

double steepness(const Axis& x, const Axis& y, double slope) {
  return static_cast<double>(std::clamp<Wide>(slope * per_unit(y) / per_unit(x), -most_pixels, most_pixels));
}

namespace {
double hair(double em) { return std::max(1.0, em / 24); }
}  // namespace

void draw_grid(Canvas& canvas, const Axes& a) {
  canvas.box(a.room, {255, 255, 255});
  for (const Tick& t : a.x_ticks.ticks)
    if (const double x = a.x.pixel(t.value); !t.label.empty()) canvas.line({x, a.room.bottom}, {x, a.room.top}, hair(a.em), axes_grid);
  for (const Tick& t : a.y_ticks.ticks)
    if (const double y = a.y.pixel(t.value); !t.label.empty()) canvas.line({a.room.left, y}, {a.room.right, y}, hair(a.em), axes_grid);
}

void draw_ticks(Canvas& canvas, const Axes& a, bool x_labels) {
  const double tick = 0.32 * a.em;
  for (const bool vertical : {false, true}) {
    double busy_until = -1e9;
    for (const Tick& t : (vertical ? a.y_ticks : a.x_ticks).ticks) {
      const double p = (vertical ? a.y : a.x).pixel(t.value), inwards = t.label.empty() ? 0.55 * tick : tick;
      const Point foot = vertical ? Point{a.room.left, p} : Point{p, a.room.bottom};
      canvas.line(foot, foot + inwards * (vertical ? Point{1, 0} : Point{0, 1}), 1.3 * hair(a.em), axes_ink);
      if (t.label.empty() || (!vertical && !x_labels)) continue;
      const double half = (vertical ? 0.9 * a.em : text_extent(t.label, a.em).x + 0.5 * a.em) / 2;
      if (p - half < busy_until) continue;
      busy_until = p + half;
      if (vertical)
        canvas.text({a.room.left - 0.4 * a.em, p}, t.label, {.size = a.em, .across = Align::high, .up = Align::middle});
      else
        canvas.text({p, a.room.bottom - 0.35 * a.em}, t.label, {.size = a.em, .across = Align::middle, .up = Align::high});
    }
  }
}

void draw_frame(Canvas& canvas, const Axes& a) { canvas.outline(a.room, std::max(1.2, a.em / 18), axes_ink); }

namespace {
int labels(const Ticks& ticks) {
  return static_cast<int>(std::count_if(ticks.ticks.begin(), ticks.ticks.end(), [](const Tick& t) { return !t.label.empty(); }));
}
}  // namespace

Ticks few_ticks(double low, double high, double wanted) {
  Ticks out;
  for (int n = std::clamp(static_cast<int>(wanted), 2, 8); n <= 10 && labels(out) < 2; ++n) out = linear_ticks(low, high, n);
  return out;
}

namespace {

bool fit(const Ticks& ticks, const Axis& axis, double em) {
  double last = -1e9;
  for (const Tick& t : ticks.ticks) {
    if (t.label.empty()) continue;
    const double half = text_extent(t.label, em).x / 2;
    if (axis.pixel(t.value) - half - last < 0.8 * em) return false;
    last = axis.pixel(t.value) + half;
  }
  return true;
}

}  // namespace

Ticks spaced_ticks(const Axis& axis, double em) {
  Ticks out;
  for (int n = 8; n >= 2; --n)
    if (fit(out = few_ticks(axis.low, axis.high, n), axis, em)) return out;
  // Every second label, counted from zero.
  double step = 0, first = std::numeric_limits<double>::quiet_NaN();
  for (Tick& t : out.ticks) {
    if (t.label.empty()) continue;
    if (step == 0 && std::isfinite(first)) step = t.value - first;
    first = t.value;
  }
  const auto even = [&](const Tick& t) { return step > 0 && std::lround(t.value / step) % 2 == 0; };
  const bool enough = std::count_if(out.ticks.begin(), out.ticks.end(), [&](const Tick& t) { return !t.label.empty() && even(t); }) >= 2;
  for (Tick& t : out.ticks)
    if (even(t) != enough) t.label.clear();
  return out;
}

std::string axis_name(const std::string& label, const Ticks& ticks) {
  return ticks.exponent ? label + "  (× " + power_of_ten(ticks.exponent) + ")" : label;
}

}  // namespace dotyk::figure

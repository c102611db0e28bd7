#include "figure/canvas/axes.hpp"

#include <iterator>
#include <numbers>
#include <tuple>

namespace dotyk::figure {

bool Axis::shows(double value) const { return std::isfinite(value) && (!log || value > 0); }

namespace {

Wide place(const Axis& axis, double value) { return axis.log ? Wide{std::log10(value)} : Wide{value}; }

Wide per_unit(const Axis& axis) { return (axis.to - axis.from) / (place(axis, axis.high) - place(axis, axis.low)); }

// The part of a broken axis on which the value lies.
Axis part_of(const Axis& axis, double value) {
  const AxisBreak& b = *axis.left_out;
  if (value < b.from) return {axis.log, axis.low, b.from, axis.from, b.low};
  if (value > b.to) return {axis.log, b.to, axis.high, b.high, axis.to};
  return {axis.log, b.from, b.to, b.low, b.high};
}

double hair(double em) { return std::max(1.0, em / 24); }

// Do all labels have room, `apart` em from each other at least?
bool fit(const Ticks& ticks, const Axis& axis, double em, double apart = 0.8) {
  double last = -1e9;
  for (const Tick& t : ticks.ticks) {
    if (t.label.empty()) continue;
    const double half = text_extent(t.label, em).x / 2;
    if (axis.pixel(t.value) - half - last < apart * em) return false;
    last = axis.pixel(t.value) + half;
  }
  return true;
}

}  // namespace

double Axis::pixel(double value) const {
  if (left_out) return part_of(*this, value).pixel(value);
  const Wide a = place(*this, low), b = place(*this, high);
  const Wide at = from + (to - from) * ((place(*this, value) - a) / (b - a));
  return static_cast<double>(std::clamp<Wide>(at, -most_pixels, most_pixels));
}

double Axis::value(double pixel) const {
  const Wide a = place(*this, low), at = a + (pixel - from) / (to - from) * (place(*this, high) - a);
  return static_cast<double>(log ? std::pow(Wide{10}, at) : at);
}

double Axis::pixels_per_unit() const { return static_cast<double>(std::min<Wide>(per_unit(*this), most_pixels)); }

double steepness(const Axis& x, const Axis& y, double slope) {
  return static_cast<double>(std::clamp<Wide>(slope * per_unit(y) / per_unit(x), -most_pixels, most_pixels));
}

Point Axes::at(double x_value, double y_value) const {
  if (!pole) return {x.pixel(x_value), y.pixel(y_value)};
  const double angle = x_value * std::numbers::pi / 180;
  return *pole + y.pixel(y_value) * Point{std::cos(angle), std::sin(angle)};
}

std::vector<std::vector<Point>> pieces(std::size_t count, const std::function<std::optional<Point>(std::size_t)>& at) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < count; ++i) {
    if (const std::optional<Point> point = at(i))
      out.back().push_back(*point);
    else if (!out.back().empty())
      out.emplace_back();
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

void draw_grid(Canvas& canvas, const Axes& a) {
  canvas.box(a.room, {255, 255, 255});
  for (const double x : a.x_ticks.labelled()) canvas.line({a.x.pixel(x), a.room.bottom}, {a.x.pixel(x), a.room.top}, hair(a.em), axes_grid);
  for (const double y : a.y_ticks.labelled()) canvas.line({a.room.left, a.y.pixel(y)}, {a.room.right, a.y.pixel(y)}, hair(a.em), axes_grid);
}

void draw_ticks(Canvas& canvas, const Axes& a, Side side, bool labels, Colour colour) {
  const double tick = a.tick * a.em;
  const bool vertical = side != Side::below;
  const Point inwards = side == Side::left ? Point{1, 0} : side == Side::right ? Point{-1, 0} : Point{0, 1};
  double busy_until = -1e9;
  for (const Tick& t : (vertical ? a.y_ticks : a.x_ticks).ticks) {
    const double p = (vertical ? a.y : a.x).pixel(t.value), length = t.label.empty() ? 0.55 * tick : tick;
    const Point foot = vertical ? Point{side == Side::left ? a.room.left : a.room.right, p} : Point{p, a.room.bottom};
    canvas.line(foot, foot + length * inwards, 1.3 * hair(a.em), colour);
    if (t.label.empty() || !labels) continue;
    const double half = (vertical ? 0.9 * a.em : text_extent(t.label, a.em).x + 0.5 * a.em) / 2;
    if (p - half < busy_until) continue;
    busy_until = p + half;
    TextStyle style{.size = a.em, .across = side == Side::left ? Align::high : Align::low, .up = Align::middle};
    if (!vertical) style.across = Align::middle, style.up = Align::high;
    if (!(colour == axes_ink)) style.colour = colour;
    canvas.text(foot - (vertical ? 0.4 : 0.35) * a.em * inwards, t.label, style);
  }
}

void draw_frame(Canvas& canvas, const Axes& a) { canvas.outline(a.room, std::max(1.2, a.em / 18), axes_ink); }

double widest_label(const Ticks& ticks, double size) {
  double widest = 0;
  for (const Tick& t : ticks.ticks) widest = std::max(widest, text_extent(t.label, size).x);
  return widest;
}

Ticks few_ticks(double low, double high, double wanted, double plain) {
  const std::size_t least = wanted < 2.3 ? 2 : 4;
  Ticks out;
  for (int n = std::clamp(static_cast<int>(wanted), 2, 8); n <= 10 && out.labelled().size() < least; ++n) out = linear_ticks(low, high, n, plain);
  return out;
}

double share_below(const Axis& axis) {
  constexpr double kLeast = 0.2;
  const AxisBreak& b = *axis.left_out;
  return std::clamp((b.from - axis.low) / (b.from - axis.low + axis.high - b.to), kLeast, 1 - kLeast);
}

Ticks broken_ticks(const Axis& axis, double wanted) {
  constexpr double kMost = 20;
  const AxisBreak& b = *axis.left_out;
  const double below = b.from - axis.low, above = axis.high - b.to, share = share_below(axis);
  const bool one_scale = std::abs(share - below / (below + above)) < 1e-9;
  const auto part = [&](double low, double high, double labels, std::size_t least) {
    Ticks out;
    for (double n = std::max(1.0, labels); out.labelled().size() < least && n < kMost; n *= 1.3) out = linear_ticks(low, high, static_cast<int>(n));
    return out;
  };
  if (!one_scale) {
    Ticks out = part(axis.low, b.from, share * wanted, 2), upper = part(b.to, axis.high, (1 - share) * wanted, 1);
    const int exponent = std::max(out.exponent, upper.exponent);
    for (Ticks* own : {&out, &upper})
      for (Tick& t : own->ticks)
        if (own->exponent != exponent && !t.label.empty()) t.label = scaled_number(t.value, exponent);
    out.exponent = exponent;
    std::ranges::copy(upper.ticks, std::back_inserter(out.ticks));
    return out;
  }
  const double least = std::max(3.0, wanted) * (axis.high - axis.low) / (below + above);
  for (double n = least;; n *= 1.3) {
    Ticks out = linear_ticks(axis.low, axis.high, static_cast<int>(n));
    std::erase_if(out.ticks, [&](const Tick& t) { return t.value >= b.from && t.value <= b.to; });
    const std::vector<double> values = out.labelled();
    const auto over = std::count_if(values.begin(), values.end(), [&](double v) { return v > b.to; });
    if ((over > 0 && std::ssize(values) - over > 1) || n > kMost * least) return out;
  }
}

Ticks spaced_ticks(const Axis& axis, double em) {
  Ticks out;
  for (const auto& [apart, least] : {std::tuple{0.8, 4U}, {0.4, 4U}, {0.8, 3U}})
    for (int n = 8; n >= 2; --n)
      if (fit(out = few_ticks(axis.low, axis.high, n), axis, em, apart) && out.labelled().size() >= least) return out;
  for (const double plain : {1e-3, 1.0})
    for (int n = 6; n >= 2; --n)
      if (fit(out = linear_ticks(axis.low, axis.high, n, plain), axis, em) && out.labelled().size() > 2) return out;
  if (fit(out = few_ticks(axis.low, axis.high, 2), axis, em)) return out;
  // Every second label, counted from zero.
  const std::vector<double> labelled = out.labelled();
  const double step = labelled.size() > 1 ? labelled[1] - labelled[0] : 0;
  const auto even = [step](double value) { return step > 0 && std::lround(value / step) % 2 == 0; };
  const bool enough = std::count_if(labelled.begin(), labelled.end(), even) >= 2;
  for (Tick& t : out.ticks)
    if (even(t.value) != enough) t.label.clear();
  return out;
}

std::string axis_name(const std::string& label, const Ticks& ticks) {
  return ticks.exponent ? label + "  (× " + power_of_ten(ticks.exponent) + ")" : label;
}

}  // namespace dotyk::figure

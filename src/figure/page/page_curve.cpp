// The cell of a curve: a diagram of a beam, the graph of a law.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour point_colour{213, 94, 0}, zero_ink{110, 110, 110}, forbidden_grey{236, 236, 236};

// Places of the greatest and the least value of a diagram.
struct Extremes {
  std::size_t high = 0, low = 0;
};

Extremes extremes(const PageCurve& c) {
  Extremes e;
  const double slack = 1e-9 * std::abs(*std::max_element(c.y.begin(), c.y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (std::size_t i = 0; i < c.y.size(); ++i) {  // the first of equal ones
    if (c.y[i] > c.y[e.high] + slack) e.high = i;
    if (c.y[i] < c.y[e.low] - slack) e.low = i;
  }
  return e;
}

void fill(Canvas& canvas, const PageCurve& c, const Axes& axes, Colour colour) {
  const double zero = axes.y.pixel(0);
  for (std::size_t i = 0; i + 1 < c.x.size(); ++i) {
    const Point p{axes.x.pixel(c.x[i]), axes.y.pixel(c.y[i])}, q{axes.x.pixel(c.x[i + 1]), axes.y.pixel(c.y[i + 1])};
    if ((c.y[i] < 0) == (c.y[i + 1] < 0) || c.y[i] == 0 || c.y[i + 1] == 0) {
      canvas.convex(std::array<Point, 4>{Point{p.x, zero}, p, q, Point{q.x, zero}}, colour, 0.22);
      continue;
    }
    const double cross = p.x + (q.x - p.x) * (zero - p.y) / (q.y - p.y);
    canvas.convex(std::array<Point, 3>{Point{p.x, zero}, p, Point{cross, zero}}, colour, 0.22);
    canvas.convex(std::array<Point, 3>{Point{cross, zero}, q, Point{q.x, zero}}, colour, 0.22);
  }
}

void label_extremes(Canvas& canvas, const PageCurve& c, const Axes& axes) {
  const Extremes e = extremes(c);
  const double em = axes.em, size = 0.95 * em;
  for (const bool top : {true, false}) {
    const std::size_t i = top ? e.high : e.low;
    if (top ? !(c.y[i] > 0) : !(c.y[i] < 0)) continue;
    const Point p{axes.x.pixel(c.x[i]), axes.y.pixel(c.y[i])};
    canvas.marker(Marker::disc, p, 0.4 * em, axes_ink);
    const std::string text = number(c.y[i], 4);
    const double half = text_extent(text, size).x / 2;
    TextStyle style;
    style.size = size;
    style.across = Align::middle;
    style.up = top ? Align::low : Align::high;
    style.halo = true;
    canvas.text({std::clamp(p.x, axes.room.left + half + 0.3 * em, axes.room.right - half - 0.3 * em), p.y + (top ? 0.35 : -0.35) * em}, text, style);
  }
}

void draw_zero(Canvas& canvas, const Axes& axes, bool vertical_too) {
  const double width = std::max(1.0, axes.em / 18);
  if (axes.y.low < 0 && axes.y.high > 0) canvas.line({axes.room.left, axes.y.pixel(0)}, {axes.room.right, axes.y.pixel(0)}, width, zero_ink);
  if (vertical_too && axes.x.low < 0 && axes.x.high > 0) canvas.line({axes.x.pixel(0), axes.room.bottom}, {axes.x.pixel(0), axes.room.top}, width, zero_ink);
}

// The working point, told by its coordinates where no curve is.
void draw_point(Canvas& canvas, const CurveDrawing& curve, const Axes& axes) {
  const auto [x, y] = *curve.point;
  const double em = axes.em;
  const Point p{axes.x.pixel(x), axes.y.pixel(y)};
  const auto sample = [em](Canvas& c, Point at) { c.marker(Marker::disc, at, 0.62 * em, point_colour); };
  sample(canvas, p);
  Occupied occupied;
  for (const PageCurve& c : curve.curves) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < c.x.size(); ++i) points.push_back({axes.x.pixel(c.x[i]), axes.y.pixel(c.y[i])});
    occupied.add(points, axes.room);
  }
  occupied.add(Box{p.x - 0.4 * em, p.y - 0.4 * em, p.x + 0.4 * em, p.y + 0.4 * em});
  const double size = 0.9 * em;
  const std::string text = "(" + number(x) + ", " + number(y) + ")";
  const Point extent = text_extent(text, size);
  // Clear of the axes too, if that can be had.
  Occupied all = occupied;
  const Point origin{axes.x.pixel(0), axes.y.pixel(0)};
  all.add({{axes.room.left, origin.y}, {axes.room.right, origin.y}}, axes.room);
  all.add({{origin.x, axes.room.bottom}, {origin.x, axes.room.top}}, axes.room);
  std::optional<Point> place = place_beside(all, axes.room, p, extent.x, extent.y, 0.35 * em);
  if (!place) place = place_beside(occupied, axes.room, p, extent.x, extent.y, 0.35 * em);
  if (!place) return;
  TextStyle style;
  style.size = size;
  style.colour = {150, 60, 0};
  style.across = style.up = Align::middle;
  style.halo = true;
  canvas.text(*place, text, style);
}

}  // namespace

void fit_y(const CurveDrawing& curve, Axes& axes) {
  double low = 0, high = 0;
  if (curve.y_range) {
    low = (*curve.y_range)[0], high = (*curve.y_range)[1];
  } else {
    for (const PageCurve& c : curve.curves)
      for (const double y : c.y) low = std::min(low, y), high = std::max(high, y);
    if (high - low <= 0) low = -1, high = 1;
    // Room for the extremes' values.
    const double share = std::min(0.3, 1.9 * axes.em / std::max(1.0, axes.room.height()));
    const double span = (high - low) / (1 - (low < 0 ? share : 0.06) - (high > 0 ? share : 0.06));
    low -= span * (low < 0 ? share : 0.06), high += span * (high > 0 ? share : 0.06);
  }
  axes.y.low = low, axes.y.high = high;
  axes.y.from = axes.room.bottom, axes.y.to = axes.room.top;
  axes.y_ticks = few_ticks(low, high, axes.room.height() / (2.6 * axes.em));
  const bool nothing = std::all_of(curve.curves.begin(), curve.curves.end(), [](const PageCurve& c) {
    return std::all_of(c.y.begin(), c.y.end(), [](double y) { return y == 0; });
  });
  if (curve.no_scale || (nothing && !curve.y_range)) axes.y_ticks = Ticks{{{0, "0"}}, 0};
}

void draw_cell(Canvas& canvas, const CurveDrawing& curve, const Axes& axes) {
  const Colour colour = series_colour(curve.colour);
  canvas.clip(axes.room);
  for (const auto& range : curve.forbidden)
    canvas.box({axes.x.pixel(range[0]), axes.room.bottom, axes.x.pixel(range[1]), axes.room.top}, forbidden_grey);
  draw_zero(canvas, axes, !curve.area);
  const double em = axes.em, width = std::max(2.0, em / (curve.area ? 8 : 5.5));
  const std::array<double, 2> dash{0.35 * em, 0.3 * em};
  for (const PageCurve& c : curve.curves) {
    if (curve.area) fill(canvas, c, axes, colour);
    std::vector<Point> points;
    for (std::size_t i = 0; i < c.x.size(); ++i) points.push_back({axes.x.pixel(c.x[i]), axes.y.pixel(c.y[i])});
    canvas.polyline(points, c.dashed ? 0.6 * width : width, colour, c.dashed ? std::span<const double>(dash) : std::span<const double>());
  }
  canvas.no_clip();
  if (curve.area && !curve.curves.empty()) label_extremes(canvas, curve.curves.front(), axes);
  if (curve.point) draw_point(canvas, curve, axes);
}

}  // namespace dotyk::figure

// The cell of a curve: a diagram of a beam, the graph of a law.
#include "figure/page/page_cells.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour zero_ink{110, 110, 110};

// Down to zero.
void fill(Canvas& canvas, const PageCurve& c, const Axes& axes, Colour colour) {
  const double zero = axes.y.pixel(0);
  const std::vector<Point> line = axes.line(c.x, c.y);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point p = line[i], q = line[i + 1], p0{p.x, zero}, q0{q.x, zero};
    if ((c.y[i] < 0) == (c.y[i + 1] < 0) || c.y[i] == 0 || c.y[i + 1] == 0) {
      canvas.convex(std::array{p0, p, q, q0}, colour, 0.22);
      continue;
    }
    const Point cross{p.x + (q.x - p.x) * (zero - p.y) / (q.y - p.y), zero};
    canvas.convex(std::array{p0, p, cross}, colour, 0.22);
    canvas.convex(std::array{cross, q, q0}, colour, 0.22);
  }
}

// The greatest value and the least, of equal ones the first.
void label_extremes(Canvas& canvas, const PageCurve& c, const Axes& axes) {
  const double slack = 1e-9 * std::abs(*std::max_element(c.y.begin(), c.y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double em = axes.em, size = 0.95 * em;
  for (const int sign : {1, -1}) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < c.y.size(); ++i)
      if (sign * c.y[i] > sign * c.y[most] + slack) most = i;
    if (!(sign * c.y[most] > 0)) continue;
    const Point p = axes.at(c.x[most], c.y[most]);
    canvas.marker(Marker::disc, p, 0.4 * em, axes_ink);
    const std::string text = number(c.y[most], 4);
    const double half = text_extent(text, size).x / 2;
    canvas.text({std::clamp(p.x, axes.room.left + half + 0.3 * em, axes.room.right - half - 0.3 * em), p.y + sign * 0.35 * em}, text,
                {.size = size, .across = Align::middle, .up = sign > 0 ? Align::low : Align::high, .halo = true});
  }
}

void draw_zero(Canvas& canvas, const Axes& axes, bool vertical_too) {
  const double width = std::max(1.0, axes.em / 18);
  const Point zero = axes.at(0, 0);
  if (axes.y.low < 0 && axes.y.high > 0) canvas.line({axes.room.left, zero.y}, {axes.room.right, zero.y}, width, zero_ink);
  if (vertical_too && axes.x.low < 0 && axes.x.high > 0) canvas.line({zero.x, axes.room.bottom}, {zero.x, axes.room.top}, width, zero_ink);
}

// The working point, told by its coordinates where no curve is.
void draw_point(Canvas& canvas, const CurveDrawing& curve, const Axes& axes) {
  const auto [x, y] = *curve.point;
  const double em = axes.em;
  const Point p = axes.at(x, y), origin = axes.at(0, 0);
  canvas.marker(Marker::disc, p, 0.62 * em, state_colour(curve.state));
  canvas.tell({state_name(curve.state), {*curve.point}});
  Occupied occupied;
  for (const PageCurve& c : curve.curves) occupied.add(axes.line(c.x, c.y), axes.room);
  occupied.add(Box{p.x - 0.4 * em, p.y - 0.4 * em, p.x + 0.4 * em, p.y + 0.4 * em});
  // Clear of the axes too, if that can be had.
  Occupied all = occupied;
  all.add({{axes.room.left, origin.y}, {axes.room.right, origin.y}}, axes.room);
  all.add({{origin.x, axes.room.bottom}, {origin.x, axes.room.top}}, axes.room);
  // In one line or two; at worst over a curve. A line leads to what is far.
  Occupied marker;
  marker.add(Box::about(p, {0.8 * em, 0.8 * em}));
  const double size = 0.9 * em, line = 1.25 * size, far = 2.5 * em;
  const std::string abscissa = "(" + number(x) + ",", ordinate = number(y) + ")";
  const std::vector<std::string> lines[] = {{abscissa + " " + ordinate}, {abscissa, ordinate}};
  for (const auto& [spared, margin] : {std::pair{&all, 0.35}, {&occupied, 0.35}, {&occupied, 0.1}, {&marker, 0.1}})
    for (const std::vector<std::string>& texts : lines) {
      Point extent{0, size + line * static_cast<double>(texts.size() - 1)};
      for (const std::string& text : texts) extent.x = std::max(extent.x, text_extent(text, size).x);
      const auto place = place_beside(*spared, axes.room, p, extent, margin * em);
      if (!place) continue;
      const Box box = Box::about(*place, extent);
      const Point end{std::clamp(p.x, box.left, box.right), std::clamp(p.y, box.bottom, box.top)};
      if (const double way = length(end - p); way > far) canvas.line(part_way(p, end, 0.4 * em / way), end, std::max(1.0, em / 20), axes_ink);
      for (std::size_t i = 0; i < texts.size(); ++i)
        canvas.text({place->x, place->y + extent.y / 2 - size / 2 - line * static_cast<double>(i)}, texts[i], {.size = size, .across = Align::middle, .up = Align::middle, .colour = axes_ink, .halo = true});
      return;
    }
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
  axes.y_ticks = few_ticks(low, high, axes.room.height() / (2.6 * axes.em), plain_numbers);
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
    const std::vector<Point> line = axes.line(c.x, c.y);
    canvas.tell({"curve", axes.values(line)});
    canvas.polyline(line, c.dashed ? 0.6 * width : width, colour, c.dashed ? std::span<const double>(dash) : std::span<const double>());
  }
  canvas.no_clip();
  if (curve.area && !curve.curves.empty()) label_extremes(canvas, curve.curves.front(), axes);
  if (curve.point) draw_point(canvas, curve, axes);
}

}  // namespace dotyk::figure

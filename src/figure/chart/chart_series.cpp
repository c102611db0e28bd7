#include "figure/chart/chart_series.hpp"

#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace dotyk::figure {
namespace {

double length_of(const std::vector<Point>& curve) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) sum += length(curve[i] - curve[i - 1]);
  return sum;
}

bool has_markers(const SeriesPicture& s) { return s.style != SeriesStyle::line && !s.reference && !s.front; }

bool dense(const std::vector<Point>& curve, double spacing) {
  return curve.size() > 2 && std::abs(curve.back().x - curve.front().x) / static_cast<double>(curve.size() - 1) < spacing && curve.size() > 60;
}

// The corners of the curve.
std::vector<Point> without_straight(const std::vector<Point>& curve) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!out.empty() && i + 1 < curve.size()) {
      const Point a = curve[i] - out.back(), b = curve[i + 1] - curve[i];
      if (a.x * b.x + a.y * b.y > 0 && std::abs(a.x * b.y - a.y * b.x) < 1e-3 * length(b)) continue;
    }
    out.push_back(curve[i]);
  }
  return out;
}

// A solid line, cut off at the room's edges across its whole width: the canvas cuts polygons so, of lines it only looks at the middle.
void stroke_within(Canvas& canvas, const Box& room, const std::vector<Point>& curve, double width, Colour colour) {
  const std::vector<Point> points = without_straight(curve);
  std::vector<Point> whole;
  const auto finish = [&] { canvas.polyline(std::exchange(whole, {}), width, colour); };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    Point p = points[i], q = points[i + 1];
    const double half = width / 2, far = length(q - p);
    if (far == 0 || !crop(p, q, room)) continue;
    const Point side = half / far * Point{points[i].y - points[i + 1].y, points[i + 1].x - points[i].x};
    const std::array corners{p - side, q - side, q + side, p + side};
    if (std::ranges::all_of(corners, [&](Point corner) { return room.holds(corner, 1e-6); })) {
      if (whole.empty() || length(p - whole.back()) > 0) finish(), whole = {p};
      whole.push_back(q);
      continue;
    }
    canvas.convex(corners, colour);
    if (i > 0) canvas.disc(points[i], half, colour);
    if (i + 2 < points.size()) canvas.disc(points[i + 1], half, colour);
  }
  finish();
}

// What is less than this on a logarithmic axis is drawn here, below the plot.
double least_shown(const Axis& axis) { return std::max(axis.low * 1e-6, std::numeric_limits<double>::denorm_min()); }

}  // namespace

Neighbourhood::Neighbourhood(const Box& room, double reach)
    : room_(room), cell_(reach / 2), reach_(reach), columns_(1 + std::max(0, static_cast<int>(room.width() / cell_))), rows_(1 + std::max(0, static_cast<int>(room.height() / cell_))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void Neighbourhood::add(Point p) {
  if (!room_.holds(p)) return;
  cells_[static_cast<std::size_t>((p.y - room_.bottom) / cell_) * columns_ + static_cast<std::size_t>((p.x - room_.left) / cell_)] = true;
}

void Neighbourhood::add(const std::vector<Point>& curve) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    Point p = curve[i], q = curve[i + 1];
    if (!crop(p, q, room_)) continue;
    const int n = 1 + static_cast<int>(length(q - p) / cell_);
    for (int k = 0; k <= n; ++k) add(part_way(p, q, static_cast<double>(k) / n));
  }
}

bool Neighbourhood::holds(Point p) const {
  const int column = static_cast<int>((p.x - room_.left) / cell_), row = static_cast<int>((p.y - room_.bottom) / cell_);
  for (int j = std::max(0, row - 2); j <= std::min(rows_ - 1, row + 2); ++j)
    for (int i = std::max(0, column - 2); i <= std::min(columns_ - 1, column + 2); ++i)
      if (cells_[static_cast<std::size_t>(j) * columns_ + i] && length(Point{room_.left + (i + 0.5) * cell_, room_.bottom + (j + 0.5) * cell_} - p) <= reach_) return true;
  return false;
}

std::vector<std::vector<Point>> sampled(const std::vector<Point>& curve, const Box& room) {
  constexpr double kSpacing = 3;
  std::vector<std::vector<Point>> out;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    Point p = curve[i], q = curve[i + 1];
    const bool seen = crop(p, q, room);
    if (seen) {
      if (!goes_on) out.push_back({p});
      const int n = 1 + static_cast<int>(length(q - p) / kSpacing);
      for (int k = 1; k <= n; ++k) out.back().push_back(part_way(p, q, static_cast<double>(k) / n));
    }
    goes_on = seen && room.holds(curve[i + 1]);
  }
  return out;
}

std::vector<HiddenPart> hidden_parts(const std::vector<Point>& curve, const std::vector<Neighbourhood>& later, const Box& room, double least) {
  std::vector<HiddenPart> out;
  const auto finish = [&](HiddenPart part) {
    if (part.depth > 0 && length_of(part.points) >= least) out.push_back(std::move(part));
  };
  for (const std::vector<Point>& part : sampled(curve, room)) {
    HiddenPart now;
    for (const Point& p : part) {
      const auto depth = static_cast<int>(std::ranges::count_if(later, [&](const Neighbourhood& n) { return n.holds(p); }));
      if (depth != now.depth) finish(std::exchange(now, {{}, depth}));
      now.points.push_back(p);
    }
    finish(now);
  }
  return out;
}

// The axes of a series. If several series have whiskers at the same x, each of these is moved aside by some pixels, so that the whiskers stand side by side.
Axes SeriesDrawing::axes_of(const SeriesPicture& s) const {
  constexpr double kStep = 0.55, kMost = 1.65, kShare = 0.6;  // em, of all together, and of the way to the next x
  Axes axes = axes_.of(s);
  if (!s.bars || axes.pole || !s.x_low.empty()) return axes;
  const std::set<double> own(s.x.begin(), s.x.end());
  std::set<double> at;
  double before = 0, all = 0, apart = INFINITY;
  for (const Look& look : looks_) {
    const SeriesPicture& other = look.data;
    if (!other.bars || std::ranges::none_of(other.x, [&](double x) { return own.contains(x); })) continue;
    if (&other == &s) before = all;
    ++all;
    at.insert(other.x.begin(), other.x.end());
  }
  for (auto x = at.begin(); x != at.end() && std::next(x) != at.end(); ++x) apart = std::min(apart, axes.x.pixel(*std::next(x)) - axes.x.pixel(*x));
  const double aside = (before - (all - 1) / 2) * std::min({kStep * pen_.em, kMost * pen_.em / all, kShare * apart / all});
  axes.x.from += aside, axes.x.to += aside;
  return axes;
}

// At every point that the axes show: across from x_low to x_high, upright from low to high.
std::vector<std::array<Point, 2>> SeriesDrawing::whiskers(const SeriesPicture& s) const {
  const Axes axes = axes_of(s);
  std::vector<std::array<Point, 2>> out;
  const auto add = [&](Point low, Point high) {
    // Zero and less have no place on a logarithmic axis: the whisker comes from below the plot.
    if (axes.x.log) low.x = std::max(low.x, least_shown(axes.x));
    if (axes.y.log) low.y = std::max(low.y, least_shown(axes.y));
    for (const Point& p : {low, high})
      if (!axes.x.shows(p.x) || !axes.y.shows(p.y)) return;
    out.push_back({axes.at(low.x, low.y), axes.at(high.x, high.y)});
  };
  for (std::size_t i = 0; i < s.x_low.size(); ++i) add({s.x_low[i], s.y[i]}, {s.x_high[i], s.y[i]});
  for (std::size_t i = 0; s.bars && i < s.low.size(); ++i) add({s.x[i], s.low[i]}, {s.x[i], s.high[i]});
  return out;
}

void SeriesDrawing::occupy(Occupied& occupied) const {
  for (const Look& look : looks_) {
    const SeriesPicture& s = look.data;
    const Axes axes = axes_of(s);
    for (const auto& [from, to] : whiskers(s)) occupied.add({from, to}, axes.room);
    for (const auto* values : {&s.y, &s.low, &s.high})
      for (const auto& curve : curves(s.x, *values, axes)) occupied.add(curve, axes.room);
  }
}

void SeriesDrawing::draw_front(const Look& look) {
  if (!look.data.front) return;
  for (const auto& curve : curves(look.data.x, look.data.y, axes_of(look.data))) {
    stroke_within(canvas_, axes_.left.room, curve, pen_.front_width(), look.colour);
    for (const Point& end : {curve.front(), curve.back()}) canvas_.disc(end, pen_.front_width() / 2, look.colour);
  }
}

void SeriesDrawing::draw_band(const Look& look) {
  const SeriesPicture& s = look.data;
  const Axes axes = axes_of(s);
  if (s.low.empty() || s.bars) return;
  const int parts = axes.y.left_out ? 200 : 1;  // it bends at a break
  const auto at = [&](std::size_t i, int part, const std::vector<double>& value) {
    const auto between = [&](const std::vector<double>& v) { return part == 0 ? v[i] : part == parts ? v[i + 1] : v[i] + (v[i + 1] - v[i]) * part / parts; };
    return axes.at(between(s.x), axes.y.log ? std::max(between(value), least_shown(axes.y)) : between(value));
  };
  for (std::size_t i = 0; i + 1 < s.x.size(); ++i)
    for (int k = 0; k < parts && axes.x.shows(s.x[i]) && axes.x.shows(s.x[i + 1]); ++k)
      canvas_.convex(std::array{at(i, k, s.low), at(i, k + 1, s.low), at(i, k + 1, s.high), at(i, k, s.high)}, look.colour, 0.2);
}

// Where a line lies beneath later ones, dashes of it are drawn on top of them. The deeper it lies, the longer are the gaps, so that all stay visible.
void SeriesDrawing::draw_lines() {
  constexpr int kDeepest = 3;
  const double width = pen_.line_width(), near = 0.75 * width, dash = 0.5 * pen_.em, least = 3 * pen_.em;
  const Box& room = axes_.left.room;
  const Box inner = room.grown(-width / 2);  // a dash here does not reach beyond the frame
  std::vector<std::vector<std::vector<Point>>> lines;
  std::vector<Neighbourhood> solid;  // about those that hide what is beneath
  std::vector<std::size_t> of;       // whose they are
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    const SeriesPicture& s = looks_[k].data;
    lines.push_back(has_line(s) ? curves(s.x, s.y, axes_of(s)) : std::vector<std::vector<Point>>());
    for (const auto& curve : lines[k])
      canvas_.tell({"curve: " + s.name, axes_of(s).values(curve)}), looks_[k].dashed ? pen_.stroke(canvas_, curve, looks_[k]) : stroke_within(canvas_, room, curve, width, looks_[k].colour);
    if (looks_[k].dashed || lines[k].empty()) continue;
    of.push_back(k);
    solid.emplace_back(room, near);
    for (const auto& curve : lines[k]) solid.back().add(curve);
  }
  for (std::size_t k = looks_.size(); k-- > 0;) {
    const std::vector<Neighbourhood> later(solid.begin() + (std::ranges::upper_bound(of, k) - of.begin()), solid.end());
    for (const auto& curve : lines[k])
      for (HiddenPart& part : hidden_parts(curve, later, room, least)) {
        for (Point& p : part.points) p = {std::clamp(p.x, inner.left, inner.right), std::clamp(p.y, inner.bottom, inner.top)};
        canvas_.polyline(without_straight(part.points), width, looks_[k].colour, std::array{dash, ((1 << std::min(part.depth, kDeepest)) - 1) * dash});
      }
  }
}

void SeriesDrawing::draw_curves() {
  for (const Look& look : looks_) draw_front(look);
  for (const Look& look : looks_) draw_band(look);
  draw_lines();
  for (const Look& look : looks_)
    for (const auto& ends : whiskers(look.data)) pen_.whisker(canvas_, ends, look);
}

// A line needs no marker at every one of many points; points alone do.
std::vector<Point> SeriesDrawing::marked(const SeriesPicture& s) const {
  std::vector<Point> out;
  if (!has_markers(s)) return out;
  const Axes axes = axes_of(s);
  for (const std::vector<Point>& run : runs(s.x, s.y, axes)) {
    std::vector<Point> curve;
    for (const Point& p : run)
      if (!axes.y.left_out || !axes.y.left_out->hides(p.y)) curve.push_back(axes.at(p.x, p.y));
    const double spacing = s.style == SeriesStyle::both && dense(curve, pen_.marker_size(s)) ? 0.08 * axes.room.width() : 0;
    const Point* last = nullptr;
    for (const Point& p : curve) {
      if (!axes.room.holds(p, 0.5) || (last && length(p - *last) < spacing)) continue;
      out.push_back(p), last = &p;
    }
  }
  return out;
}

// In series without lines markers of one place are nested, those above smaller: all together are little larger than one. Of curves
// draw_lines() shows what is beneath.
void SeriesDrawing::draw_markers() {
  constexpr double kStep = 0.16, kMost = 0.42, kMore = 0.04;  // em from diameter to diameter, from the least to the greatest, and wider for each
  const double near = 0.75 * pen_.line_width();
  const Box room = axes_.left.room.grown(1);
  std::vector<std::vector<Point>> places;
  for (const Look& look : looks_)
    places.push_back(marked(look.data)), canvas_.tell({"markers: " + look.data.name, axes_of(look.data).values(places.back())});
  std::vector<Neighbourhood> about(looks_.size(), Neighbourhood(room, near));
  for (std::size_t k = 0; k < looks_.size(); ++k)
    for (const Point& p : places[k]) about[k].add(p);
  for (std::size_t k = 0; k < looks_.size(); ++k)
    for (const Point& p : places[k]) {
      double above = 0, below = 0;
      for (std::size_t other = 0; other < looks_.size(); ++other)
        if (other != k && looks_[k].data.style == SeriesStyle::points && about[other].holds(p)) ++(other > k ? above : below);
      const double step = std::min(kStep, kMost / std::max(1.0, above + below)) * pen_.em;
      pen_.mark(canvas_, looks_[k], p, (step * (above - below) / 2 + kMore * pen_.em * (above + below)) / 2);
    }
}

}  // namespace dotyk::figure

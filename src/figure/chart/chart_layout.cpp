#include "figure/chart/chart_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

bool Axis::shows(double value) const { return std::isfinite(value) && (!log || value > 0); }

namespace {

// The nearest that a double can be.
double held(Wide value, double least = std::numeric_limits<double>::lowest()) {
  return static_cast<double>(std::clamp(value, Wide{least}, Wide{std::numeric_limits<double>::max()}));
}

constexpr double least_positive = std::numeric_limits<double>::denorm_min();

Wide place(const Axis& axis, double value) { return axis.log ? Wide{std::log10(value)} : Wide{value}; }

}  // namespace

double Axis::pixel(double value) const {
  const Wide a = place(*this, low), b = place(*this, high);
  const Wide at = from + (to - from) * ((place(*this, value) - a) / (b - a));
  return static_cast<double>(std::clamp<Wide>(at, -most_pixels, most_pixels));
}

double Axis::pixels_per_unit() const {
  return static_cast<double>(std::min<Wide>((to - from) / (place(*this, high) - place(*this, low)), most_pixels));
}

double steepness(const Axis& x, const Axis& y, double slope) {
  const auto per_unit = [](const Axis& axis) { return (axis.to - axis.from) / (place(axis, axis.high) - place(axis, axis.low)); };
  return static_cast<double>(std::clamp<Wide>(slope * per_unit(y) / per_unit(x), -most_pixels, most_pixels));
}

Axis fit_axis(const ChartPicture& chart, bool vertical) {
  Axis axis;
  axis.log = vertical ? chart.log_y : chart.log_x;
  const auto& given = vertical ? chart.y_range : chart.x_range;
  if (given) {
    axis.low = (*given)[0], axis.high = (*given)[1];
    return axis;
  }
  // Only points that both axes can show count.
  Axis other;
  other.log = vertical ? chart.log_x : chart.log_y;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto see = [&](double v) {
    if (axis.shows(v)) low = std::min(low, v), high = std::max(high, v);
  };
  for (const SeriesPicture& s : chart.series) {
    if (!vertical && s.y.empty()) std::for_each(s.x.begin(), s.x.end(), see);  // in the strip
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      if (!other.shows(vertical ? s.x[i] : s.y[i])) continue;
      see(vertical ? s.y[i] : s.x[i]);
      if (vertical && !s.low.empty()) see(s.low[i]), see(s.high[i]);
      if (!vertical && !s.x_low.empty()) see(s.x_low[i]), see(s.x_high[i]);
    }
  }
  if (low > high) {
    axis.low = axis.log ? 1 : 0, axis.high = axis.log ? 10 : 1;
    return axis;
  }
  if (axis.log) {
    Wide a = low, b = high;
    if (b / a < 1.5) a /= 1.5, b *= 1.5;
    const Wide margin = std::pow(b / a, Wide{0.06});
    axis.low = held(a / margin, least_positive), axis.high = held(b * margin);
    return axis;
  }
  const Wide range = Wide{high} - low;
  if (range <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const Wide half = low == 0 ? 1 : 0.5 * std::abs(Wide{low});
    axis.low = held(low - half), axis.high = held(high + half);
    return axis;
  }
  const Wide margin = 0.05 * range;
  // An axis that nearly reaches zero starts there.
  axis.low = low >= 0 && low < 0.25 * high ? 0 : held(low - margin);
  axis.high = high <= 0 && high > 0.25 * low ? 0 : held(high + margin);
  return axis;
}

std::vector<std::vector<Point>> curves(const SeriesPicture& s, const Axis& x, const Axis& y) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < s.y.size(); ++i) {
    if (x.shows(s.x[i]) && y.shows(s.y[i]))
      out.back().push_back({x.pixel(s.x[i]), y.pixel(s.y[i])});
    else if (!out.back().empty())
      out.emplace_back();
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

void Occupied::add(const std::vector<Point>& curve, const Box& inside) {
  constexpr double spacing = 4;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (inside.holds(curve[i])) points_.push_back(curve[i]);
    if (i + 1 == curve.size()) break;
    const Point p = curve[i], q = curve[i + 1];
    const int n = static_cast<int>(std::min(2000.0, std::hypot(q.x - p.x, q.y - p.y) / spacing));
    for (int k = 1; k <= n; ++k) {
      const double t = static_cast<double>(k) / (n + 1);
      const Point between{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
      if (inside.holds(between)) points_.push_back(between);
    }
  }
}

void Occupied::add(const Box& box) {
  const int nx = 1 + static_cast<int>(box.width() / 6), ny = 1 + static_cast<int>(box.height() / 6);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) points_.push_back({box.left + box.width() * i / nx, box.bottom + box.height() * j / ny});
}

int Occupied::within(const Box& box) const {
  return static_cast<int>(std::count_if(points_.begin(), points_.end(), [&](Point p) { return box.holds(p); }));
}

double Occupied::distance(const Box& box) const {
  double least = 1e9;
  for (const Point& p : points_) {
    const double dx = std::max({box.left - p.x, 0.0, p.x - box.right});
    const double dy = std::max({box.bottom - p.y, 0.0, p.y - box.top});
    least = std::min(least, std::hypot(dx, dy));
  }
  return least;
}

std::optional<Point> free_place(const Occupied& occupied, const Box& room, double width, double height, double margin) {
  if (width + 2 * margin > 0.7 * room.width() || height + 2 * margin > 0.8 * room.height()) return std::nullopt;
  const double left = room.left + margin, right = room.right - margin - width, centre = (left + right) / 2;
  const double bottom = room.bottom + margin, top = room.top - margin - height, middle = (bottom + top) / 2;
  for (const Point p : {Point{right, top}, {left, top}, {left, bottom}, {right, bottom}, {right, middle}, {left, middle}, {centre, top}, {centre, bottom}})
    if (occupied.within({p.x - margin, p.y - margin, p.x + width + margin, p.y + height + margin}) == 0) return p;
  return std::nullopt;
}

std::optional<Point> near_place(const Occupied& occupied, const Occupied& to, const Box& room, double width, double height, double margin) {
  constexpr int steps = 40;
  const double x = room.width() - width - 2 * margin, y = room.height() - height - 2 * margin;
  if (x < 0 || y < 0) return std::nullopt;
  std::optional<Point> place;
  double best = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Point p{room.left + margin + x * i / steps, room.bottom + margin + y * j / steps};
      const Box block{p.x, p.y, p.x + width, p.y + height};
      if (occupied.distance(block) < margin) continue;
      const double cost = to.distance(block) + 0.02 * (p.y - room.bottom);
      if (!place || cost < best) best = cost, place = p;
    }
  return place;
}

const std::vector<Point>* nearest_slope(const std::vector<std::vector<Point>>& curves, double slope) {
  const std::vector<Point>* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& curve : curves) {
    if (curve.size() < 2 || curve.back().x == curve.front().x) continue;
    // Between angles: steep slopes differ little.
    const double off = std::abs(std::atan((curve.back().y - curve.front().y) / (curve.back().x - curve.front().x)) - std::atan(slope));
    if (off < least - 1e-9) least = off, best = &curve;
  }
  return best;
}

std::optional<Point> place_beside(const Occupied& occupied, const Box& room, Point at, double width, double height, double margin) {
  constexpr int rings = 80, angles = 32;
  for (int ring = 0; ring <= rings; ++ring)
    for (int k = 0; k < (ring == 0 ? 1 : angles); ++k) {
      // From above in both senses.
      const double angle = 0.5 * std::numbers::pi + (k % 2 ? 1 : -1) * std::numbers::pi * ((k + 1) / 2) / (0.5 * angles);
      const Point middle{at.x + 0.3 * ring * height * std::cos(angle), at.y + 0.3 * ring * height * std::sin(angle)};
      const Box box{middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
      const bool inside = box.left >= room.left + margin && box.right <= room.right - margin && box.bottom >= room.bottom + margin && box.top <= room.top - margin;
      if (inside && occupied.distance(box) >= margin) return middle;
    }
  return std::nullopt;
}

}  // namespace dotyk::figure

#include "figure/chart/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotyk::figure {

namespace {

constexpr double least_positive = std::numeric_limits<double>::denorm_min();

// The nearest that a double can be.
double held(Wide value, double least = std::numeric_limits<double>::lowest()) {
  return static_cast<double>(std::clamp(value, Wide{least}, Wide{std::numeric_limits<double>::max()}));
}

}  // namespace

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

std::vector<std::vector<Point>> curves(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (axes.x.shows(x[i]) && axes.y.shows(y[i]))
      out.back().push_back(axes.at(x[i], y[i]));
    else if (!out.back().empty())
      out.emplace_back();
  }
  if (out.back().empty()) out.pop_back();
  return out;
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

}  // namespace dotyk::figure

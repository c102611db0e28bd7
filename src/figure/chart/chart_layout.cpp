// Ranges of axes, curves and guides of slopes.
#include "figure/chart/chart.hpp"

#include <iterator>
#include <limits>

#include "figure/chart/chart_series.hpp"

namespace dotyk::figure {

namespace {

constexpr double least_positive = std::numeric_limits<double>::denorm_min();

// The nearest that a double can be.
double held(Wide value, double least = std::numeric_limits<double>::lowest()) {
  return static_cast<double>(std::clamp(value, Wide{least}, Wide{std::numeric_limits<double>::max()}));
}

// A stretch of a curve: the relative difference of its slope from that of a guide, and the points of its middle half.
struct Stretch {
  double off = 0;
  std::vector<Point> middle;
};

// The stretches of a curve, one from each of its points on, that are as long as the way; all of a curve that is shorter.
std::vector<Stretch> stretches(const std::vector<Point>& points, Point way) {
  std::vector<Stretch> out;
  const double least = std::min(length(way), length(points.back() - points.front()));
  for (std::size_t i = 0, j = 0; i < points.size(); ++i) {
    while (j + 1 < points.size() && length(points[j] - points[i]) < least) ++j;
    const Point along = points[j] - points[i];
    if (length(along) < least || along.x == 0) break;
    const double off = std::abs(along.y * way.x - along.x * way.y) / (std::abs(along.x) * std::max(std::abs(way.y), 0.1 * way.x));
    const auto middle = std::span(points).subspan(i + (j - i) / 4, 1 + (j - i) / 2);
    out.push_back({off, {middle.begin(), middle.end()}});
  }
  return out;
}

// Points of curves whose slope in pixels is on the mean about that of `way`, or nearest to it, where it is most like it.
Occupied like(const ChartPicture& picture, Point way, const Axes& axes) {
  constexpr double kAbout = 0.12, kWorse = 1.2;
  std::vector<std::vector<Stretch>> all;  // of each series
  for (const SeriesPicture& s : picture.series) {
    std::vector<Stretch>& own = all.emplace_back();
    for (const auto& curve : curves(s.x, s.y, axes))
      for (const std::vector<Point>& points : sampled(curve, axes.room)) std::ranges::move(stretches(points, way), std::back_inserter(own));
    if (own.empty() || s.reference || s.right) all.pop_back();
  }
  const auto least = [](const auto& things, const auto& off) { return off(*std::ranges::min_element(things, {}, off)); };
  const auto off = [](const Stretch& stretch) { return stretch.off; };
  const auto mean = [](const std::vector<Stretch>& own) {
    double sum = 0;
    for (const Stretch& stretch : own) sum += stretch.off;
    return sum / static_cast<double>(own.size());
  };
  Occupied out;
  for (const std::vector<Stretch>& own : all)
    if (mean(own) <= std::max(kAbout, kWorse * least(all, mean)))
      for (const Stretch& stretch : own)
        if (stretch.off <= std::max(kAbout, kWorse * least(own, off))) out.add(stretch.middle, axes.room);
  return out;
}

// Of an axis whose range does not depend on the curves.
std::optional<std::array<double, 2>> fixed_range(const ChartPicture& chart, Side side) {
  const bool x = side == Side::below;
  if (x && chart.polar) return std::array{0.0, 360.0};
  if (x && !chart.categories.empty()) return std::array{0.5, static_cast<double>(chart.categories.size()) + 0.5};
  if (chart.map && side != Side::right) {
    if (chart.polar) return std::array{0.0, polar_borders(chart.map->y, false).back()};
    const std::vector<double> borders = cell_borders(x ? chart.map->x : chart.map->y, x ? chart.log_x : chart.log_y);
    return std::array{borders.front(), borders.back()};
  }
  return x ? chart.x_range : side == Side::left ? chart.y_range : std::nullopt;
}

// Where the way from p to q, in numbers, bends in pixels.
void add_bends(std::vector<Point>& out, const Axes& axes, Point p, Point q) {
  constexpr double kStep = 2;  // degrees
  if (axes.pole) {
    const int n = static_cast<int>(std::min(1e4, std::ceil(std::abs(q.x - p.x) / kStep)));
    for (int k = 1; k < n; ++k) out.push_back(axes.at(p.x + (q.x - p.x) * k / n, p.y + (q.y - p.y) * k / n));
  }
  if (!axes.y.left_out) return;
  const double across[] = {axes.x.pixel(p.x), axes.x.pixel(q.x)};
  std::array edges{axes.y.left_out->from, axes.y.left_out->to};
  if (p.y > q.y) std::swap(edges[0], edges[1]);
  for (const double edge : edges)
    if ((edge - p.y) * (edge - q.y) < 0) out.push_back({across[0] + (across[1] - across[0]) * ((edge - p.y) / (q.y - p.y)), axes.y.pixel(edge)});
}

}  // namespace

Axis fit_axis(const ChartPicture& chart, Side side) {
  const bool vertical = side != Side::below;
  Axis axis;
  axis.log = vertical ? chart.log_y : chart.log_x;
  if (const auto given = fixed_range(chart, side)) {
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
    if (vertical && s.right != (side == Side::right)) continue;
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
  if (chart.polar) {
    constexpr double kBeyond = 1.08;  // of the greatest radius
    axis.low = 0, axis.high = high > 0 ? kBeyond * high : 1;
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

std::vector<std::vector<Point>> runs(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes) {
  return pieces(y.size(), [&](std::size_t i) { return axes.x.shows(x[i]) && axes.y.shows(y[i]) ? std::optional(Point{x[i], y[i]}) : std::nullopt; });
}

std::vector<std::vector<Point>> curves(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes) {
  std::vector<std::vector<Point>> out;
  for (const std::vector<Point>& run : runs(x, y, axes)) {
    std::vector<Point>& curve = out.emplace_back();
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (i > 0) add_bends(curve, axes, run[i - 1], run[i]);
      curve.push_back(axes.at(run[i].x, run[i].y));
    }
  }
  return out;
}

void draw_guide(Canvas& canvas, const ChartPicture& picture, const SlopeGuide& guide, const Axes& axes, Occupied& occupied) {
  const double ratio = steepness(axes.x, axes.y, guide.slope), steep = std::abs(ratio), em = axes.em, size = small_text * em, pad = 0.35 * em;
  const bool plain = guide.label.empty(), rises = ratio >= 0;
  const std::string label = plain ? number(guide.slope) : guide.label;
  const Point extent = text_extent(label, size);
  const double wide = axes.room.width(), high = axes.room.height();
  // Higher than a letter where there is room, though the slope is slight.
  const double full = std::max(std::min(0.16 * wide, 0.26 * high / steep), std::min(0.35 * wide, 1.2 * em / steep));
  // A small guide beside its curve, even without the 1 at its level side, is better than a large one elsewhere.
  constexpr double kNear = 2.5, kFar = INFINITY;  // em
  for (const auto& [share, one, farthest] : {std::tuple{1.0, true, kNear}, {0.7, true, kNear}, {0.45, true, kNear}, {0.7, false, kNear}, {0.45, false, kNear}, {0.3, false, kNear}, {0.45, true, kFar}, {0.3, false, kFar}}) {
    // With room for the labels on the right, and on the level side: below where the line rises, else above.
    const double run = share * full, up = steep * run, level = plain && one ? 1.2 * em : pad, width = run + extent.x + 2 * pad, height = std::max(up, extent.y) + level + pad;
    const Occupied own = like(picture, {run, ratio * run}, axes);
    const std::optional<Point> place = near_place(occupied, own, axes.room, {width, height}, (one ? 0.5 : 0.3) * em);
    if (!place || own.distance({place->x, place->y, place->x + width, place->y + height}) > farthest * em) continue;
    const Point at = *place;
    occupied.add(Box{at.x, at.y, at.x + width, at.y + height});
    const double low = at.y + (rises ? level : pad);
    const Point a{at.x, rises ? low : low + up}, b{at.x + run, rises ? low + up : low};
    const std::array<Point, 3> triangle{a, Point{b.x, a.y}, b};
    canvas.convex(triangle, {235, 235, 235});
    canvas.polyline(triangle, std::max(1.2, em / 16), reference_grey, {}, true);
    canvas.tell({"slope guide", {axes.values(triangle[0]), axes.values(triangle[1]), axes.values(triangle[2])}});
    canvas.text({b.x + pad, low + up / 2}, label, {.size = size, .up = Align::middle, .colour = reference_grey});
    if (plain && one)
      canvas.text({at.x + run / 2, rises ? low - 0.15 * em : a.y + 0.1 * em}, "1",
                  {.size = size, .across = Align::middle, .up = rises ? Align::high : Align::low, .colour = reference_grey});
    return;
  }
}

}  // namespace dotyk::figure

#include "figure/chart/chart.hpp"

#include <iterator>

#include "figure/canvas/colour_map.hpp"

namespace dotyk::figure {

namespace {

constexpr double bar_gap = 0.8;  // em

// In grey each is as far from the others as can be: 231, 124, 80, 198, 156 and 35 of 255.
constexpr std::array<Colour, most_map_names> name_colours{{{214, 236, 248}, {214, 96, 30}, {20, 95, 160}, {246, 200, 60}, {90, 190, 150}, {70, 10, 70}}};
constexpr Colour cross_grey{150, 150, 150}, empty_cell{255, 255, 255};

ColourScale scale_of(const ChartMap& map) {
  Seen values;
  for (const double v : map.values) values.add(v);
  ColourScale scale;
  scale.shown = map.names.empty() && values.least <= values.greatest;
  if (!scale.shown) return scale;
  scale.low = scale.least = values.least, scale.high = scale.greatest = values.greatest;
  if (map.range) {
    scale.low = (*map.range)[0], scale.high = (*map.range)[1];
  } else {
    std::vector<double> finite;
    std::ranges::copy_if(map.values, std::back_inserter(finite), [](double v) { return std::isfinite(v); });
    leave_out_peaks(scale, std::move(finite));
  }
  scale.diverging = scale.low < 0 && scale.high > 0;
  if (scale.low == scale.high) scale.low -= 0.5, scale.high += 0.5;
  return scale;
}

void cross(Canvas& canvas, const std::array<Point, 4>& corners, double em) {
  for (const int k : {0, 1}) canvas.line(corners[k], corners[k + 2], std::max(1.0, em / 22), cross_grey);
}

// The ring from one angle and radius to others.
std::vector<Point> sector(const Axes& axes, const Box& cell) {
  constexpr double kStep = 3;  // degrees
  const int n = std::max(1, static_cast<int>(std::ceil(cell.width() / kStep)));
  std::vector<Point> out;
  for (int k = 0; k <= n; ++k) out.push_back(axes.at(cell.left + cell.width() * k / n, cell.top));
  for (int k = n; k >= 0; --k) out.push_back(axes.at(cell.left + cell.width() * k / n, cell.bottom));
  return out;
}

// Reaches under the cells that follow, so that no light line stays between.
void fill(Canvas& canvas, const Axes& axes, const Box& cell, Colour colour) {
  constexpr double kUnder = 0.7;  // pixels
  if (axes.pole) {
    const double outer = std::max(1.0, axes.y.pixel(cell.top));
    return canvas.convex(sector(axes, {cell.left, cell.bottom, cell.right + 60 * kUnder / outer, cell.top * (1 + kUnder / outer)}), colour);
  }
  const Point low = axes.at(cell.left, cell.bottom), high = axes.at(cell.right, cell.top);
  canvas.box({low.x, low.y, high.x + kUnder, high.y + kUnder}, colour);
}

}  // namespace

std::vector<double> cell_borders(const std::vector<double>& at, bool log) {
  const std::size_t n = at.size();
  const auto place = [&](std::size_t i) { return log ? std::log10(at[i]) : at[i]; };
  std::vector<double> out;
  for (std::size_t i = 0; i <= n; ++i) {
    // Half the way between the two nearest.
    const std::size_t next = std::clamp<std::size_t>(i, 1, std::max<std::size_t>(n, 2) - 1);
    const double half = n == 1 ? 0.5 : (place(next) - place(next - 1)) / 2;
    out.push_back(i == 0 ? place(0) - half : place(i - 1) + half);
  }
  if (log)
    for (double& border : out) border = std::pow(10, border);
  return out;
}

std::vector<double> polar_borders(const std::vector<double>& at, bool angles) {
  constexpr double kCircle = 360;
  std::vector<double> out = cell_borders(at, false);
  const double gap = kCircle - (at.back() - at.front()), first = out[1] - out[0], last = out.back() - out[out.size() - 2];
  if (at.size() > 1 && !(angles && gap > 0 && gap < 0.75 * (first + last))) out.front() = at.front(), out.back() = at.back();
  if (!angles) out.front() = std::max(0.0, out.front());
  return out;
}

Ticks map_ticks(const std::vector<double>& at, double most) {
  Ticks out;
  int every = 1;
  for (int k = 0; static_cast<double>(at.size()) / every > std::max(1.0, most); ++k) every = std::array{2, 5, 10}[k % 3] * static_cast<int>(std::pow(10, k / 3));
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] != std::floor(at[i]) || (i > 0 && at[i] != at[i - 1] + 1)) return {};
    out.ticks.push_back({at[i], std::fmod(at[i], every) == 0 ? number(at[i]) : ""});
  }
  return out;
}

void draw_map(Canvas& canvas, const ChartMap& map, const Axes& axes) {
  const ColourScale scale = scale_of(map);
  const std::vector<double> x = axes.pole ? polar_borders(map.x, true) : cell_borders(map.x, axes.x.log);
  const std::vector<double> y = axes.pole ? polar_borders(map.y, false) : cell_borders(map.y, axes.y.log);
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      const double value = map.values[j * map.x.size() + i];
      const Box cell{x[i], y[j], x[i + 1], y[j + 1]};
      fill(canvas, axes, cell, std::isnan(value) ? empty_cell : map.names.empty() ? scale.at(value) : name_colours[static_cast<std::size_t>(value) - 1]);
    }
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      if (std::isnan(map.values[j * map.x.size() + i]))
        cross(canvas, {axes.at(x[i], y[j]), axes.at(x[i + 1], y[j]), axes.at(x[i + 1], y[j + 1]), axes.at(x[i], y[j + 1])}, axes.em);
}

std::vector<LegendEntry> map_legend(const ChartMap& map) {
  const auto cell = [](Colour colour, bool crossed) {
    return [colour, crossed](Canvas& canvas, const Box& b) {
      const double high = b.height() / 3;
      const Box box = Box::about(b.centre(), {2.4 * high, 1.6 * high});
      canvas.box(box, colour);
      if (crossed) cross(canvas, box.corners(), b.height());
      canvas.outline(box, std::max(1.0, high / 10), cross_grey);
    };
  };
  constexpr double kCell = 1.2;  // em
  std::vector<LegendEntry> out;
  for (std::size_t k = 0; k < map.names.size(); ++k) out.push_back({map.names[k], cell(name_colours[k], false), kCell});
  if (std::ranges::any_of(map.values, [](double v) { return std::isnan(v); })) out.push_back({"not applicable", cell(empty_cell, true), kCell});
  return out;
}

double map_bar_width(const ChartMap& map, double em) {
  const double width = colour_bar_width(scale_of(map), {map.label, map.unit}, em);
  return width > 0 ? width + bar_gap * em : 0;
}

void draw_map_bar(Canvas& canvas, const ChartMap& map, const Axes& axes, double left, double width) {
  if (map_bar_width(map, axes.em) == 0) return;
  draw_colour_bar(canvas, scale_of(map), {map.label, map.unit}, axes.em, {left + bar_gap * axes.em, axes.room.bottom, width - 0.3 * axes.em, axes.room.top});
}

}  // namespace dotyk::figure

// Charts one below the other, and guides beside the curves whose slope they have.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

bool dark(Colour c) { return c.r < 150 && c.g < 150 && c.b < 150; }

SeriesPicture line(std::vector<double> x, std::vector<double> y) {
  SeriesPicture s;
  s.x = std::move(x), s.y = std::move(y);
  s.style = SeriesStyle::line;
  return s;
}

ChartPicture panel(const SeriesPicture& s) {
  ChartPicture chart;
  chart.series = {s};
  return chart;
}

// Of the panels, from above: unbroken dark lines over more than half of the picture, in pairs.
std::vector<Frame> frames_of(const Pixels& p) {
  std::vector<Frame> lines;
  for (int y = 0; y < p.height; ++y) {
    int from = -1;
    for (int x = 0; x <= p.width; ++x) {
      if (x < p.width && dark(p.at(x, y))) {
        if (from < 0) from = x;
        continue;
      }
      const bool is_line = from >= 0 && x - from > p.width / 2;
      if (is_line && !lines.empty() && lines.back().bottom == y - 1) lines.back().bottom = y;
      else if (is_line) lines.push_back({from, x - 1, y, y});
      from = -1;
    }
  }
  std::vector<Frame> out;
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) out.push_back({lines[i].left, lines[i].right, lines[i].top, lines[i + 1].bottom});
  return out;
}

}  // namespace

TEST_CASE("panels that share an axis stand below each other, each curve at its numbers") {
  ChartColumn column;
  column.file = "column.png", column.width = 800, column.height = 600, column.title = "Three";
  column.shared_x = true;
  column.panels = {panel(line({0, 10}, {0, 1})), panel(line({0, 5}, {-1000, 1000})), panel(line({5, 10}, {1e-3, 1e3}))};
  column.panels[0].y_range = {0, 1}, column.panels[1].y_range = {-1000, 1000}, column.panels[2].y_range = {1e-3, 1e3};
  column.panels[2].log_y = true;
  for (ChartPicture& c : column.panels) c.x_label = "time", c.y_label = "value";
  draw(column);
  const Pixels p = read_png("column.png");
  CHECK(white_rim(p));
  const auto frames = frames_of(p);
  REQUIRE(frames.size() == 3);
  for (const Frame& f : frames) {
    CHECK(f.left == frames[0].left);
    CHECK(f.right == frames[0].right);
    CHECK(std::abs((f.bottom - f.top) - (frames[0].bottom - frames[0].top)) <= 8);
  }
  // The common axis runs from 0 to 10 with a margin of a twentieth where it does not begin at zero.
  for (double t = 0.15; t < 0.9; t += 0.1) {
    const double x = 10 * t / 10.5;
    CHECK(drawn_at(p, frames[0], x, t, series_colour(0)));
    CHECK(drawn_at(p, frames[1], x / 2, t, series_colour(0)));
    CHECK(drawn_at(p, frames[2], (5 + 5 * t) / 10.5, t, series_colour(0)));
  }
  column.shared_x = false;
  draw(column);
  CHECK(frames_of(read_png("column.png")).size() == 3);
}

TEST_CASE("columns that cannot be drawn are refused, any size is drawn") {
  ChartColumn column;
  column.file = "column.png";
  CHECK(message_of([&] { draw(column); }).find("no panels") != std::string::npos);
  column.panels = {panel(line({1, 10}, {1, 10})), panel(line({1, 10}, {1, 10}))};
  column.panels[1].log_x = true, column.shared_x = true;
  CHECK(message_of([&] { draw(column); }).find("share the x axis") != std::string::npos);
  column.panels[1].log_x = false, column.panels[1].series[0].y.pop_back();
  CHECK(message_of([&] { draw(column); }).find("2 x for 1 y") != std::string::npos);
  column.panels = std::vector<ChartPicture>(12, panel(line({1, 10}, {1, 10})));
  for (const auto& [width, height] : {std::pair{160, 160}, {400, 1200}, {1200, 300}}) {
    column.width = width, column.height = height;
    CHECK(message_of([&] { draw(column); }) == "");
  }
}

TEST_CASE("runs without an ordinate stand in a strip above the plot, a row for each series, and leave the y axis as it is") {
  ChartPicture chart = panel(line({1, 10, 100}, {0.2, 0.5, 0.8}));
  chart.file = "failed.png", chart.width = 600, chart.height = 450;
  chart.log_x = true;
  chart.x_range = {1, 1e4}, chart.y_range = {0, 1};
  draw(chart);
  REQUIRE(frames_of(read_png("failed.png")).size() == 1);
  SeriesPicture failed;
  failed.x = {1e3}, failed.twin = failed.crossed = true, failed.style = SeriesStyle::points;
  chart.series.push_back(failed);
  chart.series.push_back(failed);
  chart.series.back().x = {10, 1e3};
  draw(chart);
  const Pixels p = read_png("failed.png");
  const auto frames = frames_of(p);
  REQUIRE(frames.size() == 2);
  const Frame strip = frames[0], plot = frames[1];
  CHECK(strip.bottom < plot.top - 3);
  CHECK(std::abs(strip.left - plot.left) <= 2);  // the marks of the break adjoin
  CHECK(std::abs(strip.right - plot.right) <= 2);
  const auto pale = [&](double x, double y) {  // crossed markers are a third of their colour
    const Colour blue = series_colour(0);
    const int px = static_cast<int>(std::lround(strip.left + x * (strip.right - strip.left))), py = static_cast<int>(std::lround(strip.bottom - y * (strip.bottom - strip.top)));
    int n = 0;
    for (int dy = -4; dy <= 4; ++dy)
      for (int dx = -4; dx <= 4; ++dx) {
        const Colour c = p.at(px + dx, py + dy);
        n += c.b > c.r + 20 && c.r > blue.r + 40;
      }
    return n > 5;
  };
  CHECK(pale(0.75, 0.25));
  CHECK(pale(0.75, 0.75));
  CHECK(pale(0.25, 0.75));
  CHECK_FALSE(pale(0.25, 0.25));
  CHECK_FALSE(pale(0.5, 0.5));
  CHECK(drawn_at(p, plot, 0.25, 0.5, series_colour(0)));
  CHECK(drawn_at(p, plot, 0.5, 0.8, series_colour(0)));

  // The x axis holds them where no range is given.
  chart.x_range.reset();
  chart.series[2].x = {1e9};
  CHECK(message_of([&] { draw(chart); }) == "");
  chart.series[2].crossed = false;
  CHECK(message_of([&] { draw(chart); }).find("1 x for 0 y") != std::string::npos);
}

TEST_CASE("panels in two columns follow row by row") {
  ChartColumn column;
  column.file = "grid.png", column.width = 800, column.height = 600, column.columns = 2;
  column.panels = std::vector<ChartPicture>(3, panel(line({0, 1}, {0, 1})));
  for (std::size_t k = 0; k < 3; ++k) column.panels[k].series[0].status = static_cast<Status>(k);
  draw(column);
  const Pixels p = read_png("grid.png");
  CHECK(white_rim(p));
  for (std::size_t k = 0; k < 3; ++k) {
    int inside = 0, all = 0;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        if (p.at(x, y) == status_colour(static_cast<Status>(k))) {
          ++all;
          inside += (x >= 400) == (k == 1) && (y >= 300) == (k == 2);
        }
    CHECK(all > 200);
    CHECK(inside == all);
  }
  column.columns = 4;
  CHECK(message_of([&] { draw(column); }) == "3 panels in 4 columns");
}

TEST_CASE("a guide stands beside the curve whose slope it has") {
  for (const double slope : {1.0, 2.0}) {
    ChartPicture chart = panel(line({1e-2, 1}, {1e-2, 1}));
    chart.series.push_back(line({1e-2, 1}, {1e-8, 1e-4}));
    chart.file = "guide.png", chart.width = 700, chart.height = 560;
    chart.log_x = chart.log_y = true, chart.x_range = {1e-2, 1}, chart.y_range = {1e-9, 10};
    chart.slopes = {{slope, ""}};
    draw(chart);
    const Pixels p = read_png("guide.png");
    // Its filled inside, in the plane of log10 x and log10 y.
    const auto frames = frames_of(p);
    REQUIRE(frames.size() == 1);
    const Frame f = frames[0];
    double x = 0, y = 0;
    int n = 0;
    for (int j = f.top + 2; j < f.bottom - 2; ++j)
      for (int i = f.left + 2; i < f.right - 2; ++i)
        if (p.at(i, j).r == 235 && p.at(i, j).g == 235 && p.at(i + 1, j).r == 235 && p.at(i, j + 1).r == 235) x += i, y += j, ++n;
    REQUIRE(n > 100);
    const double lx = -2 + 2 * (x / n - f.left) / (f.right - f.left), ly = -9 + 10 * (f.bottom - y / n) / (f.bottom - f.top);
    const double first = std::abs(ly - lx), second = std::abs(ly - (2 * lx - 4));
    CHECK((slope == 1 ? first < second : second < first));
  }
}

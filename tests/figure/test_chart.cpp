// Charts: curves pass where the numbers say, on logarithmic axes too.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

// The frame of the plot: the longest dark row and column of pixels.
Frame frame_of(const Pixels& p) {
  std::vector<int> rows, columns;
  const auto dark = [&](int x, int y) { const Colour c = p.at(x, y); return c.r < 150 && c.g < 150 && c.b < 150; };
  for (int y = 0; y < p.height; ++y) {
    int n = 0;
    for (int x = 0; x < p.width; ++x) n += dark(x, y);
    if (n > p.width / 2) rows.push_back(y);
  }
  for (int x = 0; x < p.width; ++x) {
    int n = 0;
    for (int y = 0; y < p.height; ++y) n += dark(x, y);
    if (n > p.height / 2) columns.push_back(x);
  }
  REQUIRE(rows.size() >= 2);
  REQUIRE(columns.size() >= 2);
  return {columns.front(), columns.back(), rows.front(), rows.back()};
}

ChartPicture chart_of(const std::string& file, const std::vector<double>& x, const std::vector<double>& y) {
  ChartPicture chart;
  chart.file = file;
  chart.width = 600, chart.height = 450;
  SeriesPicture s;
  s.x = x, s.y = y;
  s.style = SeriesStyle::line;
  chart.series = {s};
  return chart;
}

// Grid lines from left to right in a row without curve or text.
int grid_columns(const Pixels& p, const Frame& f, int row) {
  int n = 0;
  for (int x = f.left + 3; x < f.right - 2; ++x) n += p.at(x, row).r < 240 && p.at(x - 1, row).r >= 240;
  return n;
}

}  // namespace

TEST_CASE("on logarithmic axes a power is a straight line at the right place") {
  ChartPicture chart = chart_of("log.png", {1e-3, 1e-2, 1e-1, 1, 10}, {1e-6, 1e-4, 1e-2, 1, 100});
  chart.log_x = chart.log_y = true;
  chart.x_range = {1e-4, 1e2};
  chart.y_range = {1e-8, 1e4};
  draw(chart);
  const Pixels p = read_png("log.png");
  CHECK(white_rim(p));
  const Frame f = frame_of(p);
  const Colour blue = series_colour(0);
  for (double decade = -2.9; decade < 1; decade += 0.2) CHECK(drawn_at(p, f, (decade + 4) / 6, (2 * decade + 8) / 12, blue));
  // Where a linear axis would have it, and beyond its ends, there is none.
  CHECK_FALSE(drawn_at(p, f, 0.5, 0.25, blue));
  CHECK_FALSE(drawn_at(p, f, 1.5 / 6, 0.6, blue));
  CHECK_FALSE(drawn_at(p, f, 0.5 / 6, 1.0 / 12, blue));
}

TEST_CASE("one axis may be logarithmic and the other not") {
  ChartPicture chart = chart_of("semilog.png", {0, 1, 2, 3, 4}, {1, 1e-1, 1e-2, 1e-3, 1e-4});
  chart.log_y = true;
  chart.x_range = {0, 5};
  chart.y_range = {1e-5, 1};
  draw(chart);
  const Pixels p = read_png("semilog.png");
  const Frame f = frame_of(p);
  for (double x = 0.3; x < 4; x += 0.5) CHECK(drawn_at(p, f, x / 5, 1 - x / 5, series_colour(0)));
}

TEST_CASE("linear axes") {
  ChartPicture chart = chart_of("linear.png", {0, 10}, {-5, 5});
  chart.x_range = {0, 10};
  chart.y_range = {-10, 10};
  draw(chart);
  const Pixels p = read_png("linear.png");
  const Frame f = frame_of(p);
  for (double t = 0.1; t < 1; t += 0.1) CHECK(drawn_at(p, f, t, 0.25 + 0.5 * t, series_colour(0)));
}

TEST_CASE("points that cannot be shown are gaps") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChartPicture chart = chart_of("gaps.png", {1, 2, 3, 4, 5}, {1, 1, nan, 1, 1});
  chart.x_range = {0, 6};
  chart.y_range = {0, 2};
  draw(chart);
  const Pixels p = read_png("gaps.png");
  const Frame f = frame_of(p);
  CHECK(drawn_at(p, f, 1.5 / 6, 0.5, series_colour(0)));
  CHECK_FALSE(drawn_at(p, f, 3.0 / 6, 0.5, series_colour(0)));
  CHECK(drawn_at(p, f, 4.5 / 6, 0.5, series_colour(0)));
  chart.series[0].y = {1, 0.1, 0, -1, 0.01};
  chart.log_y = true;
  chart.y_range.reset();
  CHECK(message_of([&] { draw(chart); }) == "");
}

TEST_CASE("curves far beyond the axes cost nothing and stay outside") {
  ChartPicture chart = chart_of("far.png", {-1e12, 1e12}, {-1e12, 1e12});
  chart.series[0].reference = true;
  SeriesPicture close;
  close.x = {0, 1}, close.y = {1, 0};
  chart.series.push_back(close);
  chart.x_range = chart.y_range = {0, 1};
  draw(chart);
  const Pixels p = read_png("far.png");
  const Frame f = frame_of(p);
  CHECK(white_rim(p));
  CHECK(drawn_at(p, f, 0.3, 0.7, series_colour(0)));
  chart.x_range = {1e15, 1e15 + 1};
  CHECK(message_of([&] { draw(chart); }) == "");
}

TEST_CASE("numbers next to nothing and near the greatest are drawn where they belong") {
  const double least = 5e-324, greatest = std::numeric_limits<double>::max();
  const auto drawn = [](const ChartPicture& chart) {
    draw(chart);
    return read_png("extreme.png");
  };
  ChartPicture chart = chart_of("extreme.png", {1, 2}, {least, 1e-310});
  chart.x_range = {0, 3};
  chart.slopes = {{1, ""}, {-1e9, ""}};
  Pixels p = drawn(chart);  // from 0 to 1.05e-310
  Frame f = frame_of(p);
  CHECK(drawn_at(p, f, 1.5 / 3, 0.5 / 1.05, series_colour(0)));
  chart.log_y = true;  // no room for a margin below: 13.3 decades and 0.06 of them above
  p = drawn(chart), f = frame_of(p);
  CHECK(drawn_at(p, f, 1.5 / 3, 0.5 / 1.06, series_colour(0)));

  // 500 decades, and the same margin at both ends.
  chart = chart_of("extreme.png", {1e-250, 1, 1e250}, {1e-10, 1, 1e10});
  chart.log_x = chart.log_y = true;
  p = drawn(chart), f = frame_of(p);
  CHECK(drawn_at(p, f, 0.25, 0.25, series_colour(0)));
  CHECK(drawn_at(p, f, 0.9, 0.9, series_colour(0)));
  const int columns = grid_columns(p, f, f.bottom - (f.bottom - f.top) / 100 - 14);
  CHECK(columns >= 4);
  CHECK(columns <= 14);

  chart = chart_of("extreme.png", {-greatest, greatest}, {-greatest, greatest});
  p = drawn(chart), f = frame_of(p);
  CHECK(drawn_at(p, f, 0.25, 0.25, series_colour(0)));

  for (const bool log : {false, true})
    for (const auto& [low, high] : {std::array{least, least}, {least, 2 * least}, {1e-300, 1e-300}, {least, greatest}, {1e-300, 1e300}, {greatest, greatest}, {1.0, std::nextafter(1.0, 2.0)}, {1e308, greatest}}) {
      chart = chart_of("extreme.png", {low, high}, {low, high});
      chart.series[0].style = SeriesStyle::both;
      chart.series[0].low = {0, low}, chart.series[0].high = chart.series[0].y;
      chart.log_x = chart.log_y = log;
      chart.slopes = {{1, ""}};
      CHECK(drawn(chart).count(series_colour(0), 6) > 20);
      if (low < high) chart.x_range = chart.y_range = {low, high};
      CHECK(drawn(chart).count(series_colour(0), 6) > 20);
    }
}

TEST_CASE("each series has its colour; the legend does not hide a curve") {
  ChartPicture chart = chart_of("series.png", {}, {});
  chart.series.clear();
  for (int k = 0; k < 7; ++k) {
    SeriesPicture s;
    s.name = "method " + std::to_string(k);
    for (int i = 0; i <= 10; ++i) s.x.push_back(i), s.y.push_back(k + 0.1 * i * (k % 2 ? 1 : -1));
    chart.series.push_back(s);
  }
  chart.slopes = {{1, ""}, {-2, "−2"}};
  draw(chart);
  const Pixels p = read_png("series.png");
  for (int k = 0; k < 7; ++k) CHECK(p.count(series_colour(k), 6) > 150);
}

TEST_CASE("texts too long for their places are broken and shortened, not cut off; names in legends are refused") {
  const auto often = [](const std::string& words, int n) {
    std::string out;
    for (int i = 0; i < n; ++i) out += words;
    return out;
  };
  for (const int n : {1, 2, 4, 12})
    for (const std::string& words : {often("a long label, ", 3), often("ü", 40)}) {
      ChartPicture chart = chart_of("long.png", {1, 2}, {1e6, 2e6});
      chart.printed = 120;
      chart.title = chart.x_label = chart.y_label = chart.series[0].name = often(words, n);
      chart.series[0].style = SeriesStyle::points;
      CAPTURE(words);
      CAPTURE(n);
      if (n > 2) CHECK(message_of([&] { draw(chart); }).find("is wider than its chart") != std::string::npos);
      chart.series[0].name = n > 1 ? words + words.substr(0, words.size() / 2) : words;
      draw(chart);
      const Pixels p = read_png("long.png");
      int cut = 0;
      for (int y = 0; y < p.height; ++y) cut += p.at(0, y).r < 200 || p.at(p.width - 1, y).r < 200;
      for (int x = 0; x < p.width; ++x) cut += p.at(x, 0).r < 200 || p.at(x, p.height - 1).r < 200;
      CHECK(cut == 0);
      // The legend has its marker, above the plot where the name is long.
      const auto is_frame = [&](int y) {
        int dark = 0;
        for (int x = 0; x < p.width; ++x) dark += p.at(x, y).r < 60;
        return dark > p.width / 2;
      };
      int above = 0;
      for (int y = 0; y < p.height && !is_frame(y); ++y)
        for (int x = 0; x < p.width; ++x) above += near(p.at(x, y), series_colour(0));
      if (n > 1) CHECK(above > 20);
    }
}

TEST_CASE("charts without data, or with one point, are drawn") {
  for (const bool log : {false, true}) {
    ChartPicture chart = chart_of("bare.png", {}, {});
    chart.log_x = chart.log_y = log;
    CHECK(message_of([&] { draw(chart); }) == "");
    chart.series[0].x = {3}, chart.series[0].y = {3};
    chart.series[0].style = SeriesStyle::both;
    CHECK(message_of([&] { draw(chart); }) == "");
    CHECK(read_png("bare.png").count(series_colour(0), 6) > 20);
    chart.series.clear();
    CHECK(message_of([&] { draw(chart); }) == "");
  }
}

TEST_CASE("whiskers run from x_low to x_high, a front lies pale beneath, crossed markers are pale") {
  ChartPicture chart = chart_of("whiskers.png", {2, 8}, {0.3, 0.7});
  chart.x_range = {0, 10};
  chart.y_range = {0, 1};
  SeriesPicture& s = chart.series[0];
  s.style = SeriesStyle::points;
  s.x_low = {1, 8}, s.x_high = {4, 8};
  SeriesPicture front = chart_of("", {2, 8}, {0.3, 0.7}).series[0];
  front.front = true;
  SeriesPicture poor = chart_of("", {5}, {0.1}).series[0];
  poor.style = SeriesStyle::points, poor.twin = poor.crossed = true;
  chart.series = {front, s, poor};
  draw(chart);
  const Pixels p = read_png("whiskers.png");
  const Frame f = frame_of(p);
  const Colour blue = series_colour(0), pale{255, 232, 150};
  for (const double x : {0.11, 0.16, 0.25, 0.39}) CHECK(drawn_at(p, f, x, 0.3, blue));
  for (const double x : {0.08, 0.43}) CHECK_FALSE(drawn_at(p, f, x, 0.3, blue));
  CHECK_FALSE(drawn_at(p, f, 0.84, 0.7, blue));  // no spread
  for (const double x : {0.5, 0.6}) CHECK(drawn_at(p, f, x, 0.3 + 0.4 * (x - 0.2) / 0.6, pale));
  const Colour tint{static_cast<unsigned char>(255 - (255 - blue.r) / 3), static_cast<unsigned char>(255 - (255 - blue.g) / 3),
                    static_cast<unsigned char>(255 - (255 - blue.b) / 3)};
  CHECK(drawn_at(p, f, 0.5, 0.1, tint));

  chart.series[1].x_low.pop_back();
  CHECK_THROWS_WITH(draw(chart), "series \"\": whiskers need as many x_low and x_high values as points");
}

TEST_CASE("one range for both axes makes the plot square") {
  ChartPicture chart = chart_of("round.png", {0, 1}, {0, 1});
  chart.x_range = chart.y_range = {-1, 2};
  chart.y_label = "y";
  draw(chart);
  Frame f = frame_of(read_png("round.png"));
  CHECK(f.right - f.left > 300);
  CHECK(std::abs((f.right - f.left) - (f.bottom - f.top)) <= 1);
  chart.y_range = {-1, 3};
  draw(chart);
  f = frame_of(read_png("round.png"));
  CHECK(f.right - f.left > f.bottom - f.top + 50);
}

TEST_CASE("what a slope guide says keeps clear of the frame") {
  // Curves leave room only above them, from too little to enough.
  for (double room = 0.5; room < 2.5; room += 0.1) {
    CAPTURE(room);
    ChartPicture chart = chart_of("guide_frame.png", {}, {});
    const SeriesPicture empty = chart.series[0];
    chart.series.clear();
    for (int k = 0; k < 10; ++k) {
      chart.series.push_back(empty);
      chart.series.back().x = {1, 1e4}, chart.series.back().y = {std::pow(10, -0.5 * k), std::pow(10, -1 - 0.5 * k)};
    }
    chart.log_x = chart.log_y = true;
    chart.x_range = {1, 1e4};
    chart.y_range = {1e-6, std::pow(10, room)};
    chart.slopes = {{-0.25, ""}};
    draw(chart);
    const Pixels p = read_png("guide_frame.png");
    const Frame f = frame_of(p);
    int dark = 0;  // just above and just below the frame's line
    for (const int y : {f.top - 4, f.top - 3, f.top + 3, f.top + 4})
      for (int x = f.left + 10; x < f.right - 10; ++x) dark += p.at(x, y).r < 180;
    CHECK(dark == 0);
  }
}

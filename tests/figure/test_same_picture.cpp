// When two pictures show the same: what rasterisers leave open does not count; a colour, a marker, a number does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <stdexcept>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

/// A curve, dots, axes and numbers, with a change.
Pixels drawn(const std::function<void(ChartPicture&)>& change) {
  ChartPicture chart;
  chart.file = "same.png";
  chart.width = 600, chart.height = 450;
  SeriesPicture curve, dots;
  for (int k = 0; k <= 20; ++k) curve.x.push_back(k), curve.y.push_back(k * (20 - k) / 100.0);
  dots.x = {3, 8, 16}, dots.y = {0.2, 0.5, 0.8};
  curve.style = SeriesStyle::line;
  dots.style = SeriesStyle::points;
  chart.series = {curve, dots};
  chart.x_range = {0, 20}, chart.y_range = {0, 1.2};
  change(chart);
  draw(chart);
  return read_png(chart.file);
}

Pixels drawn() {
  return drawn([](ChartPicture&) {});
}

bool same(const Pixels& a, const Pixels& b) { return greatest_difference(a, b).levels <= Difference::kSame; }

/// Whatever blends the one colour with white, in another colour.
Pixels recoloured(Pixels p, Colour from, Colour to) {
  const int whole[] = {from.r, from.g, from.b}, other[] = {to.r, to.g, to.b};
  for (auto pixel = p.rgb.begin(); pixel != p.rgb.end(); pixel += 3) {
    const double share = (255.0 - *std::min_element(pixel, pixel + 3)) / (255 - *std::min_element(whole, whole + 3));
    bool blend = true;
    for (int k = 0; k < 3; ++k) blend = blend && std::abs(255 - share * (255 - whole[k]) - pixel[k]) < 10;
    for (int k = 0; k < 3 && blend; ++k) pixel[k] = static_cast<unsigned char>(255 - share * (255 - other[k]));
  }
  return p;
}

}  // namespace

TEST_CASE("the same picture drawn twice is the same, pixel by pixel") { CHECK(greatest_difference(drawn(), drawn()).levels == 0); }

TEST_CASE("pixels on edges that another rasteriser covers otherwise do not count") {
  const Pixels a = drawn();
  Pixels b = a;
  int edges = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = y % 4; x < a.width; x += 4) {
      if (near(a.at(x - 1, y), a.at(x + 1, y), 100) || (y / 4 + x / 4) % 2) continue;
      const auto pixel = b.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * a.width + x);
      std::for_each(pixel, pixel + 3, [](unsigned char& level) { level = static_cast<unsigned char>(level < 128 ? level + 85 : level - 85); });
      ++edges;
    }
  CHECK(edges > 100);
  CHECK(same(a, b));
}

TEST_CASE("a curve or dots in another colour are not the same picture") {
  const Colour blue{0x00, 0x72, 0xb2}, green{0x00, 0x9e, 0x73}, vermilion{0xd5, 0x5e, 0x00}, orange{0xe6, 0x9f, 0x00};
  const Pixels a = drawn();
  REQUIRE(a.count(blue) > 100);
  REQUIRE(a.count(vermilion) > 50);
  CHECK(same(a, recoloured(a, blue, blue)));
  CHECK_FALSE(same(a, recoloured(a, blue, green)));
  CHECK_FALSE(same(a, recoloured(a, vermilion, orange)));
}

TEST_CASE("a curve that moves, a dot that is missing, a number that is another are not the same picture") {
  const Pixels a = drawn();
  const auto other = [&](const std::function<void(ChartPicture&)>& change) { return !same(a, drawn(change)); };
  CHECK(other([](ChartPicture& c) { for (double& y : c.series[0].y) y += 0.01; }));
  CHECK(other([](ChartPicture& c) { c.series[1].x.pop_back(), c.series[1].y.pop_back(); }));
  CHECK(other([](ChartPicture& c) { c.x_range = {0, 20.5}; }));
}

TEST_CASE("a field whose colours shift by a twentieth of their range is not the same picture") {
  Pixels a{100, 100, std::vector<unsigned char>(30000, 90)}, b = a;
  for (std::size_t i = 0; i < b.rgb.size(); i += 3) b.rgb[i] += 13;
  CHECK(greatest_difference(a, b).levels == 13);
  CHECK_FALSE(same(a, b));
  b.width = 50, b.height = 200;
  CHECK_THROWS_AS(greatest_difference(a, b), std::invalid_argument);
}

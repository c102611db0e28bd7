// How the numbers of a chart become pixels, and which places are free.
#pragma once

#include <optional>
#include <vector>

#include "figure/canvas/canvas.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

inline constexpr Colour reference_grey{90, 90, 90};
inline constexpr double small_text = 0.85;  // in em

// What lies farther off, or would rise more steeply, counts as so far.
constexpr double most_pixels = 1e300;

// An axis: values in [low, high] run over the pixels [from, to].
struct Axis {
  bool log = false;
  double low = 0, high = 1;
  double from = 0, to = 1;

  bool shows(double value) const;            // finite, and positive where logarithmic
  double pixel(double value) const;
  double pixels_per_unit() const;            // or per decade
};

// A slope in units (or decades) as one in pixels.
double steepness(const Axis& x, const Axis& y, double slope);

// The axis range of the data: that given, or the finite values with a margin.
Axis fit_axis(const ChartPicture& chart, bool vertical);

// The curve of a series in pixels, in pieces between gaps.
std::vector<std::vector<Point>> curves(const SeriesPicture& series, const Axis& x, const Axis& y);

// Points along everything drawn, a few pixels apart: what a legend must spare.
class Occupied {
public:
  void add(const std::vector<Point>& curve, const Box& inside);
  void add(const Box& box);
  int within(const Box& box) const;
  double distance(const Box& box) const;     // to the nearest point, 0 inside

private:
  std::vector<Point> points_;
};

// The corner or edge of `room` where a block of this size meets no curve.
std::optional<Point> free_place(const Occupied& occupied, const Box& room, double width, double height, double margin);

// Where in `room` a block of this size stands next to the curves of `to`, rather
// below than above, but keeps `margin` clear of all that is occupied.
std::optional<Point> near_place(const Occupied& occupied, const Occupied& to, const Box& room, double width, double height, double margin);

// Which of the curves has nearest to this slope, pixels over pixels: from its first to its last point.
const std::vector<Point>* nearest_slope(const std::vector<std::vector<Point>>& curves, double slope);

// The same nearest to a point: where the middle of the block stands.
std::optional<Point> place_beside(const Occupied& occupied, const Box& room, Point at, double width, double height, double margin);

}  // namespace dotyk::figure

// Axes: where they have their ticks, how numbers are written on a picture, and two axes around a room, for charts and the cells of
// a page.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

// For differences and shares of any two numbers: a double would overflow, or underflow to nothing.
using Wide = long double;

struct Tick {
  double value = 0;
  std::string label;  // empty: a minor tick
};

struct Ticks {
  std::vector<Tick> ticks;
  int exponent = 0;  // labels are to be multiplied by 10^exponent
  std::vector<double> labelled() const;  // where there are labels
};

// Ticks at 1, 2 or 5 times a power of ten in [low, high], about `wanted`; of
// any finite ends, no more than some hundred. Labels of numbers below `plain` have a power of ten beside the axis.
Ticks linear_ticks(double low, double high, int wanted, double plain = 1e-3);

// Decades in [low, high], both positive; about `wanted` at most have labels,
// and of hundreds of decades only some have ticks.
// Ranges of about two decades and below have labels between decades too.
Ticks log_ticks(double low, double high, int wanted);

// 10 raised to k, in the script of the font: "10" with a raised exponent.
std::string power_of_ten(int k);

// A number with `digits` significant digits, without a machine's "e+05".
std::string number(double value, int digits = 3);

// The same in the unit of an axis, 10^exponent, as its labels are: no second
// power of ten; what is nearer to zero than 0.001 is said to be so.
std::string scaled_number(double value, int exponent, int digits = 3);

// "kPa" of 10³ Pa; of units that have no prefixes here "10³ mm".
std::string scaled_unit(const std::string& unit, int exponent);

// "load, at most 12.3 MN". It has a power of ten if an axis up to this value has one.
std::string at_most(const std::string& what, double value, const std::string& unit);

inline constexpr Colour reference_grey{90, 90, 90};
inline constexpr double small_text = 0.85;  // in em
constexpr Colour axes_ink{30, 30, 30}, axes_grid{228, 228, 228};

// What lies farther off, or would rise more steeply, counts as so far.
constexpr double most_pixels = 1e300;

// Values between `from` and `to` are left out: they share the few pixels between `low` and `high`.
struct AxisBreak {
  double from = 0, to = 0, low = 0, high = 0;
  bool hides(double value) const { return value > from && value < to; }
};

// An axis: values in [low, high] run over the pixels [from, to].
struct Axis {
  bool log = false;
  double low = 0, high = 1;
  double from = 0, to = 1;
  std::optional<AxisBreak> left_out = {};

  bool shows(double value) const;            // finite, and positive where logarithmic
  double pixel(double value) const;
  double value(double pixel) const;          // of an axis without a break
  double pixels_per_unit() const;            // or per decade
};

// A slope in units (or decades) as one in pixels.
double steepness(const Axis& x, const Axis& y, double slope);

struct Axes {
  Box room;
  Axis x, y;
  Ticks x_ticks, y_ticks;
  double em = 20;
  double tick = 0.32;              // em that ticks reach into the room; negative: out of it
  std::optional<Point> pole = {};  // of polar axes: x is an angle in degrees, and y counts pixels from here
  Point at(double x_value, double y_value) const;
  std::array<double, 2> values(Point p) const { return {x.value(p.x), y.value(p.y)}; }
  std::vector<std::array<double, 2>> values(const std::vector<Point>& points) const {
    std::vector<std::array<double, 2>> out;
    for (const Point& p : points) out.push_back(values(p));
    return out;
  }
  // A line through points of these coordinates, in pixels.
  std::vector<Point> line(const std::vector<double>& x_values, const std::vector<double>& y_values) const {
    std::vector<Point> out;
    for (std::size_t i = 0; i < x_values.size(); ++i) out.push_back(at(x_values[i], y_values[i]));
    return out;
  }
};

// The points at(0) … at(count - 1) in pieces between those that are not there.
std::vector<std::vector<Point>> pieces(std::size_t count, const std::function<std::optional<Point>(std::size_t)>& at);

// White ground and grid lines.
void draw_grid(Canvas& canvas, const Axes& axes);
// Ticks of the axis at one edge of the room, and their labels, never one into another.
enum class Side { left, below, right };
void draw_ticks(Canvas& canvas, const Axes& axes, Side side, bool labels = true, Colour colour = axes_ink);
void draw_frame(Canvas& canvas, const Axes& axes);
double widest_label(const Ticks& ticks, double size);
// Ticks for so many labels, or a few more: at least four of them labelled, or two where less than 2.3 are wanted, as there is no room for four.
Ticks few_ticks(double low, double high, double wanted, double plain = 1e-3);
// The share of a broken axis's height that lies below the break: that of the values shown there, but from 0.2 to 0.8, so that neither part is very low.
double share_below(const Axis& axis);
// Of a broken axis: about so many labels on what is not left out, at least one above and two below it.
Ticks broken_ticks(const Axis& axis, double wanted);
// Of a horizontal axis: as many as have room for their labels; three where a power of ten beside the axis makes that room.
Ticks spaced_ticks(const Axis& axis, double em);
// "force  (× 10³)".
std::string axis_name(const std::string& label, const Ticks& ticks);

}  // namespace dotyk::figure

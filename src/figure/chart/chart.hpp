// What the parts of a chart share.
#pragma once

#include <vector>

#include "figure/canvas/axes.hpp"
#include "figure/canvas/legend.hpp"

namespace dotyk::figure {

// The axis range of the data: that given, or the finite values with a margin.
Axis fit_axis(const ChartPicture& chart, Side side);

// Both pairs of axes: they share the room and x.
struct ChartAxes {
  Axes left, right;
  const Axes& of(const SeriesPicture& s) const { return s.right ? right : left; }
};

// The points of a series, in pieces: a point that the axes cannot show ends one. runs() gives their values, curves() their pixels, with
// further points where straight lines become bent: at a break of the axis, and between angles.
std::vector<std::vector<Point>> runs(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes);
std::vector<std::vector<Point>> curves(const std::vector<double>& x, const std::vector<double>& y, const Axes& axes);

// A triangle whose slanted side has the slope, near the curve whose slope is most like it and clear of
// all; smaller where there is little room. What it takes is added to `occupied`.
void draw_guide(Canvas& canvas, const ChartPicture& picture, const SlopeGuide& guide, const Axes& axes, Occupied& occupied);

// Pixels beside the plot, and the width of the plot (of polar axes, of the circle). `crowded`: a note for which there is no free place.
struct ChartMargins {
  double left = 0, right = 0, below = 0, above = 0, plot = 0;
  const ChartNote* crowded = nullptr;
  Lack legend = {};
};
// Throws InputError if labels leave less than 15 mm for a plot in one of so many columns, or a note or a name in the legend has no room.
void require_room(const Sheet& sheet, const ChartMargins& margins, int columns);

// What a chart has in common with those above and below it.
struct ChartFrame {
  double em = 20;
  ChartMargins least = {};  // the margins are at least these
  bool x_labels = true;
  bool alone = false;       // may be narrower than the picture
  bool legend = true;
  bool bar = true;          // of the colours of a map
};

// From the canvas's origin, of the picture's size; returns the margins taken.
ChartMargins draw_on(Canvas& canvas, const ChartPicture& picture, const ChartFrame& frame);

// Cells of a map, beneath the series, in colours: borders of the cells around values that ascend: one more than there are values.
std::vector<double> cell_borders(const std::vector<double>& at, bool log);
// The same on polar axes. There the outer halves of the first and last cells are left out: a radius or an angle may end at its last value, as a colatitude does
// at 90°. Angles all around have whole cells, which meet.
std::vector<double> polar_borders(const std::vector<double>& at, bool angles);

// Ticks at the values, where they are whole numbers one after the other, with evenly spaced labels, `most` at most; else none.
Ticks map_ticks(const std::vector<double>& at, double most);

void draw_map(Canvas& canvas, const ChartMap& map, const Axes& axes);
std::vector<LegendEntry> map_legend(const ChartMap& map);

// Of values without names: pixels that it takes on the right, with a gap before it; its drawing from `left` on, in a picture so wide.
double map_bar_width(const ChartMap& map, double em);
void draw_map_bar(Canvas& canvas, const ChartMap& map, const Axes& axes, double left, double width);

// Polar axes, circles and rays: pixels that the names of the angles take on either side of the circle, and above and below it.
Point polar_rim(double em);
// Puts the pole into the middle of the room, and gives the radius its pixels and ticks.
void place_polar(Axes& axes);
// The circle and the names of the angles are not free.
void occupy_polar(const Axes& axes, Occupied& occupied);

// Beneath the series; and above them the angles, and the radii along the ray that is freest.
void draw_polar_grid(Canvas& canvas, const Axes& axes);
void draw_polar_labels(Canvas& canvas, const Axes& axes, const Occupied& occupied);

}  // namespace dotyk::figure

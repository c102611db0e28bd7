// Cells of a map: beneath the series, in colours.
#pragma once

#include "figure/canvas/axes.hpp"
#include "figure/canvas/legend.hpp"

namespace dotyk::figure {

// Borders of the cells around values that ascend: one more than there are values.
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

}  // namespace dotyk::figure

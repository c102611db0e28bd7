// How series look: colours, markers and dashes, and the legend that explains them.
#pragma once

#include <set>

#include "figure/canvas/axes.hpp"
#include "figure/canvas/legend.hpp"

namespace dotyk::figure {

struct Look {
  const SeriesPicture& data;
  Colour colour;
  Marker marker;
  bool dashed;
};

// Of every series, in their order.
std::vector<Look> looks(const ChartPicture& picture);
// Gives each name the same colour and marker in all panels, unless there are more names than colours.
void share_looks(std::vector<ChartPicture>& panels);

// Does the series have a line from point to point? The broad line of a front does not count.
bool has_line(const SeriesPicture& s);

// Have reference curves their names beside them, not in the legend? Where several have a name: in a legend they look alike.
bool names_beside(const ChartPicture& picture);

// The colour of the right axis: that of its only series, if no series on the left has it, or else that of all axes.
Colour right_colour(const ChartPicture& picture);

// Draws parts of series; lines and markers are sized by the height of letters.
struct Pen {
  double em;

  double line_width() const { return std::max(1.5, em / 9); }
  double front_width() const { return 0.9 * em; }
  double marker_size(const SeriesPicture& s) const { return (s.style == SeriesStyle::points ? 0.45 : 0.5) * em; }

  void sample(Canvas& canvas, const Look& look, const Box& box) const;
  void stroke(Canvas& canvas, std::span<const Point> points, const Look& look) const;
  // `rim`: pixels that it is broader on both sides.
  void mark(Canvas& canvas, const Look& look, Point at, double rim = 0) const;
  // From end to end, with caps.
  void whisker(Canvas& canvas, const std::array<Point, 2>& ends, const Look& look) const;
};

// Has the legend of one all that the other's has, with the same names and looks?
bool legend_serves(const ChartPicture& with, const ChartPicture& other);
// Of all panels, each entry once; empty where they have none in common, a name has two looks or a look two names, or some have theirs
// beside their curves. The panels must outlive it.
Legend common_legend(const std::vector<ChartPicture>& panels, double em, double width);
// In rows no wider than so many pixels; 0: one name below the other. The picture must outlive it.
// `also`: reference curves that are in it though others have their names beside them.
Legend chart_legend(const ChartPicture& picture, double em, double width, const std::set<const SeriesPicture*>& also = {});

}  // namespace dotyk::figure

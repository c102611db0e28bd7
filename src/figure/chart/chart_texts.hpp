// Texts within a plot: names of reference curves beside them, and notes at points.
#pragma once

#include <set>

#include "figure/chart/chart.hpp"

namespace dotyk::figure {

struct PlotText {
  FittedText words;
  Box box;
  Colour colour;
  bool upright = false;
  std::optional<std::array<Point, 2>> leader = {};  // from the point that is meant
};

// At free places; what they take is added to `occupied`. A reference curve beside which there is none is added to `crowded`, and
// has no name in the plot from then on. A note for which there is none becomes `crowded_note`. Throws InputError of a note beyond the axes.
using SeriesSet = std::set<const SeriesPicture*>;
std::vector<PlotText> plot_texts(const ChartPicture& picture, const ChartAxes& axes, Occupied& occupied, SeriesSet& crowded, const ChartNote*& crowded_note);
void draw(Canvas& canvas, const PlotText& text, double em);

}  // namespace dotyk::figure

// Texts within a plot: names of reference curves beside them, and notes at points.
#pragma once

#include "figure/chart/chart.hpp"

namespace dotyk::figure {

struct PlotText {
  std::string text;
  Box box;
  Colour colour;
  bool upright = false;
  std::optional<std::array<Point, 2>> leader = {};  // from the point that is meant
};

// At free places; what they take is added to `occupied`.
std::vector<PlotText> plot_texts(const ChartPicture& picture, const ChartAxes& axes, Occupied& occupied);
void draw(Canvas& canvas, const PlotText& text, double em);

}  // namespace dotyk::figure

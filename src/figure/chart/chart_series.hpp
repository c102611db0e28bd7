// Draws the series of a chart.
#pragma once

#include "figure/chart/chart.hpp"
#include "figure/chart/chart_look.hpp"

namespace dotyk::figure {

class SeriesDrawing {
public:
  // All of these must outlive it.
  SeriesDrawing(Canvas& canvas, const ChartAxes& axes, const std::vector<Look>& looks, double em) : canvas_(canvas), axes_(axes), looks_(looks), pen_{em} {}

  void occupy(Occupied& occupied) const;
  // What the room cuts off: fronts, bands, lines and whiskers.
  void draw_curves();
  void draw_markers();

private:
  void draw_front(const Look& look);
  void draw_band(const Look& look);
  void draw_lines();
  Axes axes_of(const SeriesPicture& s) const;
  std::vector<std::array<Point, 2>> whiskers(const SeriesPicture& s) const;
  std::vector<Point> marked(const SeriesPicture& s) const;

  Canvas& canvas_;
  const ChartAxes& axes_;
  const std::vector<Look>& looks_;
  Pen pen_;
};

}  // namespace dotyk::figure

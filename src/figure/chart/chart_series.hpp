// Draws the series of a chart; where a curve or marker would be hidden beneath later ones.
#pragma once

#include <vector>

#include "figure/canvas/plane.hpp"
#include "figure/chart/chart.hpp"
#include "figure/chart/chart_look.hpp"

namespace dotyk::figure {

// Tells whether a place in a room lies near some curve or point: within `reach` pixels.
class Neighbourhood {
public:
  Neighbourhood(const Box& room, double reach);
  void add(const std::vector<Point>& curve);
  void add(Point point);
  bool holds(Point point) const;

private:
  Box room_;
  double cell_, reach_;
  int columns_, rows_;
  std::vector<bool> cells_;  // which have a point in them
};

// Points along the part of the curve in the room, close to each other; a gap begins a new one.
std::vector<std::vector<Point>> sampled(const std::vector<Point>& curve, const Box& room);

// A part of a curve that so many later curves hide.
struct HiddenPart {
  std::vector<Point> points;
  int depth = 0;
};
// Those longer than `least` pixels.
std::vector<HiddenPart> hidden_parts(const std::vector<Point>& curve, const std::vector<Neighbourhood>& later, const Box& room, double least);

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

// Two axes around a room, for charts and the cells of a page.
#pragma once

#include <string>

#include "figure/canvas/canvas.hpp"
#include "figure/chart/chart_layout.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

constexpr Colour axes_ink{30, 30, 30}, axes_grid{228, 228, 228};

struct Axes {
  Box room;
  Axis x, y;
  Ticks x_ticks, y_ticks;
  double em = 20;
};

// White ground and grid lines.
void draw_grid(Canvas& canvas, const Axes& axes);
// Ticks and their labels, never one into another.
void draw_ticks(Canvas& canvas, const Axes& axes, bool x_labels = true);
void draw_frame(Canvas& canvas, const Axes& axes);
// Ticks for so many labels, at least two of them labelled.
Ticks few_ticks(double low, double high, double wanted);
// Of a horizontal axis: as many as have room for their labels.
Ticks spaced_ticks(const Axis& axis, double em);
// "force  (× 10³)".
std::string axis_name(const std::string& label, const Ticks& ticks);

}  // namespace dotyk::figure

// A chart among others: what it has in common with those above and below it.
#pragma once

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

// Pixels beside the plot.
struct ChartMargins {
  double left = 0, right = 0, below = 0, above = 0;
};

struct ChartFrame {
  double em = 20;
  ChartMargins least;   // left and right
  bool x_labels = true;
  bool alone = false;   // may be narrower than the picture
};

// From the canvas's origin, of the picture's size; returns the margins taken.
ChartMargins draw_on(Canvas& canvas, const ChartPicture& picture, const ChartFrame& frame);

}  // namespace dotyk::figure

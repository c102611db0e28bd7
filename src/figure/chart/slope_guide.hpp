#pragma once

#include "figure/canvas/axes.hpp"
#include "figure/canvas/canvas.hpp"
#include "figure/chart/chart_layout.hpp"

namespace dotyk::figure {

// A triangle whose slanted side has the slope, near the curve whose slope is most like it and clear of
// all; smaller where there is little room. What it takes is added to `occupied`.
void draw_guide(Canvas& canvas, const ChartPicture& picture, const SlopeGuide& guide, const Axes& axes, Occupied& occupied);

}  // namespace dotyk::figure

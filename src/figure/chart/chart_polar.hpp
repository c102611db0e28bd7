// Polar axes: circles and rays.
#pragma once

#include "figure/chart/chart.hpp"

namespace dotyk::figure {

// Pixels that the names of the angles take on either side of the circle, and above and below it.
Point polar_rim(double em);
// Puts the pole into the middle of the room, and gives the radius its pixels and ticks.
void place_polar(Axes& axes);
// The circle and the names of the angles are not free.
void occupy_polar(const Axes& axes, Occupied& occupied);

// Beneath the series; and above them the angles, and the radii along the ray that is freest.
void draw_polar_grid(Canvas& canvas, const Axes& axes);
void draw_polar_labels(Canvas& canvas, const Axes& axes, const Occupied& occupied);

}  // namespace dotyk::figure

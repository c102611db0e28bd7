// Lines across the triangles of a plate.
#pragma once

#include <vector>

#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

// Points of a line through triangles: x, y, and the deflection there.
using PlateLine = std::vector<Vec3>;

// Where the field, linear on each triangle, has this value; closed lines end
// in their first point.
std::vector<PlateLine> contour(const PlatePicture& plate, double value);

// Triangles all of whose corners bear on the obstacle, flat.
std::vector<int> bearing_triangles(const PlatePicture& plate);

// Parallels at 45 degrees, `spacing` apart, on these triangles: two points each.
std::vector<PlateLine> hatch(const PlatePicture& plate, const std::vector<int>& triangles, double spacing);

}  // namespace dotyk::figure

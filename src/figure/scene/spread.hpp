// Which of many places get a symbol, so that symbols stand apart and evenly.
#pragma once

#include <cstddef>
#include <vector>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

// Numbers of places at least `spacing` pixels apart. Along an edge whose nodes
// are even: evenly, from end to end where their number allows it, else with
// equal steps all the same, as a gap would look like one of what is shown.
std::vector<std::size_t> spread(const std::vector<Point>& at, double spacing);

// The same on a surface: `plan` are the places' coordinates across its normal.
// Where these are those of a grid, whole lines of it are left out.
std::vector<std::size_t> spread(const std::vector<Point>& at, const std::vector<Point>& plan, double spacing);

}  // namespace dotyk::figure

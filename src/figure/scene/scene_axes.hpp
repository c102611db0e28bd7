#pragma once

#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

constexpr double legend_size = 0.88;  // of numbers and names, in em

// The axes stand off the scene, but bound a window.
double axis_gap(const Stage& stage);

// Across and up.
std::array<Ticks, 2> frame_ticks(const Stage& stage);

// "x", "arc [mm]", "y [10⁻³ m]".
std::string axis_text(const Stage& stage, std::size_t axis, int exponent);

// Does a name need a line of its own?
bool is_long(const std::string& name, double em);

void draw_axes(Stage& stage);

// The directions of x, y and z, in the corner of the room that the scene leaves freest.
void draw_triad(Stage& stage, const Box& room);

}  // namespace dotyk::figure

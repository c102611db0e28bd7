// How the cells of a page draw themselves into a room.
#pragma once

#include "figure/canvas/axes.hpp"
#include "figure/canvas/legend.hpp"
#include "figure/page/page_picture.hpp"

namespace dotyk::figure {

constexpr double plain_numbers = 1e-2;  // labels of vertical axes below it are with a power of ten

constexpr Colour idle_ink{175, 175, 175};           // of a spring beside one that acts
constexpr Colour forbidden_grey{228, 228, 228};     // of displacements that a law forbids

// The vertical axis of a drawing in a room of this height, x given: values and ticks.
void fit_y(const BeamDrawing& beam, Axes& axes);
void fit_y(const CurveDrawing& curve, Axes& axes);

// What stands in the room; grid, ticks and frame are drawn by the page.
void draw_cell(Canvas& canvas, const BeamDrawing& beam, const Axes& axes);
void draw_cell(Canvas& canvas, const CurveDrawing& curve, const Axes& axes);

// Symbols of supports that stand at a beam's points, and what room they need beyond the beam's ends.
void draw_supports(Canvas& canvas, const BeamDrawing& beam, const Axes& axes);
// Does the arc of a support stand over this pixel of the beam?
bool below_arc(const BeamDrawing& beam, const Axes& axes, double pixel);
// In em of the symbols, so many pixels: larger than letters while there is room.
double symbol_em(const Axes& axes);
double beyond_ends(const BeamDrawing& beam);
// Does an arrow tell by how much the support was put off the axis?
bool shows_settlement(const BeamSupport& support, const Axes& axes);
// Pixels from the axis down to the ground of the supports' elements, at this many pixels per unit of deflection.
double ground_depth(const BeamDrawing& beam, double scale, double em);
// How far above the line a force at x begins: over the bar of an end that is held against rotation alone.
double clear_of_bar(const BeamDrawing& beam, double x, double em);
// Pixels that a support needs above the deflection line and below the axis.
double height_above(const BeamSupport& support, double em);
double depth_below(const BeamDrawing& beam, const BeamSupport& support, double scale, double em);

}  // namespace dotyk::figure

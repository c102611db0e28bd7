// From which side a scene is seen, and how large it is drawn.
#pragma once

#include "figure/canvas/geometry.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

// In space: looks at the contact side from above, and from the front where it
// can.
void aim(Stage& stage);

// Bounds of all that grows with the scene, at one pixel per unit of length:
// bodies, small obstacles, and the near part of large ones.
Bounds scaled_bounds(const Stage& stage);

// Finds scale and origin so that the scene with its symbols, which keep their
// size in pixels, fills the room; sets stage.view and stage.frame.
void fit(Stage& stage, const Bounds& scaled, const Box& room);

// Fits the picture's window into the room instead. The greatest pressure comes
// to a fifth of its height, less where it would not fit; from three quarters of
// that on the window grows. Sets stage.view, frame, window, and what depends on
// what is seen: greatest pressure, colours.
void fit_window(Stage& stage, const Box& room);

}  // namespace dotyk::figure

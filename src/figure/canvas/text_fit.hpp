// Texts that are longer than their place.
#pragma once

#include <string>
#include <vector>

#include "figure/canvas/canvas.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

// The text, or its beginning and "…", no wider than so many pixels.
std::string shortened(const std::string& text, double size, double pixels, bool bold = false);

struct FittedText {
  double size = 20;  // of the letters, pixels
  std::vector<std::string> lines;
};

// Of the labels of ticks.
double widest_label(const Ticks& ticks, double size);

// Of titles: bold, centred, hanging from their place.
TextStyle title_style();

// From the place of the first line on, the others below it; of an upright text, to the right.
void draw_lines(Canvas& canvas, Point first, const FittedText& text, TextStyle style);
// How far the last line is from the first.
double depth(const FittedText& text);

// In one line of letters down to half of `size`; else in two lines of these, broken between words, the second
// shortened where that does not suffice either. `end` stays whatever is left out before it.
FittedText fitted(const std::string& text, double size, double pixels, bool bold = false, const std::string& end = "");

}  // namespace dotyk::figure

// The font of all pictures: DejaVu Sans, which has the Greek letters and signs of mechanics.
#pragma once

#include <cairo.h>

#include "figure/canvas/canvas.hpp"
#include "figure/canvas/sheet.hpp"

namespace dotyk::figure {

constexpr const char* font_family = "DejaVu Sans";
// Above and below the base line, of the size.
constexpr double font_ascent = 0.76, font_descent = 0.24;

void set_font(cairo_t* cr, double size, bool bold);

// A piece of a line of text in letters of one size; where its base line begins, from that of the line, upwards.
struct TextRun {
  std::string text;
  double size = 0, width = 0;
  Point start;
};
// The line in pieces: what follows a symbol of one letter and "_" stands lower and is smaller, as in λ_max, but not smaller than `least` if the line is not.
std::vector<TextRun> text_runs(const std::string& text, double size, bool bold, double least = 0);
// Where the base line of a text begins.
Point baseline(const PlacedText& text);
inline double halo_width(double size) { return std::max(1.0, size / 9); }

}  // namespace dotyk::figure

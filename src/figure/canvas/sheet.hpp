// Sizes on paper.
#pragma once

#include "figure/door/picture.hpp"

namespace dotyk::figure {

inline double printed_width(const Sheet& sheet) {
  constexpr double kColumn = 85, kTwoColumns = 178;  // mm
  constexpr int kNarrow = 1300;                      // pixels
  return sheet.printed.value_or(sheet.width <= kNarrow ? kColumn : kTwoColumns);
}

// A point is 1/72 of an inch.
inline double points_per_pixel(const Sheet& sheet) { return printed_width(sheet) / 25.4 * 72 / sheet.width; }

// Pixels of the letters of axes and legends. small_text and least_letters of it are 7 points, which no text of a journal should fall below.
inline double letters(const Sheet& sheet) { return 8.25 / points_per_pixel(sheet); }

constexpr int greatest_side = 8192;  // pixels
// Pixels below which no plot should be high: with its axis it is 30 mm then.
inline double least_plot(const Sheet& sheet) { return 22 / printed_width(sheet) * sheet.width; }

inline bool vector_graphics(const Sheet& sheet) { return !sheet.file.ends_with(".png"); }

}  // namespace dotyk::figure

// Sizes on paper.
#pragma once

#include "figure/door/picture.hpp"

namespace dotyk::figure {

constexpr double one_column = 85, two_columns = 178;  // mm

inline double printed_width(const Sheet& sheet) {
  constexpr int kNarrow = 1300;  // pixels
  return sheet.printed.value_or(sheet.width <= kNarrow ? one_column : two_columns);
}

// A point is 1/72 of an inch.
inline double points_per_pixel(const Sheet& sheet) { return printed_width(sheet) / 25.4 * 72 / sheet.width; }

// The size of letters of axes and legends in pixels: 8.25 points. Times small_text or least_letters this is 7 points, the least size that journals print.
inline double letters(const Sheet& sheet) { return 8.25 / points_per_pixel(sheet); }

// The least height of a plot in pixels: 22 mm, 30 mm with its axis.
inline double least_plot(const Sheet& sheet) { return 22 / printed_width(sheet) * sheet.width; }

inline bool vector_graphics(const Sheet& sheet) { return !sheet.file.ends_with(".png"); }

}  // namespace dotyk::figure

// Writes pictures as PNG, PDF or SVG, as the file name ends. PDF and SVG keep lines as lines and texts as texts; what VTK drew is an image in them.
#pragma once

#include <vector>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

// What VTK drew, to lie between two canvases.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgba;  // 4 width height, highest row first; colours are multiplied by the opacity
};

// VTK draws with so many pixels for each pixel of the sheet, across and up: in PNG for smooth edges, in PDF and SVG for 600 dots an inch; fewer in very large pictures.
int image_factor(const Sheet& sheet);

// Writes the file whole or not at all. `image` is as large as the sheet, or a whole number of times as large; an empty one is left out.
// Throws std::runtime_error with path and reason.
void write_picture(const Sheet& sheet, const Canvas& under, const Image& image, const Canvas& over);
void write_canvas(const Canvas& canvas, const Sheet& sheet);

// The text of an SVG file; `png` is the file of the image between the canvases, empty if there is none.
std::string svg(const Sheet& sheet, const Canvas& under, const std::string& png, const Canvas& over);

}  // namespace dotyk::figure

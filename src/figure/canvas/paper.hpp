// Puts a picture into a file, by its ending: PNG; PDF; SVG. The two last ones keep lines as lines and texts as texts, and have what VTK drew as an image.
#pragma once

#include <vector>

#include "figure/canvas/canvas.hpp"

namespace dotyk::figure {

// What VTK drew, to lie between two canvases.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgba;  // 4 width height, highest row first; colours are multiplied by the opacity
};

// How many times finer than the sheet's pixels VTK is to draw: for smooth edges, less for very large pictures; in PDF and SVG for 600 dots an inch.
int image_factor(const Sheet& sheet);

// Whole or not at all: beside the target first, then renamed. `image` has the size of the sheet, or some times it; none: the canvases alone.
// Throws std::runtime_error with path and reason.
void write_picture(const Sheet& sheet, const Canvas& under, const Image& image, const Canvas& over);
void write_canvas(const Canvas& canvas, const Sheet& sheet);

// As SVG.
std::string svg(const Sheet& sheet, const Canvas& under, const std::string& png, const Canvas& over);

}  // namespace dotyk::figure

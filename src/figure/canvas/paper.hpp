// Writes pictures as PNG, PDF or SVG, as the file name ends. PDF and SVG keep lines as lines and texts as texts; what VTK drew is an image in them.
#pragma once

#include <functional>
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

// What is drawn on a sheet, or on a part of it: a canvas, an image above it, a canvas above both. Canvases have the coordinates of the
// sheet. The image, which may be empty, covers `place`, whole pixels, by a whole number of its own pixels for each.
struct Painted {
  Canvas under;
  Image image;
  Box place;
  Canvas over;
};

// Writes the file whole or not at all, each part above those before it. Throws std::runtime_error with path and reason.
void write_picture(const Sheet& sheet, const std::vector<Painted>& parts);
void write_canvas(Canvas canvas, const Sheet& sheet);

// The text of an SVG file; `png` makes the file of an image.
std::string svg(const Sheet& sheet, const std::vector<Painted>& parts, const std::function<std::string(const Image&)>& png);

}  // namespace dotyk::figure

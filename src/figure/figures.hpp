// Inside the drawing library: one function a kind of picture or file. They throw
// std::runtime_error; entry.cpp keeps exceptions from leaving the library.
#pragma once

#include "grid_file.hpp"
#include "picture.hpp"

namespace dotyk::figure {

void draw_scene(const ScenePicture& picture);
void draw_chart(const ChartPicture& picture);
void write_grid(const GridFile& grid);

}  // namespace dotyk::figure

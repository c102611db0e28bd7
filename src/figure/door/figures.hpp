// Inside the drawing library: one function a kind of picture or file. They throw
// std::runtime_error; entry.cpp keeps exceptions from leaving the library.
#pragma once

#include "figure/door/grid_file.hpp"
#include "figure/page/page_picture.hpp"
#include "figure/door/picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

void draw_scene(const ScenePicture& picture);
void draw_chart(const ChartPicture& picture);
void draw_charts(const ChartColumn& picture);
void draw_page(const PagePicture& picture);
void draw_plate(const PlatePicture& picture);
void write_grid(const GridFile& grid);

}  // namespace dotyk::figure

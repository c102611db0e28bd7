// Inside the drawing library: one function a kind of picture. They throw
// std::runtime_error; entry.cpp keeps exceptions from leaving the library.
#pragma once

#include "picture.hpp"

namespace dotyk::figure {

void draw_scene(const ScenePicture& picture);
void draw_chart(const ChartPicture& picture);

}  // namespace dotyk::figure

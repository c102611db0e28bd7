// What passes the door of the drawing library.
#pragma once

#include <variant>

#include "figure/door/picture.hpp"
#include "figure/page/page_picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

using Drawing = std::variant<const ScenePicture*, const SceneGrid*, const ChartPicture*, const ChartColumn*, const PagePicture*, const PlatePicture*, const GridFile*>;

// Before the door: throw std::runtime_error naming what is wrong: sizes, lengths of arrays, node numbers, the file's ending
// and folder.
void check(const ScenePicture& picture);
void check(const SceneGrid& grid);
void check(const ChartPicture& picture);
void check(const ChartColumn& picture);
void check(const PagePicture& picture);
void check(const PlatePicture& picture);
void check(const GridFile& grid);

// Behind it: draw, or write, and throw std::runtime_error; entry.cpp keeps exceptions from leaving the library.
void render(const ScenePicture& picture);
void render(const SceneGrid& grid);
void render(const ChartPicture& picture);
void render(const ChartColumn& picture);
void render(const PagePicture& picture);
void render(const PlatePicture& picture);
void render(const GridFile& grid);

}  // namespace dotyk::figure

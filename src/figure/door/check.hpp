// What must hold of a picture before it is drawn, of a mesh before it is written.
#pragma once

#include "figure/door/grid_file.hpp"
#include "figure/page/page_picture.hpp"
#include "figure/door/picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

// Throw std::runtime_error naming what is wrong: sizes, lengths of arrays,
// node numbers, the file's ending and folder.
void check(const ScenePicture& picture);
void check(const ChartPicture& picture);
void check(const ChartColumn& picture);
void check(const PagePicture& picture);
void check(const PlatePicture& picture);
void check(const GridFile& grid);

}  // namespace dotyk::figure

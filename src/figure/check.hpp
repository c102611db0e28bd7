// What must hold of a picture before it is drawn.
#pragma once

#include "picture.hpp"

namespace dotyk::figure {

// Throw std::runtime_error naming what is wrong: sizes, lengths of arrays,
// node numbers, the file's ending and folder.
void check(const ScenePicture& picture);
void check(const ChartPicture& picture);

}  // namespace dotyk::figure

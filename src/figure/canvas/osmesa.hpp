// Pictures by VTK off screen.
#pragma once

#include "figure/canvas/paper.hpp"

class vtkRenderer;

namespace dotyk::figure {

// What the renderer holds, image_factor() times as fine as the sheet; its background is clear. Throws std::runtime_error where no context for OpenGL can be had.
Image rendered(const Sheet& sheet, vtkRenderer* renderer);

}  // namespace dotyk::figure

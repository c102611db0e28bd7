// Arrays of ours as VTK's, in rendered pixels.
#pragma once

#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "figure/door/picture.hpp"

class vtkRenderer;
class vtkActor;

namespace dotyk::figure {

// Polygons of `each` corners over points (already in rendered pixels); lines
// when each is 2.
vtkSmartPointer<vtkPolyData> poly_data(const std::vector<Vec3>& points, const std::vector<int>& nodes, int each);

// An unlit actor of lines or faces in one colour, added to the renderer.
vtkSmartPointer<vtkActor> add_plain(vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width = 1, double opacity = 1);

}  // namespace dotyk::figure

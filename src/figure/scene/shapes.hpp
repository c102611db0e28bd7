// Lines and polygons of a scene for VTK, in rendered pixels, so that bodies in front hide them.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "figure/scene/stage.hpp"

namespace dotyk::figure {

// Polygons over points, already in rendered pixels; lines where each has two corners.
vtkSmartPointer<vtkPolyData> poly_data(const std::vector<Vec3>& points, const Facets& polygons);

// Adds unlit lines or faces in one colour; `width` in pixels of the picture.
void add_plain(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width = 1, double opacity = 1);

// Adds a surface with the field's values at its points, or on its polygons, in the colours of the stage.
void add_coloured(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, const std::vector<double>& values, bool on_polygons = false);
// Adds one in one colour. Surfaces in space are lit.
void add_surface(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour);
// Adds the edges at which a surface ends or turns.
void add_features(const Stage& stage, vtkRenderer* renderer, vtkPolyData* data, Colour colour, double width);

constexpr Colour outline_colour{40, 40, 40};
// Of the k-th body where it shows no field.
Colour plain_colour(std::size_t k);

// Lines or polygons, corner by corner.
class Shapes {
public:
  Shapes(const Stage& stage, int each) : stage_(stage), each_(each) {}
  bool empty() const { return points_.empty(); }
  // A corner at a place of the scene, or at a pixel, `lift` pixels nearer to the eye than that is.
  void add(const Vec3& place, double lift) { add_pixel(stage_.view.pixel(place), lift); }
  void add_pixel(const Vec3& pixel, double lift) { points_.push_back(stage_.rendered(pixel, lift)); }
  void show(vtkRenderer* renderer, Colour colour, double width = 1, double opacity = 1) const;

private:
  const Stage& stage_;
  int each_;
  std::vector<Vec3> points_;
};

}  // namespace dotyk::figure

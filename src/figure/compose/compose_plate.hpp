// From a solved plate to what its pictures show.
#pragma once

#include <optional>

#include "figure/compose/compose_beam.hpp"
#include "figure/plate/plate_picture.hpp"
#include "plate/solution.hpp"

namespace dotyk::figure {

// Moments per length at the vertices; greatest and least are the principal ones,
// von Mises √(mxx² − mxx myy + myy² + 3mxy²), 6/h² of which is the stress at the surface.
enum class PlateField { none, deflection, xx, yy, xy, greatest, least, von_mises };

struct PlateOptions {
  PlateView view = PlateView::surface;
  PlateField field = PlateField::deflection;
  std::optional<double> deform;  // factor; empty: chosen so that the deflection can be seen
  Units units = {};              // of length and force
};

// Fills the mesh, the field with its label, the boundary with what supports do along it, concentrated reactions at
// corners and point supports, what bears on the obstacle, and the factor. File, size and titles are the caller's.
PlatePicture compose(const plate::Solution& solution, const PlateOptions& options);

// For ParaView: a plate at rest, with node arrays displacement (3 components, along z), moment (per length, xx yy xy) and, where there is
// one, obstacle_force.
GridFile compose_grid(const plate::Solution& solution, const std::string& file);

// 1, 2 or 5 times a power of ten, such that the greatest deflection comes to 8 to 20 % of the plate's size; 1 where there is none.
double visible_deflection(const plate::Solution& solution);

}  // namespace dotyk::figure

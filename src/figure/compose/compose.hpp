// From a solution to what its picture shows.
#pragma once

#include <optional>
#include <string>

#include "figure/door/picture.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::figure {

enum class FieldChoice { none, displacement, ux, uy, uz, von_mises, xx, yy, zz, yz, xz, xy };

struct SceneOptions {
  FieldChoice field = FieldChoice::von_mises;
  std::optional<double> deform;  // factor; empty: chosen so that the deformation can be seen
  bool contact = true;           // status on the contact boundary, pressure, and the obstacle in the plane
  bool obstacle = true;          // rigid obstacles (in space only where asked: they hide the contact)
  bool supports = false;
  bool loads = false;
};

// Fills bodies, contacts, obstacles, symbols, the field with its label, and the
// deformation factor. File, size, titles and styles are the caller's. Where
// rigid obstacles are drawn: see compose_contact.hpp. Throws InputError for a
// field that the dimension does not have.
ScenePicture compose(const scene::Solution& solution, const SceneOptions& options);

// 1, 2 or 5 times a power of ten, at least 1, such that the greatest displacement comes to 4 to
// 10 % of the scene's size; less where bodies that crossed a gap would be drawn into each other, or
// those that an interference presses apart from each other.
double visible_deformation(const scene::Solution& solution);

}  // namespace dotyk::figure

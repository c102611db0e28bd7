// From a solution to its file for ParaView.
#pragma once

#include <string>

#include "figure/door/grid_file.hpp"
#include "plate/solution.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::figure {

// All bodies of the scene at rest, one after the other, with node arrays
//   displacement      3 components
//   stress            recovered, 6 components in VTK's order xx yy zz xy yz xz
//   von_mises
//   contact_pressure  positive in compression, 0 off the contact boundary
//   contact_gap       after deformation, positive when open; nan where there is no contact
//   contact_status    0 open, 1 closed, 2 stick, 3 slip; -1 where there is no contact
// The contact arrays are left out where the scene has no contact. Of several conditions at one node (a
// corner, two contacts) the one with the greatest pressure is shown, else that with the least gap.
GridFile compose_grid(const scene::Solution& solution, const std::string& file);

// A plate at rest, with node arrays displacement (3 components, along z), moment (per length, xx yy xy) and, where there is
// one, obstacle_force.
GridFile compose_grid(const plate::Solution& solution, const std::string& file);

}  // namespace dotyk::figure

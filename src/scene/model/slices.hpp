#pragma once

#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Are the bodies refined by the ranks? Throws InputError where that is not so of all in the same way, or where there are more unknowns than can be numbered.
bool refined_by_ranks(const Model& model);

/// Assembles K of all bodies in slices: each rank its own rows, after it has refined its share of bodies that ranks refine. Numbering and rows are known.
void assemble_slices(Model& model);

}  // namespace dotyk::scene

#pragma once

#include "base/monitor.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Cuts the bodies of a model into subdomains, each connected through facets: `decomposition.count` pieces shared out
/// by cells (see mesh::share_out), or boxes. Fills problem.subdomains and Model::decomposition; leaves subdomains
/// empty where each body is one piece with its supports in the matrix. Assembled on all cores.
///
/// A nodal load is split evenly among the copies of its unknown; where supports stay in the matrices, so is what
/// prescribed displacements pull. Pieces that are translates of each other share one stiffness: see
/// congruent(). Throws InputError where there is no memory for the matrices, and as problem::require_kernel.
void cut(const problem::Decomposition& decomposition, Model& model, Monitor& monitor);

/// f and value of the subdomains from the loads and prescribed displacements that the model now has.
void load_subdomains(Model& model);

}  // namespace dotyk::scene

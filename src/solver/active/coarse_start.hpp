#pragma once

#include <memory>

#include "solver/active/pdas.hpp"

namespace dotyk::solver {

/// Where to begin on a mesh that refines another: at the solution on the coarser mesh, whose own beginning is found in the same way (nested iteration:
/// Kornhuber 1994, Brandt and Cryer 1983). Otherwise the end of a contact zone moves by few rows a step.
struct CoarseStart {
  std::shared_ptr<const problem::State> state;  ///< of this mesh, as the coarser one's; null where no coarser mesh is known or its problem was not solved
  int meshes = 0;                               ///< solved on
  std::shared_ptr<HeldStiffness> stiffness;     ///< of this problem; null where it has no rows, few unknowns or no coarser mesh
  double ordering = 0;                          ///< seconds for that
};
CoarseStart coarse_start(const problem::Problem& problem, const Pdas& settings, Monitor& monitor);

}  // namespace dotyk::solver

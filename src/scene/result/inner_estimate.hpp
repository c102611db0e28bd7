// The error estimate of cells that ranks have refined.
#pragma once

#include <vector>

#include "multigrid/slices.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

struct InnerEstimate {
  elasticity::ErrorParts parts;  ///< recovery, bulk and jump of all cells
  std::vector<double> solution;  ///< ∫ σ_h:c⁻¹:σ_h, by body
};
/// Of all ranks. Throws as visit_refined().
InnerEstimate inner_estimate(const Solution& solution);

/// What a rank makes of its cells for that.
Lists estimate_cells(const multigrid::VisitedCells& at, const Lists& said);

}  // namespace dotyk::scene

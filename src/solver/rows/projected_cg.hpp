#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Projected conjugate gradients on the dual energy: Mprgp with its projected steps, multipliers scaled by the root of what each row
/// yields, rows of two springs taken as two (opposed_springs). Coulomb's bounds are those of an outer loop over given friction, and free
/// bodies' equilibrium (Equilibrium) that of an outer augmented Lagrangian: both are updated once the inner problem is solved to a tenth
/// of what they are off by.
struct ProjectedCg : RowMethod {
  const char* name() const override { return "projected_cg"; }
  void require_treatable(const problem::Problem& problem) const override;
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver

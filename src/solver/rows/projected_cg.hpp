#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Projected conjugate gradients on the dual energy (modified proportioning with gradient projections after
/// Dostál 2009, "Optimal Quadratic Programming Algorithms", ch. 5 and 8; on discs along the circles, too):
/// conjugate gradients, scaled by 1/W_rr, within the face of the multipliers (Face) as long as the part of
/// the projected gradient that leaves the face is no greater than the part along it; otherwise, and where a
/// step would leave the admissible set, a projected gradient step of fixed length below 2/λ_max. The energy
/// never increases. Coulomb's bounds are those of an outer loop over given friction, and free bodies'
/// equilibrium (Equilibrium) that of an outer augmented Lagrangian: both are updated once the inner
/// problem is solved to a tenth of what they are off by.
struct ProjectedCg : RowMethod {
  const char* name() const override { return "projected_cg"; }
  void require_treatable(const problem::Problem& problem) const override;
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver

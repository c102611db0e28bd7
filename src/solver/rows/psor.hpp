#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Projected successive over-relaxation: sweeps over the nodes (Relaxation), normal row first, then its
/// friction at the bound just found, so that Coulomb's law is treated directly. Converges for given bounds
/// and 0 < ω < 2 in the plane, ω ≤ 1 in space. Free bodies by an augmented Lagrangian (Equilibrium).
struct Psor : RowMethod {
  double omega = 1.0;
  const char* name() const override { return "psor"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver

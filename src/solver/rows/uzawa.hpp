#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// Uzawa's method, the projected gradient method on the dual energy ½λᵀWλ − x₀ᵀλ + Σφ*(λ):
///   λ := π(λ + ρDx),   x = x₀ − Wλ,   D_r = 1/W_rr (of a friction point: its normal row's),
/// where the bound of Coulomb friction is that of the normal multipliers just projected. For given bounds
/// it contracts for every ρ < 2/λ_max(D^½WD^½); the bound is estimated before the first step (safely: from
/// above) and told. Free bodies by an augmented Lagrangian (Equilibrium).
struct Uzawa : RowMethod {
  double rho = 0.9;  ///< as a part of the bound 2/λ_max; 1 and more need not converge
  const char* name() const override { return "uzawa"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver

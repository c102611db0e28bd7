#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// The alternating algorithm of TR965, as printed in 2.1.3 (plane) and 3.1.3 (space), on the condensed
/// problem (its remark 2.5). With M, Λ the normal and tangential multipliers and x_n, x_t the jumps of the
/// last linear problem, one iteration is
///   1a  Λ := π_b(Λ + ρ x_t)                       a projected step of Uzawa's method
///   1b  A := {M + ρ x_n > 0}
///   1c  x_n = 0 on A, M = 0 off A, Λ as it is      a linear problem, which gives M, x_n, x_t
///   2a  M := (M + ρ x_n)⁺
///   2b  stick := {‖Λ + ρ x_t‖ < b}
///   2c  x_t = 0 on stick, Λ = π_b(Λ + ρ x_t) elsewhere, M as it is; a linear problem again.
/// Other scalar laws take their projection P for (·)⁺ and its derivative for A. Printed for given friction
/// b; for Coulomb's, b is that of the M at hand: in step 1 of the last iteration, in step 2 of step 2a.
///
/// The report scales Λ to the unit disc and M to a pressure, so that its ρ ∈ (10³, 10⁴) has two units: on nodal forces it is ρκ_r on a
/// row of pressure that stands for the measure κ_r, and ρ(∫g)² on a friction row of bound ∫g. That is unit `report`. Else ρ is a force per
/// displacement, the same on every row, or, as for Uzawa's method, a part of the bound 2/λ_max(D^½WD^½) times D, D_r = 1/W_rr.
///
/// Once the sets A and stick no longer change, and in the plane, ρ is without influence: 1a and 2a change
/// nothing, and 1c and 2c alternate exactly between the minimisers of the dual energy over M and over Λ
/// (block Gauss–Seidel), a contraction by the squared coupling of normal and tangential part. In space, 1a
/// and 2c move slipping forces along their circles by Uzawa steps of length ρ. The sets themselves settle
/// only for ρ below Uzawa's bound: a row left out of A that closes in 1c is pushed by ρx in 2a, and where
/// that throws it open by more than x, 1b leaves it out again, for ever. In space stick and slip may go round
/// for every ρ (scripts/papers/tr965/alternating.lua).
struct UzawaPdas : RowMethod {
  enum class Unit { bound, stiffness, report };
  double rho = 0.5;
  Unit unit = Unit::bound;  ///< of ρ: Uzawa's bound, force per displacement, or the report's
  /// Throws InputError for the report's unit with Coulomb friction, which has no bound g.
  void require_treatable(const problem::Problem& problem) const override;
  const char* name() const override { return "uzawa_pdas"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver

#pragma once

#include "problem/condensed.hpp"
#include "problem/parts.hpp"

namespace dotyk::solver {

/// What counts as a force and as a gap on the rows of a condensed problem, so that one number says of an iterate how far it is
/// from the laws: ‖λ − P(λ + ρx)‖ / F, with an F of each part of the problem that has nothing to do with others. A greater ρ asks more of gaps, and a row's force is known to tol F only where ρ_r is not
/// below the stiffness that the row sees, 1/W_rr. Two things bound it:
///
/// - below F/X a gap that is great beside the displacements X would hardly count: on soft springs, whose 1/W_rr is far less.
///   X is that of problem::Residual, by which results are judged, of the rows alone; it is at least what the greatest multiplier moves
///   the stiffest row by: where loads meet their reactions at the contact itself, nothing moves;
/// - above tol F / kεG the rounding of x would count as a force beyond tol: x is a sum of terms of the size G, ε a rounding. A
///   body that moves as a whole far more than it deforms is such a case; no method could end there.
///
/// Hence ρ_r = min(max(1/W_rr, F/max(X, |c_r|)), tol F / kεG).
class RowScales {
 public:
  RowScales(const problem::Problem& problem, const problem::CondensedProblem& condensed);

  /// 1/W_rr; see stiffness_of_rows().
  const algebra::Vector& stiffness() const { return stiffness_; }
  /// F by row, that of its part: ‖λ‖, or √ε of the greatest load |f| (where nothing is loaded, of what would hold the rows where they are at
  /// rest), if that is more: bodies that get out of each other's way end free of forces, and rounding is all that is left of those.
  algebra::Vector forces(const algebra::Vector& lambda) const;
  /// kεG by row, that of its part: what rounding may leave of x, a displacement.
  algebra::Vector rounding(const algebra::Vector& alpha, const algebra::Vector& x) const;
  /// ρ.
  algebra::Vector rho(const algebra::Vector& lambda, const algebra::Vector& alpha, const algebra::Vector& x, double tol) const;

 private:
  algebra::Vector by_row(const std::vector<double>& of_part) const;

  const problem::CondensedProblem* condensed_;
  algebra::Vector c_, stiffness_;
  problem::Parts parts_;
  std::vector<double> least_;  ///< force of each part
};

}  // namespace dotyk::solver

#pragma once

#include "program/program.hpp"

namespace dotyk::program {

/// Between which values the optimum lies, from x and y alone: no trust in the method that found them.
/// Summed in long double (64 bits of mantissa on x86).
struct Bracket {
  double primal = 0;  ///< the objective at x
  /// A value that no feasible point falls below (weak duality): with s = Px + q + Aᵀy, which is not
  /// exactly zero, L(z) = ½zᵀPz + qᵀz + yᵀAz − highᵀy⁺ + lowᵀy⁻ ≥ L(x) + sᵀ(z − x), least over z within the
  /// bounds (rows of one entry); where z_j has none, within 10 (1 + |x|_∞) of x_j.
  double dual = 0;
  double gap = 0;        ///< (primal − dual) / (1 + |primal|)
  double violation = 0;  ///< of the rows by x, relative as Residuals::feasibility
  /// Σ |y_r| · violation of row r, relative to 1 + |primal|: by so much the optimum may lie above
  /// `primal` because x violates rows (the perturbation function is convex with slope y).
  double slack = 0;
};
Bracket bracket(const QuadraticProgram& program, const Vector& x, const Vector& y);

}  // namespace dotyk::program

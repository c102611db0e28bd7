#pragma once

#include "program/program.hpp"

namespace dotyk::program {

/// Does y (m) prove that no x satisfies the rows? Farkas: Aᵀy = 0 while Σ high y⁺ − low y⁻ < 0. With
/// Aᵀy = e ≠ 0 it still proves that every feasible x has |x|₁ ≥ −Σ/|e|; that is asked to be at least
/// `far` times the size of the limits. Entries of y against an infinite limit are ignored.
bool proves_infeasible(const QuadraticProgram& program, const Vector& y, double far = 1e8);

/// Does the objective fall for ever along d (n)? qᵀd < 0, Pd = 0, and Ad leaves no finite limit behind,
/// each up to `tolerance` times −qᵀd in units of a well-scaled program. Most of −qᵀd must come from unknowns j with (Pd)_j
/// nothing beside (|P||d|)_j, whatever their units are.
bool proves_unbounded(const QuadraticProgram& program, const Vector& d, double tolerance = 1e-8);

inline constexpr const char* kFallsForEver = "the objective falls for ever along a direction that meets no row";

/// minimise ½|x|² over the same rows: never unbounded, infeasible where the program is.
QuadraticProgram nearest_point(const QuadraticProgram& program);

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

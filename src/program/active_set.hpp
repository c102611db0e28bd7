#pragma once

#include "base/monitor.hpp"
#include "program/program.hpp"

namespace dotyk::program {

struct ActiveSet {
  enum class Change { one, many } change = Change::one;
  /// Where the working set comes from: `cold` the equalities alone; `interior_point` the prediction of that
  /// method; `automatic` cold up to 200 unknowns and rows.
  enum class Start { automatic, cold, interior_point } start = Start::automatic;
  double tol = 1e-9;         ///< on violations and on signs of multipliers, in the scaled program
  int max_iterations = 20000;
  std::vector<Side> working; ///< a first working set of one's own (m), or empty
  /// A first point (n), or empty. Where it is feasible the method starts there with the rows of `working` that
  /// hold (step 0 of the algorithm), and no row is ever violated.
  Vector point;
};

/// The active-set method for convex, also semidefinite programs: algorithm 3.1 of Netuka (ODAM 2001) with
/// working sets W. A step solves the KKT system of W, singular or not, through a regularised factor and
/// refinement; an inconsistent one gives a direction of the kernel along which the objective falls.
/// Steps end at the first row met, which enters W; at a stationary point the row with the worst
/// multiplier leaves (`one`), or all rows whose multipliers are within a tenth of it, after rounds in which
/// every violated row enters and every wrong multiplier leaves at once (`many`); a motion that such a set
/// leaves free is followed to the first rows met.
///
/// Rows violated at the start are elastic: they cost a weight times their violation, become ordinary
/// rows when met, and the weight grows; if violations are left, their sum alone is minimised, whose
/// multipliers prove the rows contradictory. No end of a step with no row violated: unbounded.
///
/// A working set that comes back without progress is noticed, and Bland's least-index rule followed until
/// the objective falls again; rows that leave again and again among many are changed one by one after a new start.
///
/// Counts: `iterations` are KKT systems solved for a step; `predictor_iterations` interior-point ones.
Result solve(const QuadraticProgram& program, const ActiveSet& settings, Monitor& monitor);

}  // namespace dotyk::program

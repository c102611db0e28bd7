#pragma once

#include <vector>

#include "problem/condensed.hpp"
#include "problem/measure.hpp"
#include "problem/problem.hpp"

namespace dotyk::solver {

/// The dual of a condensed problem with scalar laws, as a program with bounds:
///   minimise ½λᵀHλ − gᵀλ over low ≤ λ ≤ high, Nᵀλ = e,   H = W + the laws' compliances, g = x₀.
struct BoxProgram {
  algebra::DenseMatrix H;   ///< positive semidefinite
  algebra::Vector g, low, high;
  algebra::DenseMatrix N;   ///< rows × rigid motions
  algebra::Vector e;
  algebra::Vector unit;     ///< unit of force of each row
  double energy;            ///< unit of energy
};

/// On some rows, each law scaled to stand for so many rows. Of a law with two stiffnesses the mean compliance is taken. Units: of a row
/// √k √E, E = max F²/k, with F and k of the measure.
BoxProgram box_program(const problem::Problem& problem, const problem::CondensedProblem& condensed, const problem::Measure& measure,
                       const std::vector<int>& rows, const std::vector<double>& stands_for);

struct BoxSolution {
  algebra::Vector lambda;
  algebra::Vector alpha;          ///< amounts of the rigid motions
  std::vector<signed char> side;  ///< −1 at low, 1 at high, 0 between
  bool converged = false;
  int iterations = 0;
};

/// A barrier method (program::Barrier), one dense Cholesky factorisation an iteration: their number hardly depends on the
/// program, so it is where active-set iterations go that do not come to rest. `tol` bounds
/// the residuals and the duality gap, both in the program's units.
BoxSolution solve_by_barrier(const BoxProgram& program, double tol);

}  // namespace dotyk::solver

#pragma once

#include <functional>

#include "base/monitor.hpp"
#include "program/program.hpp"

namespace dotyk::program {

struct InteriorPoint {
  double tol = 1e-9;  ///< on residuals and gap, relative, in the scaled program
  int max_iterations = 200;
  /// Asked of iterates (x, y as of Result) that are within tol: where it says no, the method goes on as long as it gets nearer.
  std::function<bool(const Vector& x, const Vector& y)> fine = nullptr;
};

/// Mehrotra's predictor–corrector method (1992) for convex quadratic programs, infeasible start, one
/// step length for all unknowns, sparse quasidefinite KKT systems with refinement. At the end residuals and gap are below tol,
/// and in every pair of a slack and a multiplier their product below tol², so that unknowns are right to tol as well. Result: `working`
/// holds the prediction of the active set (multiplier above slack). Infeasible and unbounded programs
/// are told by the direction in which the iterates diverge. Throws InputError as check() does.
Result solve(const QuadraticProgram& program, const InteriorPoint& settings, Monitor& monitor);

}  // namespace dotyk::program

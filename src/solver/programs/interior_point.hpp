#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// Mehrotra's predictor–corrector interior-point method on the program of a frictionless problem, see
/// program/interior_point.hpp. At its end every multiplier and every gap is positive; a row is called closed
/// where the multiplier is the larger one, in units in which rows and energy are of size 1. Where forces violate their laws by more
/// than 1e-8 of them at `tol`, it goes on as long as it gets nearer: its gap is relative to the energy, whatever of that the forces make.
struct InteriorPoint : Settings {
  static constexpr bool begins_anew = true;
  /// On the unknowns of the contact boundary (the semidefinite Schur complement), or on all of them.
  bool reduced = true;
};

/// Throws InputError for friction, and where there is no solution, naming the motion.
Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor);

}  // namespace dotyk::solver

#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// The active-set method of Netuka (ODAM 2001, algorithm 3.1) on the semidefinite program of a frictionless
/// problem, see program/active_set.hpp: from rest, if the gaps are open or closed there, and the rows that
/// touch, steps that never leave the admissible displacements. Bodies that nothing but contact holds make
/// KKT systems singular on the way; `working_set` of the result counts them.
struct ActiveSet : Settings {
  enum class Change { one, many } change = Change::one;  ///< rows changed in a step
  /// On the unknowns of the contact boundary (the semidefinite Schur complement), or on all of them.
  bool reduced = true;
};

/// Throws InputError for friction, and where there is no solution, naming the motion.
Result solve(const problem::Problem& problem, const ActiveSet& settings, Monitor& monitor);

}  // namespace dotyk::solver

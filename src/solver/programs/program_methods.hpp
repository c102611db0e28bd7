#pragma once

#include <string>
#include <vector>

#include "problem/condensed.hpp"
#include "problem/rigid_motions.hpp"
#include "program/active_set.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// The active-set method of Netuka (ODAM 2001, algorithm 3.1) on the semidefinite program of a frictionless
/// problem, see program/active_set.hpp: from rest, if the gaps are open or closed there, and the rows that
/// touch, steps that never leave the admissible displacements. Bodies that nothing but contact holds make
/// KKT systems singular on the way; `working_set` of the result counts them.
struct ActiveSet : Settings {
  using Change = program::ActiveSet::Change;
  Change change = Change::one;  ///< rows changed in a step
  /// On the unknowns of the contact boundary (the semidefinite Schur complement), or on all of them.
  bool reduced = true;
};

/// Mehrotra's predictor–corrector interior-point method on the same program, see
/// program/interior_point.hpp. At its end every multiplier and every gap is positive; a row is called closed
/// where the multiplier is the larger one, in units in which rows and energy are of size 1. Where forces violate their laws by more
/// than 1e-8 of them at `tol`, it goes on as long as it gets nearer: its gap is relative to the energy, whatever of that the forces make.
struct InteriorPoint : Settings {
  static constexpr bool begins_anew = true;
  bool reduced = true;  ///< as of ActiveSet
};

/// Throw InputError for friction, and where there is no solution, naming the motion.
Result solve(const problem::Problem& problem, const ActiveSet& settings, Monitor& monitor);
Result solve(const problem::Problem& problem, const InteriorPoint& settings, Monitor& monitor);

/// A frictionless problem as the semidefinite program of Netuka (ODAM 2001, (35)–(38)),
///   minimise ½uᵀKu − fᵀu + Σ ½k_r((Bu − c)_r)²   subject to (Bu)_r ≤ c_r or = c_r:
/// unilateral rows are inequalities, bilateral ones equalities, elastic ones (k_r) energy.
/// K is singular where bodies are free.
class PrimalProgram {
 public:
  /// On all unknowns, or `reduced` to those that rows act on: K is then the Schur complement, semidefinite as K is, and
  /// motions that no row notices are not in the program. `method` names who asks, in messages. Throws InputError for friction, for laws
  /// with other branches, and where a block is not held.
  PrimalProgram(const problem::Problem& problem, const problem::RigidMotions& rigid, const std::string& method,
                bool reduced, algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor);

  const program::QuadraticProgram& program() const { return program_; }
  /// The row of the problem behind each row of the program.
  const std::vector<int>& rows() const { return rows_; }

  /// All unknowns and multipliers from the program's; where motions exist that no row notices, the least u.
  problem::State state(const algebra::Vector& x, const algebra::Vector& y) const;
  double factor_bytes() const;

 private:
  algebra::SparseRows condense(algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor);
  void take_rows(const algebra::SparseRows& B);

  const problem::Problem& problem_;
  program::QuadraticProgram program_;
  std::vector<problem::CondensedBlock> condensed_;  ///< of the reduced form
  std::vector<int> rows_;
  algebra::Vector spring_;  ///< k_r, one a row of the problem; 0 of the others
  algebra::SparseMatrix unnoticed_;
};

}  // namespace dotyk::solver

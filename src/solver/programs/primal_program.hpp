#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problem/condensed_block.hpp"
#include "problem/rigid_motions.hpp"
#include "program/program.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

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

  /// In units in which the solution is of size 1: u = unit() x, λ = unit() y.
  const program::QuadraticProgram& program() const { return program_; }
  double unit() const { return unit_; }
  /// The row of the problem behind each row of the program.
  const std::vector<int>& rows() const { return rows_; }

  /// All unknowns and multipliers from the program's; where motions exist that no row notices, the least u.
  problem::State state(const algebra::Vector& x, const algebra::Vector& y) const;
  double factor_bytes() const;

 private:
  struct Entries;
  void take_blocks(Entries& entries, bool reduced, algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor);
  void take_rows(Entries& entries);
  void rescale();

  const problem::Problem& problem_;
  program::QuadraticProgram program_;
  std::vector<problem::CondensedBlock> condensed_;  ///< of the reduced form
  std::vector<int> first_;                          ///< its first unknown in the program, block by block
  std::vector<int> rows_;
  algebra::SparseMatrix unnoticed_;
  double unit_ = 1;
};

/// Solves a frictionless problem by a method for programs: states it (PrimalProgram), has it solved, and takes
/// over state, rows closed at the end, history, times and how it ended. Throws InputError where there is no
/// solution, naming the motion. `method` is the result's, and names who asks in messages.
Result solve_primal(
    const problem::Problem& problem, const std::string& method, bool reduced, algebra::Ordering ordering,
    Monitor& monitor, const std::function<program::Result(const PrimalProgram& primal, Monitor& monitor)>& solve);

}  // namespace dotyk::solver

#pragma once

#include <string>
#include <vector>

#include "problem/condensed_block.hpp"
#include "problem/rigid_motions.hpp"
#include "program/program.hpp"
#include "solver/solver.hpp"

namespace dotyk::solver {

/// A frictionless problem as the semidefinite program of Netuka (ODAM 2001, (35)–(38)),
///   minimise ½uᵀKu − fᵀu + Σ ½k_r((Bu − c)_r)²   subject to (Bu)_r ≤ c_r or = c_r:
/// unilateral rows are inequalities, bilateral ones equalities, elastic ones (k_r) energy.
/// K is singular where bodies are free.
class PrimalProgram {
 public:
  /// On all unknowns, or `reduced` to those of the nodes that rows act on: K is then the Schur complement,
  /// semidefinite as K is. `method` names who asks, in messages. Throws InputError for friction, for laws
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
  algebra::DenseMatrix unnoticed_;
  double unit_ = 1;
};

/// Tells the watcher of a program's iterations and writes them into a history.
class Recorder final : public Monitor {
 public:
  Recorder(Monitor& watcher, std::vector<IterationInfo>& history) : watcher_(watcher), history_(history) {}
  void phase(const std::string& what) override { watcher_.phase(what); }
  bool stop() override { return watcher_.stop(); }
  void iteration(const IterationInfo& info) override {
    history_.push_back(info);
    watcher_.iteration(info);
  }

 private:
  Monitor& watcher_;
  std::vector<IterationInfo>& history_;
};

/// What a program's solution says of the problem: state, rows closed at the end, how it ended.
void take_over(const problem::Problem& problem, const PrimalProgram& primal, const program::Result& solved,
               Result& result);

}  // namespace dotyk::solver

#include "solver/active_set.hpp"

#include "base/stopwatch.hpp"
#include "program/active_set.hpp"
#include "solver/primal_program.hpp"
#include "solver/require_solvable.hpp"

namespace dotyk::solver {
namespace {

/// The first working set: the rows flagged, or those that touch at rest.
program::ActiveSet options(const problem::Problem& problem, const ActiveSet& settings, const PrimalProgram& primal) {
  program::ActiveSet out;
  out.change = settings.change == ActiveSet::Change::one ? program::ActiveSet::Change::one
                                                         : program::ActiveSet::Change::many;
  out.start = program::ActiveSet::Start::cold;
  out.tol = settings.tol;
  out.max_iterations = settings.max_iterations;
  const program::QuadraticProgram& p = primal.program();
  const double touching = 1e-12 * problem.c.lpNorm<Eigen::Infinity>();
  for (int k = 0; k < p.rows(); ++k) {
    const int r = primal.rows()[k];
    const bool holds = settings.start.empty() ? problem.c[r] <= touching : settings.start[r] != 0;
    out.working.push_back(p.equality(k) ? program::Side::equal : holds ? program::Side::high : program::Side::free);
  }
  if (settings.start.empty()) out.point = algebra::Vector::Zero(p.unknowns());
  return out;
}

}  // namespace

Result solve(const problem::Problem& problem, const ActiveSet& settings, Monitor& monitor) {
  Result result;
  const problem::RigidMotions rigid = problem::rigid_motions(problem);
  const PrimalProgram primal(problem, rigid, "active_set", settings.reduced, settings.ordering, result.clock, monitor);
  const std::string note = require_solvable(problem, rigid);
  Stopwatch watch;
  Recorder recorder(monitor, result.history);
  const program::Result solved = program::solve(primal.program(), options(problem, settings, primal), recorder);
  result.clock.iterate += watch.lap();
  take_over(problem, primal, solved, result);
  result.clock.recover += watch.lap();
  result.method = settings.change == ActiveSet::Change::one ? "active_set" : "active_set (many)";
  result.working_set = {solved.added,    solved.dropped,        solved.singular,
                        solved.survived, solved.factorisations, solved.repeats};
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

}  // namespace dotyk::solver
